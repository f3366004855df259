//! Laws of the operations of all functions.

use ads_cnc::address::{
    Access, Channel, ChannelAxis, Class, ElementAddress, IndexGroup, IndexOffset, PlatformAxis,
    Spindle,
};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::*;
use ads_cnc::{Error, ErrorKind, Handle, Kind, U32List};

use super::check_call;

/// Parameters of operations; each operation uses some of them.
#[derive(Clone, Debug)]
pub(crate) struct Parameters<'a> {
    pub(crate) channel: Channel,
    pub(crate) platform_axis: PlatformAxis,
    pub(crate) axis: ChannelAxis,
    pub(crate) spindle: Spindle,
    pub(crate) class: Class,
    pub(crate) dynamic: DynamicKind,
    /// Selects the list of objects, the group of an object, the kind of address of an element, or
    /// the addressing of a class.
    pub(crate) place: u8,
    pub(crate) element: u32,
    pub(crate) number: u32,
    pub(crate) count: u32,
    pub(crate) text: &'a str,
    pub(crate) indices: &'a [u32],
    pub(crate) bytes: &'a [u8],
}

impl Parameters<'_> {
    fn list(&self) -> ObjectList {
        match self.place % 3 {
            0 => ObjectList::PLATFORM,
            1 => self.channel.into(),
            _ => self.platform_axis.into(),
        }
    }

    fn object(&self) -> (IndexGroup, IndexOffset) {
        let group = match self.place % 4 {
            0 => IndexGroup::new(0x12_0100),
            // With this group, the offset contains the axis (E-04).
            1 => IndexGroup::new(0x12_0200),
            2 => self.platform_axis.com(Access::Element),
            _ => self.channel.com(Access::Element),
        };
        (group, IndexOffset::new(self.number))
    }

    fn address(&self) -> Result<ElementAddress, Error> {
        match self.place % 3 {
            0 => ElementAddress::for_channel(self.channel, self.class, self.element),
            1 => ElementAddress::for_axis(self.channel, self.class, self.axis, self.element),
            _ => ElementAddress::for_spindle(self.spindle, self.element),
        }
    }
}

/// Makes the operation of this function from the parameters. If they are valid, checks it as
/// [`check_operation`] does; `mutation` adds a fault to the encoded call.
pub(crate) fn check_made(
    function: Function,
    of: &Parameters<'_>,
    mutation: &dyn Fn(&mut Call<'_>),
) -> Result<(), Error> {
    let Parameters { channel, axis, class, dynamic, number, count, text, bytes, .. } = *of;
    let indices = U32List::from(of.indices);
    let kind = || Kind::new(text);
    match function {
        Function::CountObjects => made(CountObjects::new(of.list()), mutation),
        Function::ReadDescriptors => {
            made(ReadDescriptors::new(of.list(), number, count)?, mutation)
        }
        Function::CountVariables => made(CountVariables::new(channel, kind()?), mutation),
        Function::DescribeByIndex => made(DescribeByIndex::new(channel, number, kind()?), mutation),
        Function::HandleByName => made(HandleByName::new(channel, text)?, mutation),
        Function::ReadByHandle => {
            made(ReadByHandle::new(channel, Handle(number), indices), mutation)
        }
        Function::ReadByName => made(ReadByName::new(channel, text)?, mutation),
        Function::WriteByHandle => {
            made(WriteByHandle::new(channel, Handle(number), indices, bytes), mutation)
        }
        Function::WriteByName => made(WriteByName::new(channel, text, bytes)?, mutation),
        Function::DescribeExtended => {
            made(DescribeExtended::new(channel, number, kind()?), mutation)
        }
        Function::DescribeByName => made(DescribeByName::new(channel, text)?, mutation),
        Function::AxisHandleByName => made(AxisHandleByName::new(channel, axis, text)?, mutation),
        Function::AxisReadByName => made(AxisReadByName::new(channel, axis, text)?, mutation),
        Function::AxisWriteByName => {
            made(AxisWriteByName::new(channel, axis, text, bytes)?, mutation)
        }
        Function::CountDynamic => made(CountDynamic::new(channel, dynamic), mutation),
        Function::DynamicNameByIndex => {
            made(DynamicNameByIndex::new(channel, dynamic, number)?, mutation)
        }
        Function::DynamicValueByName => {
            made(DynamicValueByName::new(channel, dynamic, text)?, mutation)
        }
        Function::DynamicValueByIndex => {
            made(DynamicValueByIndex::new(channel, dynamic, number)?, mutation)
        }
        Function::FindInstance => {
            let find = FindInstance::new(class, number, count);
            // A query of a spindle is by index in any case.
            let by_index = class != Class::Spindle && of.place % 2 == 1;
            made(if by_index { find.by_index() } else { find }, mutation)
        }
        Function::CountElements => made(CountElements::new(of.address()?)?, mutation),
        Function::ReadElement => made(ReadElement::new(of.address()?, count)?, mutation),
        Function::WriteElement => made(WriteElement::new(of.address()?, bytes)?, mutation),
        Function::ReadElementName => made(ReadElementName::new(of.address()?), mutation),
        Function::ReadElementType => made(ReadElementType::new(of.address()?), mutation),
        Function::ReadElementLength => made(ReadElementLength::new(of.address()?), mutation),
        Function::ReadElementUnit => made(ReadElementUnit::new(of.address()?), mutation),
        Function::ReadElementWriteFlag => made(ReadElementWriteFlag::new(of.address()?), mutation),
        Function::WriteProgramStream => made(WriteProgramStream::new(channel, bytes), mutation),
        Function::ReadObject => {
            let (group, offset) = of.object();
            made(ReadObject::new(group, offset, count)?, mutation)
        }
        Function::WriteObject => {
            let (group, offset) = of.object();
            made(WriteObject::new(group, offset, bytes)?, mutation)
        }
        other => panic!("{other:?} is made of nothing here"),
    }
}

/// Checks that a server dispatches the call of a valid operation to the same operation (with an
/// exception for `CountElements`), and that the call satisfies [`check_call`].
pub(crate) fn check_operation<'a, O: Operation + Into<Request<'a>>>(operation: O) {
    assert_eq!(made(operation, &|_| ()), Ok(()));
}

/// Like [`check_operation`], for an operation that may be invalid: then encoding must write
/// nothing, and its error is returned.
fn made<'a, O: Operation + Into<Request<'a>>>(
    operation: O,
    mutation: &dyn Fn(&mut Call<'_>),
) -> Result<(), Error> {
    let (group, offset) = (operation.index_group(), operation.index_offset());
    let (length, len) = (operation.read_length(), operation.encoded_len());
    let request: Request<'_> = operation.into();
    assert_eq!(request.function(), O::FUNCTION);
    let (spec, wanted) = (O::FUNCTION.spec(), (group, offset, length, len));

    let mut buf = vec![0x55; len];
    let mut call = match request.encode(&mut buf) {
        Ok(call) => call,
        Err(error) => {
            assert!(buf.iter().all(|&byte| byte == 0x55), "{error}: {request:?}");
            return Err(error);
        }
    };
    mutation(&mut call);
    let found = (call.index_group, call.index_offset, call.read_length, call.data.len());
    assert_eq!(found, wanted, "{request:?}");
    assert_eq!((call.port, call.service), (spec.task.port(), spec.service), "{request:?}");
    match call.dispatch() {
        // A server dispatches `CountElements` as `ReadElement` if the low 16 bits of the offset are
        // not 0, for example with the stride 0x1000 (E-01).
        Ok(read @ Request::ReadElement(_)) if O::FUNCTION == Function::CountElements => {
            assert_eq!(read.encode(&mut []), Ok(call));
        }
        dispatched => assert_eq!(dispatched, Ok(request)),
    }
    assert_eq!(check_call(&call), Ok(()));
    if let Some(less) = len.checked_sub(1) {
        let mut small = vec![0x55; less];
        assert_eq!(request.encode(&mut small).unwrap_err().kind(), ErrorKind::BufferTooSmall);
        assert!(small.iter().all(|&byte| byte == 0x55));
    }
    Ok(())
}
