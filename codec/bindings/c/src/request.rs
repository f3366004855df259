//! Operations, for a client that encodes them and for a server that receives them.

use codec::address::{
    Addressing, Attribute, AxisStride, Channel, ChannelAxis, Class, ClassGroup, ComTable,
    ElementAddress, Group, IndexGroup, IndexOffset, PlatformAxis,
};
use codec::ads::AmsPort;
use codec::dynamic::DynamicKind;
use codec::operation::{self as op, Call, Function, GroupRule, OffsetRule, Request};
use codec::{CncStr, Handle, Kind, U32List};

use crate::error::{AdsCncError, Fault, told};
use crate::memory::{AdsCncBytes, bytes, get, put, put_item, room, slice, to_u32};
use crate::stream::{AdsCncField, walk};
use crate::tables::{argument, function, service};

/// The arguments of any function. Arguments that the function does not have are zero.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(test, derive(Debug))]
pub struct AdsCncRequest {
    /// The number of the function.
    pub function: u32,
    /// The channel, from 1; 0 is the platform, for functions that support it. For the object
    /// address of a spindle, the index of the spindle.
    pub channel: u32,
    /// 1 if `channel` is the index among the active channels, from 1, otherwise 0.
    pub by_index: u32,
    /// An axis of the channel, from 1; for a list of objects with channel 0, a platform axis; in an
    /// object address, 0 is the channel itself.
    pub axis: u32,
    /// The index of a variable, from 0, or of a parameter or an object, from 1.
    pub index: u32,
    /// The number of descriptors to read.
    pub count: u32,
    /// The maximum number of bytes of content to read.
    pub size: u32,
    /// Handle of a variable.
    pub handle: u32,
    /// Index group of an element or object.
    pub index_group: u32,
    /// Index offset of an element or object.
    pub index_offset: u32,
    /// The kind of variables or parameters, such as "V.E" or "P", or the class, such as "decoder".
    pub kind: AdsCncBytes,
    /// Name of a variable or parameter, CP1252, without a NUL.
    pub name: AdsCncBytes,
    /// The bytes to write.
    pub value: AdsCncBytes,
    /// Index in each dimension, from 0.
    pub indices: *const u32,
    /// The number of indices.
    pub indices_count: u32,
}

/// An ADS call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct AdsCncCall {
    /// The AMS port.
    pub port: u32,
    /// The AMS command: 2 Read, 3 Write, 9 ReadWrite.
    pub command: u32,
    /// The index group.
    pub index_group: u32,
    /// The index offset.
    pub index_offset: u32,
    /// The maximum length of the reply in bytes.
    pub read_length: u32,
    /// The data of the request.
    pub data: AdsCncBytes,
}

impl AdsCncCall {
    pub(crate) fn of(call: &Call<'_>) -> Self {
        Self {
            port: call.port.0.into(),
            command: call.service.command().0.into(),
            index_group: call.index_group.get(),
            index_offset: call.index_offset.get(),
            read_length: call.read_length,
            data: AdsCncBytes::of(call.data),
        }
    }

    /// # Safety
    /// The pointer in `data` points to the bytes of the call.
    pub(crate) unsafe fn call<'a>(&self) -> Result<Call<'a>, Fault> {
        Ok(Call {
            port: AmsPort(u16::try_from(self.port).map_err(|_| Fault::Argument("port"))?),
            service: service(self.command).ok_or(Fault::Argument("command"))?,
            index_group: IndexGroup::new(self.index_group),
            index_offset: IndexOffset::new(self.index_offset),
            read_length: self.read_length,
            // SAFETY: the caller's contract.
            data: unsafe { self.data.get()? },
        })
    }
}

/// Names that the codec displays but does not return as `&str`. A test compares them with the
/// displayed names.
pub(crate) const KINDS: [&str; 4] = ["P", "V.L", "V.P", "V.S"];
pub(crate) const CLASSES: [&str; 6] =
    ["position controller", "interpolator", "decoder", "HLD", "path preparation", "spindle"];

/// The arguments of a request, with its pointers converted to slices.
struct Arguments<'a> {
    it: &'a AdsCncRequest,
    kind: &'a [u8],
    name: &'a [u8],
    value: &'a [u8],
    indices: &'a [u32],
}

impl<'a> Arguments<'a> {
    fn by_index(&self) -> Result<bool, Fault> {
        match self.it.by_index {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Fault::Argument("by_index")),
        }
    }

    fn channel(&self) -> Result<Channel, Fault> {
        let new = if self.by_index()? { Channel::by_index } else { Channel::new };
        Ok(new(self.it.channel)?)
    }

    fn list(&self) -> Result<op::ObjectList, Fault> {
        match (self.it.channel, self.it.axis, self.by_index()?) {
            (0, 0, false) => Ok(op::ObjectList::PLATFORM),
            (0, axis, false) => Ok(PlatformAxis::new(axis)?.into()),
            (_, 0, _) => Ok(self.channel()?.into()),
            _ => Err(Fault::Argument("axis")),
        }
    }

    fn axis(&self) -> Result<ChannelAxis, Fault> {
        Ok(ChannelAxis::new(self.it.axis)?)
    }

    fn name(&self) -> Result<CncStr<'a>, Fault> {
        Ok(CncStr::from_bytes(self.name)?)
    }

    fn kind(&self) -> Result<Kind<'a>, Fault> {
        Ok(Kind::from_field(CncStr::from_bytes(self.kind)?.into()))
    }

    /// Returns the item of `all` whose name in `names` is the argument `kind`.
    fn one_of<T>(&self, all: impl IntoIterator<Item = T>, names: &[&str]) -> Result<T, Fault> {
        let named = all.into_iter().zip(names).find(|(_, name)| name.as_bytes() == self.kind);
        named.map(|(one, _)| one).ok_or(Fault::Argument("kind"))
    }

    fn parameters(&self) -> Result<DynamicKind, Fault> {
        self.one_of(DynamicKind::ALL, &KINDS)
    }

    fn instance(&self) -> Result<op::FindInstance, Fault> {
        let class = self.one_of(Class::ALL, &CLASSES)?;
        let find = op::FindInstance::new(class, self.it.channel, self.it.axis);
        Ok(if self.by_index()? { find.by_index() } else { find })
    }

    fn element(&self) -> Result<ElementAddress, Fault> {
        match self.group().parts() {
            Some(Group::Class(group)) => Ok(ElementAddress::new(group, self.offset())),
            _ => Err(Fault::Argument("index_group")),
        }
    }

    fn group(&self) -> IndexGroup {
        IndexGroup::new(self.it.index_group)
    }

    fn offset(&self) -> IndexOffset {
        IndexOffset::new(self.it.index_offset)
    }

    fn handle(&self) -> Handle {
        Handle(self.it.handle)
    }

    fn indices(&self) -> U32List<'a> {
        self.indices.into()
    }
}

/// Builds each operation from its arguments. A test checks that a function needs the arguments that
/// `ads_cnc_function_info` lists for it.
macro_rules! operations {
    ($all:ident: $( $how:ident $function:ident($( $argument:expr ),+); )+) => {
        fn made<'a>(function: Function, $all: &Arguments<'a>) -> Result<Request<'a>, Fault> {
            Ok(match function {
                $( Function::$function => operations!(@$how op::$function::new($( $argument ),+)).into(), )+
                Function::FindInstance => $all.instance()?.into(),
                _ => return Err(Fault::NoFunction),
            })
        }

        /// The name of the type of the operation.
        pub(crate) fn operation_name(function: Function) -> &'static str {
            match function {
                $( Function::$function => stringify!($function), )+
                Function::FindInstance => "FindInstance",
                _ => "",
            }
        }
    };
    (@plain $made:expr) => { $made };
    (@checked $made:expr) => { $made? };
}

operations! { all:
    plain CountObjects(all.list()?);
    checked ReadDescriptors(all.list()?, all.it.index, all.it.count);
    plain CountVariables(all.channel()?, all.kind()?);
    plain DescribeByIndex(all.channel()?, all.it.index, all.kind()?);
    checked HandleByName(all.channel()?, all.name()?);
    plain ReadByHandle(all.channel()?, all.handle(), all.indices());
    checked ReadByName(all.channel()?, all.name()?);
    plain WriteByHandle(all.channel()?, all.handle(), all.indices(), all.value);
    checked WriteByName(all.channel()?, all.name()?, all.value);
    plain DescribeExtended(all.channel()?, all.it.index, all.kind()?);
    checked DescribeByName(all.channel()?, all.name()?);
    checked AxisHandleByName(all.channel()?, all.axis()?, all.name()?);
    checked AxisReadByName(all.channel()?, all.axis()?, all.name()?);
    checked AxisWriteByName(all.channel()?, all.axis()?, all.name()?, all.value);
    plain CountDynamic(all.channel()?, all.parameters()?);
    checked DynamicNameByIndex(all.channel()?, all.parameters()?, all.it.index);
    checked DynamicValueByName(all.channel()?, all.parameters()?, all.name()?);
    checked DynamicValueByIndex(all.channel()?, all.parameters()?, all.it.index);
    checked CountElements(all.element()?);
    checked ReadElement(all.element()?, all.it.size);
    checked WriteElement(all.element()?, all.value);
    plain ReadElementName(all.element()?);
    plain ReadElementType(all.element()?);
    plain ReadElementLength(all.element()?);
    plain ReadElementUnit(all.element()?);
    plain ReadElementWriteFlag(all.element()?);
    plain WriteProgramStream(all.channel()?, all.value);
    checked ReadObject(all.group(), all.offset(), all.it.size);
    checked WriteObject(all.group(), all.offset(), all.value);
}

/// # Safety
/// `it` is null or points to a request, and each pointer of the request is null or points to the
/// number of items that the request states; none of these items is written during `'a`.
unsafe fn request<'a>(it: *const AdsCncRequest) -> Result<Request<'a>, Fault> {
    // SAFETY: the caller's contract.
    let it = unsafe { get(it)? };
    // SAFETY: the caller's contract.
    let all = unsafe {
        Arguments {
            it,
            kind: it.kind.get()?,
            name: it.name.get()?,
            value: it.value.get()?,
            indices: slice(it.indices, it.indices_count)?,
        }
    };
    made(function(it.function).ok_or(Fault::NoFunction)?, &all)
}

/// Encodes the data of a request to `buffer`, and writes the call to send to `call`.
///
/// # Safety
/// Each pointer of the request points to the number of items that the request states; `buffer`
/// points to `room` bytes; `call` and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_encode(
    request: *const AdsCncRequest,
    buffer: *mut u8,
    room: u32,
    call: *mut AdsCncCall,
    error: *mut AdsCncError,
) -> bool {
    let encode = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let (request, buffer) = unsafe { (self::request(request)?, self::room(buffer, room)?) };
        let encoded = request.encode(buffer)?;
        // SAFETY: the caller's contract.
        unsafe { put(call, AdsCncCall::of(&encoded)) };
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(encode(), error) }
}

/// Checks the data of the reply to a request, and returns its fields.
///
/// # Safety
/// Each pointer of the request points to the number of items that the request states; `data` points
/// to `length` bytes; `fields` is null or points to memory for `room` values; `count` and `error`
/// are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_decode_reply(
    request: *const AdsCncRequest,
    data: *const u8,
    length: u32,
    fields: *mut AdsCncField,
    room: u32,
    count: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let decode = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let (request, data) = unsafe { (self::request(request)?, bytes(data, length)?) };
        request.decode_reply(data)?;
        let Some(stream) = request.function().spec().reply else {
            // SAFETY: the caller's contract.
            unsafe { put(count, 0) };
            return Ok(());
        };
        // SAFETY: the caller's contract.
        unsafe { walk(stream, data, fields, room, count) }
    };
    // SAFETY: the caller's contract.
    unsafe { told(decode(), error) }
}

/// Sets the arguments that the address of a call contains.
fn address(function: Function, call: &Call<'_>, it: &mut AdsCncRequest) {
    let spec = function.spec();
    let Some(group) = call.index_group.parts() else { return };
    let (addressing, instance) = match group {
        Group::Com(com) => (com.addressing, com.instance),
        Group::Class(class) => (class.addressing, class.instance),
    };
    let text = |text: &str| AdsCncBytes::of(text.as_bytes());
    match (spec.group, group) {
        // The argument for an element is the address of its content, for every attribute.
        (GroupRule::Elements(_), Group::Class(parts)) => {
            let content = ClassGroup { attribute: Attribute::Content, ..parts };
            (it.index_group, it.index_offset) =
                (content.index_group().get(), call.index_offset.get());
            return;
        }
        (GroupRule::ComContent, _) => {
            (it.index_group, it.index_offset) = (call.index_group.get(), call.index_offset.get());
            return;
        }
        (GroupRule::Instances, Group::Class(parts)) => {
            let name = Class::ALL.into_iter().zip(CLASSES).find(|(class, _)| *class == parts.class);
            it.kind = name.map_or(AdsCncBytes::NONE, |(_, name)| text(name));
        }
        (_, Group::Com(com)) if com.table == ComTable::Axis => it.axis = instance.into(),
        _ => it.channel = instance.into(),
    }
    it.by_index = u32::from(addressing == Addressing::Index && instance > 0);
    if let (GroupRule::Instances, Group::Class(parts)) = (spec.group, group) {
        let is_spindle = parts.class == Class::Spindle;
        it.by_index = u32::from(addressing == Addressing::Index && !is_spindle);
    }
    match spec.offset {
        OffsetRule::AtLeast(_) => it.index = call.index_offset.get(),
        OffsetRule::OfAxis(_) => {
            let place = call.index_offset.axis_and_element(AxisStride::X10000);
            it.axis = place.map_or(0, |(axis, _)| axis);
        }
        OffsetRule::OfKind(offsets) => {
            let is = |(offset, _): &(u32, _)| *offset == call.index_offset.get();
            let name = offsets.into_iter().zip(KINDS).find(is);
            it.kind = name.map_or(AdsCncBytes::NONE, |(_, name)| text(name));
        }
        _ => {}
    }
}

/// Sets the arguments that the data of a call contains.
///
/// # Safety
/// `indices` is null or points to memory for `room` numbers.
unsafe fn data(
    function: Function,
    call: &Call<'_>,
    (indices, room): (*mut u32, u32),
    it: &mut AdsCncRequest,
) -> Result<(), Fault> {
    let Some(stream) = function.spec().request else { return Ok(()) };
    stream.walk(call.data, |segment| {
        let four = segment.bytes.first_chunk().map_or(0, |four| u32::from_le_bytes(*four));
        let text = segment.bytes.split(|byte| *byte == 0).next().unwrap_or_default();
        match argument(segment.field) {
            1 => it.channel = four,
            2 => it.axis = four,
            3 => it.index = four,
            6 => it.handle = four,
            9 => it.kind = AdsCncBytes::of(text),
            10 => it.name = AdsCncBytes::of(text),
            11 => it.value = AdsCncBytes::of(segment.bytes),
            12 => {
                // SAFETY: the caller's contract.
                unsafe { put_item(indices, room, segment.item, four) };
                it.indices_count = segment.item.saturating_add(1);
            }
            _ => {}
        }
    })?;
    if it.indices_count > 0 {
        it.indices = indices;
    }
    match it.indices_count > room || (it.indices_count > 0 && indices.is_null()) {
        true => Err(Fault::Room(it.indices_count, room)),
        false => Ok(()),
    }
}

/// Decodes a received call to its function and arguments. Names and values point into the data of
/// the call; `indices` needs room for up to 510 indices.
///
/// # Safety
/// `call` points to a call, and the call to its data; `indices` is null or points to memory for
/// `room` numbers; `request`, `ads_error` and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_dispatch(
    call: *const AdsCncCall,
    indices: *mut u32,
    room: u32,
    request: *mut AdsCncRequest,
    ads_error: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let dispatch = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let call = unsafe { get(call)?.call()? };
        let dispatched = call.dispatch().map_err(Fault::Dispatch)?;
        let function = dispatched.function();
        let number = Function::ALL.iter().position(|it| *it == function).map_or(0, to_u32);
        let mut it = AdsCncRequest { function: number, ..EMPTY };
        address(function, &call, &mut it);
        match dispatched {
            Request::ReadDescriptors(read) => it.count = read.count(),
            Request::ReadElement(_) | Request::ReadObject(_) => it.size = call.read_length,
            _ => {}
        }
        // SAFETY: the caller's contract.
        unsafe { data(function, &call, (indices, room), &mut it)? };
        // SAFETY: the caller's contract.
        unsafe { put(request, it) };
        Ok(())
    };
    let result = dispatch();
    let number = match result {
        Ok(()) => 0,
        Err(Fault::Dispatch(error)) => error.ads_error().0,
        // Other errors, such as an unknown command, a port of more than 16 bits, a null pointer, or
        // too little room for the indices.
        Err(_) => codec::ads::AdsError::SERVICE_NOT_SUPPORTED.0,
    };
    // SAFETY: the caller's contract.
    unsafe { put(ads_error, number) };
    // SAFETY: the caller's contract.
    unsafe { told(result, error) }
}

const EMPTY: AdsCncRequest = AdsCncRequest {
    function: 0,
    channel: 0,
    by_index: 0,
    axis: 0,
    index: 0,
    count: 0,
    size: 0,
    handle: 0,
    index_group: 0,
    index_offset: 0,
    kind: AdsCncBytes::NONE,
    name: AdsCncBytes::NONE,
    value: AdsCncBytes::NONE,
    indices: core::ptr::null(),
    indices_count: 0,
};
