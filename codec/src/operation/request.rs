//! Typed operations, and all of them as one type.

use super::sorts::ROOM;
use super::{
    AxisHandleByName, AxisReadByName, AxisWriteByName, Call, CountDynamic, CountElements,
    CountObjects, CountVariables, DescribeByIndex, DescribeByName, DescribeExtended,
    DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, FindInstance, Function,
    HandleByName, ReadByHandle, ReadByName, ReadDescriptors, ReadElement, ReadElementLength,
    ReadElementName, ReadElementType, ReadElementUnit, ReadElementWriteFlag, ReadObject, Refusal,
    Reply, Service, WriteByHandle, WriteByName, WriteElement, WriteObject, WriteProgramStream,
};
use crate::address::{IndexGroup, IndexOffset};
use crate::error::Error;
use crate::stream::Decode;

pub(super) mod sealed {
    pub trait Sealed {}
}

/// A call of one function of the table.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1, 2.1.2, 2.2.2, 3.1 … 3.4 and
/// 4.3.1 … 4.3.11.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{CountVariables, Operation};
/// use ads_cnc::{Error, Kind, VariableCount};
///
/// /// Over any transport: address and data go out, what comes back is read.
/// fn ask<O: Operation>(op: &O, reply: &'static [u8]) -> Result<O::Reply<'static>, Error> {
///     assert_eq!(op.encode(&mut [0; 256])?, b"V.E\0");
///     op.decode_reply(reply)
/// }
///
/// let count = CountVariables::new(Channel::new(1)?, Kind::V_E);
/// assert_eq!(ask(&count, &[123, 0, 0, 0])?, VariableCount(123));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
pub trait Operation: sealed::Sealed {
    /// Which function.
    const FUNCTION: Function;

    /// What comes out.
    type Reply<'r>: Decode<'r>;

    /// Where to send it.
    fn index_group(&self) -> IndexGroup;

    /// Where to send it.
    fn index_offset(&self) -> IndexOffset;

    /// The most bytes the reply has, to be sent as the read length.
    fn read_length(&self) -> u32;

    /// How many bytes [`encode`](Self::encode) writes.
    fn encoded_len(&self) -> usize;

    /// Writes the data to send, if any, to the front of `buf`.
    ///
    /// # Errors
    /// What the function does not take, or a buffer too small; nothing is written.
    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error>;

    /// Reads the data received.
    ///
    /// # Errors
    /// Those of the reply's stream, and a reply longer than was asked for.
    fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<Self::Reply<'r>, Error> {
        Self::Reply::decode(data)
    }
}

type Decoder = for<'a> fn(&Call<'a>) -> Result<Request<'a>, Refusal>;

#[cold]
fn refused<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
    Err(call.refusal())
}

#[cold]
#[inline(never)]
fn read_with_data<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
    Err(Refusal::Stream(call.read_with_data()))
}

fn call<'b, O: Operation>(operation: &O, buf: &'b mut [u8]) -> Result<Call<'b>, Error> {
    let data = operation.encode(buf)?;
    let spec = const { O::FUNCTION.spec() };
    Ok(Call {
        port: spec.task.port(),
        service: spec.service,
        index_group: operation.index_group(),
        index_offset: operation.index_offset(),
        read_length: operation.read_length(),
        data,
    })
}

/// Declares [`Request`] and passes what operations have in common on to them.
macro_rules! requests {
    ($( $function:ident($operation:ty) => $reply:ident, )+) => {
        /// Any operation: what a server is asked, what a tool shows.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::ads::AmsPort;
        /// use ads_cnc::operation::{HandleByName, Reply, Request};
        /// use ads_cnc::Handle;
        ///
        /// let request = Request::from(HandleByName::new(Channel::new(1)?, "V.E.vartest")?);
        /// let mut buf = [0; 256];
        /// let call = request.encode(&mut buf)?;
        /// assert_eq!((call.port, call.index_offset.get()), (AmsPort::SDA, 0x46));
        /// assert_eq!(call.data, b"V.E.vartest\0");
        /// assert_eq!(call.dispatch(), Ok(request));
        /// assert_eq!(request.decode_reply(&[4, 0, 0, 2])?, Reply::Handle(Handle(0x2000004)));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Request<'a> {
            $(
                #[doc = concat!("See [`", stringify!($function), "`].")]
                $function($operation),
            )+
        }

        impl<'a> Request<'a> {
            /// Which function is called.
            pub const fn function(&self) -> Function {
                match self { $( Self::$function(_) => Function::$function, )+ }
            }

            /// The call as it goes out: to the function's port, with its service.
            ///
            /// # Errors
            /// Those of [`Operation::encode`].
            pub fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<Call<'b>, Error> {
                match self { $( Self::$function(operation) => call(operation, buf), )+ }
            }

            /// How many bytes the data of the call has.
            pub fn encoded_len(&self) -> usize {
                match self { $( Self::$function(operation) => operation.encoded_len(), )+ }
            }

            /// Reads the data received.
            ///
            /// # Errors
            /// Those of [`Operation::decode_reply`].
            pub fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<Reply<'r>, Error> {
                match self { $(
                    Self::$function(operation) => {
                        operation.decode_reply(data).map(Reply::$reply)
                    }
                )+ }
            }

            /// What is asked of the function at a place of the table.
            #[inline]
            pub(super) fn decode(function: usize, call: &Call<'a>) -> Result<Self, Refusal> {
                match DECODERS.get(function & (ROOM - 1)) {
                    Some(decode) => decode(call),
                    None => Err(call.refusal()),
                }
            }
        }

        // Apart: in one body they would be larger, and save all registers for any of them.
        static DECODERS: [Decoder; ROOM] = {
            let mut decoders: [Decoder; ROOM] = [refused; ROOM];
            let (mut left, mut functions): (&mut [Decoder], _) = (&mut decoders, Function::ALL);
            while let ([decoder, rest @ ..], [function, others @ ..]) = (left, functions) {
                *decoder = match function { $(
                    Function::$function => {
                        fn decode<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
                            let service = const { Function::$function.spec().service };
                            if matches!(service, Service::Read) && !call.data.is_empty() {
                                return read_with_data(call);
                            }
                            <$operation>::dispatched(call)
                        }
                        decode
                    }
                )+ };
                (left, functions) = (rest, others);
            }
            decoders
        };

        $(
            impl<'a> From<$operation> for Request<'a> {
                fn from(operation: $operation) -> Self {
                    Self::$function(operation)
                }
            }
        )+
    };
}

requests! {
    CountObjects(CountObjects) => ObjectCount,
    ReadDescriptors(ReadDescriptors) => Descriptors,
    CountVariables(CountVariables<'a>) => VariableCount,
    DescribeByIndex(DescribeByIndex<'a>) => Description,
    HandleByName(HandleByName<'a>) => Handle,
    ReadByHandle(ReadByHandle<'a>) => Value,
    ReadByName(ReadByName<'a>) => Value,
    WriteByHandle(WriteByHandle<'a>) => NoData,
    WriteByName(WriteByName<'a>) => NoData,
    DescribeExtended(DescribeExtended<'a>) => Extended,
    DescribeByName(DescribeByName<'a>) => DescriptionByName,
    AxisHandleByName(AxisHandleByName<'a>) => Handle,
    AxisReadByName(AxisReadByName<'a>) => Value,
    AxisWriteByName(AxisWriteByName<'a>) => NoData,
    CountDynamic(CountDynamic) => DynamicCount,
    DynamicNameByIndex(DynamicNameByIndex) => DynamicName,
    DynamicValueByName(DynamicValueByName<'a>) => DynamicValue,
    DynamicValueByIndex(DynamicValueByIndex) => DynamicValue,
    FindInstance(FindInstance) => ObjectAddress,
    CountElements(CountElements) => ElementCount,
    ReadElement(ReadElement) => Content,
    WriteElement(WriteElement<'a>) => NoData,
    ReadElementName(ReadElementName) => ElementText,
    ReadElementType(ReadElementType) => ElementText,
    ReadElementLength(ReadElementLength) => ElementLength,
    ReadElementUnit(ReadElementUnit) => ElementText,
    ReadElementWriteFlag(ReadElementWriteFlag) => ElementWriteFlag,
    WriteProgramStream(WriteProgramStream<'a>) => NoData,
    ReadObject(ReadObject) => Content,
    WriteObject(WriteObject<'a>) => NoData,
}
