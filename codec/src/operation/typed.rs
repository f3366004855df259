//! Typed operations: the trait, and the macros that declare an operation from its row in the
//! function table.

use super::{AdsService, Call, Function};
use crate::address::{IndexGroup, IndexOffset};
use crate::ads::AmsPort;
use crate::error::Error;
use crate::stream::Decode;

pub(super) mod sealed {
    pub trait Sealed {}
}

/// The parts of a call. All 30 operations share the code that builds a call, because it uses this
/// trait as a trait object. Otherwise, a program would contain a copy of it for each operation
/// whose calls it builds.
pub(super) trait Parts {
    fn index_group(&self) -> IndexGroup;
    fn index_offset(&self) -> IndexOffset;
    fn read_length(&self) -> u32;
    fn encoded_len(&self) -> usize;
    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error>;
}

impl<O: Operation> Parts for O {
    fn index_group(&self) -> IndexGroup {
        Operation::index_group(self)
    }

    fn index_offset(&self) -> IndexOffset {
        Operation::index_offset(self)
    }

    fn read_length(&self) -> u32 {
        Operation::read_length(self)
    }

    fn encoded_len(&self) -> usize {
        Operation::encoded_len(self)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Operation::encode(self, buf)
    }
}

pub(super) fn call<'b>(
    function: Function,
    parts: &dyn Parts,
    buf: &'b mut [u8],
) -> Result<Call<'b>, Error> {
    let spec = function.spec();
    Ok(Call {
        port: spec.task.port(),
        service: spec.service,
        index_group: parts.index_group(),
        index_offset: parts.index_offset(),
        read_length: parts.read_length(),
        data: parts.encode(buf)?,
    })
}

/// A call of one function of the CNC.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1, 2.1.2, 2.2.2, 3.1 … 3.4 and
/// 4.3.1 … 4.3.11.
///
/// ```
/// use ads_cnc::address::{Channel, IndexGroup, IndexOffset};
/// use ads_cnc::ads::AmsPort;
/// use ads_cnc::operation::{AdsService, CountVariables, Operation};
/// use ads_cnc::{Error, Kind, VariableCount};
///
/// /// Any transport.
/// trait Transport {
///     fn send(
///         &mut self,
///         port: AmsPort,
///         service: AdsService,
///         index_group: IndexGroup,
///         index_offset: IndexOffset,
///         read_length: u32,
///         data: &[u8],
///     ) -> &[u8];
///
///     fn ask<'r, O: Operation>(
///         &'r mut self,
///         op: &O,
///         buf: &mut [u8],
///     ) -> Result<O::Reply<'r>, Error> {
///         let (group, offset) = (op.index_group(), op.index_offset());
///         let data = op.encode(buf)?;
///         op.decode_reply(
///             self.send(op.port(), op.service(), group, offset, op.read_length(), data),
///         )
///     }
/// }
///
/// // Or encode all parts of the call at once:
/// let count = CountVariables::new(Channel::new(1)?, Kind::V_E);
/// let mut buf = [0; 256];
/// let call = count.call(&mut buf)?;
/// assert_eq!((call.port, call.service), (AmsPort::SDA, AdsService::ReadWrite));
/// assert_eq!((call.index_offset.get(), call.data), (0x44, &b"V.E\0"[..]));
/// assert_eq!(count.decode_reply(&[123, 0, 0, 0])?, VariableCount(123));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
pub trait Operation: sealed::Sealed {
    /// The called function.
    const FUNCTION: Function;

    /// The type of the reply.
    type Reply<'r>: Decode<'r>;

    /// The AMS port to which the request is sent.
    fn port(&self) -> AmsPort {
        const { Self::FUNCTION.spec().task.port() }
    }

    /// The ADS service of the function.
    fn service(&self) -> AdsService {
        const { Self::FUNCTION.spec().service }
    }

    /// The index group of the request.
    fn index_group(&self) -> IndexGroup;

    /// The index offset of the request.
    fn index_offset(&self) -> IndexOffset;

    /// The read length: the maximum number of data bytes that the CNC may return; 0 for a Write.
    fn read_length(&self) -> u32;

    /// The number of bytes that [`encode`](Self::encode) writes.
    fn encoded_len(&self) -> usize;

    /// Writes the data of the request, which may be empty, to the front of `buf`, and returns the
    /// bytes written.
    ///
    /// # Errors
    /// An argument that the request cannot contain, such as a name that is too long, or a buffer
    /// that is too small. On error, nothing is written.
    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error>;

    /// Encodes the data of the request into `buf` and returns it with the port, service, address
    /// and read length.
    ///
    /// # Errors
    /// Those of [`encode`](Self::encode).
    fn call<'b>(&self, buf: &'b mut [u8]) -> Result<Call<'b>, Error>
    where
        Self: Sized,
    {
        call(Self::FUNCTION, self, buf)
    }

    /// Decodes the data of the reply.
    ///
    /// # Errors
    /// Those of the decoder of the reply, and an error for a reply longer than the read length or
    /// with more descriptors than [`ReadDescriptors::count`](super::ReadDescriptors::count).
    fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<Self::Reply<'r>, Error> {
        Self::Reply::decode(data)
    }
}

/// The kinds of fields of operations, one line each: the type of the field, the type of the argument
/// of the constructor, the conversions from argument to field and from field to stream, and the
/// documentation. The first lines document the errors of the constructors.
macro_rules! field {
    (errors Name)    => { "Those of [`IntoName::into_name`]. [`encode`](Operation::encode) checks the length of the name." };
    (errors CStringPrefix) => { field!(errors Name) };
    (errors NonZero) => { "[`ErrorKind::OutOfRange`](crate::ErrorKind::OutOfRange) for the index 0." };
    (errors $kind:ident) => { "" };
    ($q:ident Channel $($i:ident)?)    => { field!(@$q [Channel] [Channel] [$($i)?] [$($i)?] "The channel.") };
    ($q:ident Axis $($i:ident)?)       => { field!(@$q [ChannelAxis] [ChannelAxis] [$($i)?] [$($i)?] "The axis, by its index in the channel.") };
    ($q:ident Parameters $($i:ident)?) => { field!(@$q [DynamicKind] [DynamicKind] [$($i)?] [$($i)?] "The kind of parameters.") };
    ($q:ident List $($i:ident)?)       => { field!(@$q [ObjectList] [impl Into<ObjectList>] [$($i)?.into()] [$($i)?] "The list.") };
    ($q:ident Element $($i:ident)?)    => { field!(@$q [ElementAddress] [ElementAddress] [$($i)?] [$($i)?] "The element.") };
    ($q:ident Class $($i:ident)?)      => { field!(@$q [ClassGroup] [ClassGroup] [$($i)?] [$($i)?] "The class, by number or by index.") };
    ($q:ident Object $($i:ident)?)     => { field!(@$q [(ComGroup, IndexOffset)] [(ComGroup, IndexOffset)] [$($i)?] [$($i)?] "The object.") };
    ($q:ident Number $($i:ident)?)     => { field!(@$q [u32] [u32] [$($i)?] [$($i)?] "A number.") };
    ($q:ident Index $($i:ident)?)      => { field!(@$q [u32] [u32] [$($i)?] [$($i)?] "Index of the variable, from 0 to the number of variables minus 1.") };
    ($q:ident NonZero $($i:ident)?)    => { field!(@$q [u32] [u32] [DynamicIndex($($i)?).check()?.0] [$($i)?] "Index of the parameter, from 1.") };
    ($q:ident Kind $($i:ident)?)       => { field!(@$q [Kind<'a>] [Kind<'a>] [$($i)?] [$($i)?] "The kind of variables.") };
    ($q:ident Name $($i:ident)?)       => { field!(@$q [TextRef<'a>] [impl IntoName<'a>] [$($i)?.into_name()?.into()] [$($i)?] "Name of the variable or parameter.") };
    ($q:ident CStringPrefix $($i:ident)?)    => { field!(@$q [CncStr<'a>] [impl IntoName<'a>] [$($i)?.into_name()?] [$($i)?] "Name of the variable.") };
    ($q:ident Handle $($i:ident)?)     => { field!(@$q [Handle] [Handle] [$($i)?] [$($i)?] "Handle of the variable.") };
    ($q:ident Indices $($i:ident)?)    => { field!(@$q [U32List<'a>] [impl Into<U32List<'a>>] [$($i)?.into()] [$($i)?] "Index in each dimension, from 0; empty for the whole variable.") };
    ($q:ident Value $($i:ident)?)      => { field!(@$q [WriteValue<'a>] [impl Into<WriteValue<'a>>] [$($i)?.into()] [$($i)?.as_bytes()] "The value.") };
    ($q:ident Lines $($i:ident)?)      => { field!(@$q [&'a [u8]] [&'a [u8]] [$($i)?] [$($i)?] "Whole lines of NC text, as [`Sender`](crate::streaming::Sender) returns them.") };
    (@ty [$($ty:tt)*] $argument:tt $made:tt $lent:tt $doc:literal) => { $($ty)* };
    (@argument $ty:tt [$($argument:tt)*] $made:tt $lent:tt $doc:literal) => { $($argument)* };
    (@made $ty:tt $argument:tt [$($made:tt)*] $lent:tt $doc:literal) => { $($made)* };
    (@lent $ty:tt $argument:tt $made:tt [$($lent:tt)*] $doc:literal) => { $($lent)* };
    (@doc $ty:tt $argument:tt $made:tt $lent:tt $doc:literal) => { $doc };
}

/// Declares the operation of a row of the function table.
macro_rules! operation {
    (
        $how:ident $function:ident [$($a:lifetime)?] $facts:tt
        [$( $part:ident: $part_kind:ident ),+] [$( $field:ident: $field_kind:ident ),*]
        [$( $data:ident $body:tt )?] [$reply:ty] [$( $most:literal )?] [$( $length:ident )?]
    ) => {
        operation! { @type $how $function [$($a)?] $facts
            [$( $part: $part_kind, )+ $( $field: $field_kind, )*] [$( $length )?] }

        impl $(<$a>)? sealed::Sealed for $function $(<$a>)? {}

        impl $(<$a>)? Operation for $function $(<$a>)? {
            const FUNCTION: Function = Function::$function;

            type Reply<'r> = $reply;

            fn index_group(&self) -> IndexGroup {
                ($( self.$part, )+).group(const { Function::$function.spec().group })
            }

            fn index_offset(&self) -> IndexOffset {
                ($( self.$part, )+).offset(const { Function::$function.spec().offset })
            }

            fn read_length(&self) -> u32 {
                operation!(@length self [$( $most )?] [$( $length )?])
            }

            operation! { @data [$( $data $body )?] [$( $field: $field_kind ),*] }

            $( fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<Self::Reply<'r>, Error> {
                let reply = Decode::decode(data)?;
                self.check_reply(&reply, self.$length)?;
                Ok(reply)
            } )?
        }

        impl $(<$a>)? $function $(<$a>)? {
            /// Decodes a call whose address matches the rules of the function.
            fn dispatched<'c>(group: Group, call: &Call<'c>) -> Result<Request<'c>, DispatchError> {
                let rule = const { Function::$function.spec().offset };
                let ($( $part, )+) = Address::from_call(group, call.index_offset, rule)
                    .ok_or(DispatchError::Offset(call.index_offset))?;
                $( let $data $body = Decode::decode(call.data).map_err(DispatchError::Stream)?; )?
                Ok(Request::$function($function {
                    $( $part, )+
                    $( $field: $field.into(), )*
                    $( $length: Self::check_length(call.read_length).map_err(DispatchError::Stream)?, )?
                }))
            }
        }
    };

    (@type by_hand $($rest:tt)*) => { operation! { @struct pub(super), $($rest)* } };
    (@type $how:ident $function:ident [$($a:lifetime)?] $facts:tt
        [$( $field:ident: $kind:ident, )*] []
    ) => {
        operation! { @struct pub, $function [$($a)?] $facts [$( $field: $kind, )*] [] }

        impl $(<$a>)? $function $(<$a>)? {
            operation! { @new $how $( $field: $kind, )* }
        }
    };
    (@struct $vis:vis, $function:ident [$($a:lifetime)?]
        [$service:ident $task:ident $group:expr, $offset:expr, $clause:literal $section:literal]
        [$( $field:ident: $kind:ident, )*] [$( $length:ident )?]
    ) => {
        documented! { $function
            ///
            /// | ADS service | task | index groups: [`GroupRule`] | index offsets: [`OffsetRule`] | section in `ads-en` 1.05 and `ads-de` 1.051, or other source | requirement |
            /// |---|---|---|---|---|---|
            #[doc = concat!(
                "| ", stringify!($service), " | ", stringify!($task), " | `", stringify!($group), "` | `",
                stringify!($offset), "` | ", $section, " | ", $clause, " |",
            )]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub struct $function $(<$a>)? {
                $( #[doc = field!(doc $kind)] $vis $field: field!(ty $kind), )*
                $( /// The read length in bytes.
                $vis $length: u32, )?
            }
        }
    };
    (@new plain $( $field:ident: $kind:ident, )*) => {
        /// Creates the operation.
        pub fn new($( $field: field!(argument $kind) ),*) -> Self {
            Self { $( $field: field!(made $kind $field), )* }
        }
    };
    (@new checked $( $field:ident: $kind:ident, )*) => {
        /// Creates the operation.
        ///
        /// # Errors
        $( #[doc = field!(errors $kind)] )*
        pub fn new($( $field: field!(argument $kind) ),*) -> Result<Self, Error> {
            Ok(Self { $( $field: field!(made $kind $field), )* })
        }
    };

    (@length $self:ident [] []) => {
        const { <Self::Reply<'static> as Decode<'static>>::STREAM.layout().max }
    };
    (@length $self:ident [$most:literal] []) => { $most };
    (@length $self:ident [] [$length:ident]) => { $self.$length };

    (@data [] []) => {
        fn encoded_len(&self) -> usize {
            0
        }

        fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Error> {
            Ok(&[])
        }
    };
    (@data [$data:ident $body:tt] [$( $field:ident: $kind:ident ),*]) => {
        fn encoded_len(&self) -> usize {
            let Self { $( $field, )* .. } = *self;
            $( let $field = field!(lent $kind $field); )*
            $data $body.encoded_len()
        }

        fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
            let Self { $( $field, )* .. } = *self;
            $( let $field = field!(lent $kind $field); )*
            $data $body.encode(buf)
        }
    };
}

pub(super) use {field, operation};
