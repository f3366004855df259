//! Operations that a client encodes to calls, their dispatch by a server, and the replies.

use ads_cnc::ErrorKind;
use ads_cnc::address::{
    Channel, ChannelAxis, Class, IndexGroup, IndexOffset, PlatformAxis, Spindle,
};
use ads_cnc::ads::AmsPort;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{AdsService, Call, Function, ReadDescriptors};
use ads_cnc::text::cp1252_to_char;

use super::bytes::{bend_among, shown};
use super::input::Input;
use crate::common::{self, Parameters};
use crate::{Defect, Outcome};

/// Input: a call: port (2 bytes), service (1), group, offset and read length (4 each), data.
///
/// The dispatch rejects the call, or gives a request that encodes to a call with the same service,
/// address and data; this call is dispatched to the same request.
pub(crate) fn dispatch(data: &[u8], defect: Defect) -> Outcome {
    let Some(call) = read_call(data) else { return Outcome::unread() };
    // The first two defects are implemented below; the third is number 6 of `bytes::DEFECTS`.
    let bent = common::check_call_bent(&call, &bend_among(&[0, 0, 6], defect), |again| {
        if defect.is(1) {
            again.index_group = IndexGroup::new(again.index_group.get() & !0x10_0000);
        }
        if defect.is(2) && again.data.len() > 8 {
            again.data = &again.data[..8];
        }
    });
    match bent {
        Ok(function) => Outcome::accepted((function, data)),
        Err(rejection) => Outcome::rejected(format!("{rejection:?}")),
    }
}

pub(crate) const DISPATCH_DEFECTS: &[&str] = &[
    "a logical group is encoded as one by index",
    "the bytes after the eighth byte of a request are lost",
    "a buffer that is too small is written into",
];

/// Input: an index of the function (1 byte), then the parameters of its operation, see [`parameters`].
///
/// A server dispatches the encoded operation to the same operation, or the operation is rejected;
/// within the documented ranges, it is rejected only if another function has its address.
pub(crate) fn request(data: &[u8], defect: Defect) -> Outcome {
    let Some((&pick, bytes)) = data.split_first() else { return Outcome::unread() };
    let Some(&function) = Function::ALL.get(usize::from(pick)) else { return Outcome::unread() };
    let (mut text, mut indices) = (String::new(), Vec::new());
    let Some(of) = parameters(bytes, &mut text, &mut indices) else { return Outcome::unread() };
    let made = common::check_made(function, &of, &|call| {
        if defect.is(1) {
            call.index_group = IndexGroup::new(call.index_group.get() & !0x10_0000);
        }
        if defect.is(2) && call.data.len() > 8 {
            call.data = &call.data[..8];
        }
        if defect.is(3) && call.index_offset.get() > 0x1_0000 {
            call.index_offset = IndexOffset::new(call.index_offset.get() & 0xFFFF);
        }
        if defect.is(4) && call.read_length > 0x100 {
            call.read_length &= 0xFF;
        }
        if defect.is(5) && call.data.len() > 60 {
            call.port = AmsPort::COM;
        }
    });
    match made {
        // The server dispatches the operation to the same operation, so the input serves as the result.
        Ok(()) => Outcome::accepted(data),
        Err(error) => {
            let rejected = error.kind() != ErrorKind::Function || defect.is(6);
            assert!(!(rejected && is_documented(&of)), "{function:?}, {of:?}: {error}");
            Outcome::rejected(shown(error))
        }
    }
}

pub(crate) const REQUEST_DEFECTS: &[&str] = &[
    "a logical group is encoded as one by index",
    "the bytes after the eighth byte of a request are lost",
    "the axis in an offset is lost",
    "a read length above 256 loses its upper bits",
    "a long request goes to a different port",
    "an element at the offset of a function is rejected with a different error",
];

/// Reads the parameters of an operation: channel (2 bytes), platform axis (1), channel axis (2), spindle,
/// class, kind of dynamic parameter, selector of a list, group or address (1 each), element (2),
/// number and count (4 each), text and indices, each after a byte with its length; the rest is
/// content.
fn parameters<'a>(
    bytes: &'a [u8],
    text: &'a mut String,
    indices: &'a mut Vec<u32>,
) -> Option<Parameters<'a>> {
    let mut input = Input::new(bytes);
    let (channel, by_index) = (input.byte(), input.byte() % 2 == 1);
    let number = u32::from(channel);
    let channel = if by_index { Channel::by_index(number) } else { Channel::new(number) };
    let (platform_axis, axis) = (input.byte(), input.word());
    let parameters = Parameters {
        channel: channel.ok()?,
        platform_axis: PlatformAxis::new(platform_axis.into()).ok()?,
        axis: ChannelAxis::new(axis.into()).ok()?,
        spindle: Spindle::new(input.byte().into()).ok()?,
        class: *input.choose(&Class::ALL),
        dynamic: *input.choose(&DynamicKind::ALL),
        place: input.byte(),
        element: input.word().into(),
        number: input.long(),
        count: input.long(),
        text: {
            text.extend(input.piece().iter().map(|&byte| cp1252_to_char(byte)));
            text
        },
        indices: {
            let count = input.byte();
            // At most as many indices as the input has bytes for.
            indices.extend((0..count).map_while(|_| (!input.is_empty()).then(|| input.long())));
            indices
        },
        bytes: input.bytes(usize::MAX),
    };
    Some(parameters)
}

/// Whether these parameters are within the documented ranges. An operation with such parameters may
/// be rejected only because another function has its address.
fn is_documented(of: &Parameters<'_>) -> bool {
    let text = !of.text.contains('\0') && of.text.chars().count() <= 95;
    let count = (1..=ReadDescriptors::COUNT_MAX).contains(&of.count);
    text && count && of.number > 0 && (1..=992).contains(&of.bytes.len())
}

/// Input: the length of a call (2 bytes), the call as in [`dispatch`], and the reply.
///
/// A request accepts as a reply the bytes that the stream of its function accepts, but no more
/// bytes than its read length; the reply encodes to the same bytes.
pub(crate) fn reply(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let call = input.long_piece();
    let Some(call) = read_call(call) else { return Outcome::unread() };
    if let Err(rejection) = call.dispatch() {
        return Outcome::rejected(format!("{rejection:?}"));
    }
    let bytes = input.bytes(usize::MAX);
    // The fourth defect is implemented below; the others are those of `bytes::DEFECTS` with these numbers.
    let mut mutation = bend_among(&[1, 2, 3, 0, 6, 7, 8], defect);
    if defect.is(4) {
        mutation.len = |len| {
            len.or_else(|error| match error.kind() {
                ErrorKind::TooLong | ErrorKind::TooMany => Ok(error.found() as usize),
                _ => Err(error),
            })
        };
    }
    match common::check_reply_bent(&call, bytes, &mutation) {
        Ok(function) => Outcome::accepted((function, data)),
        Err(error) => Outcome::rejected(shown(error)),
    }
}

pub(crate) const REPLY_DEFECTS: &[&str] = &[
    "the last byte loses its top bit when it is encoded",
    "the offset of an error after the first eight bytes is off by one",
    "the announced length is one too high if it is eight or more",
    "more bytes than the request has room for are accepted",
    "a buffer that is too small is written into",
    "an error has a different kind",
    "an error lacks its field",
];

/// Writes an input of [`reply`].
pub(crate) fn write_reply(call: &Call<'_>, bytes: &[u8]) -> Vec<u8> {
    let call = write_call(call);
    let len = u16::try_from(call.len()).expect("a sample is short");
    [&len.to_le_bytes()[..], &call, bytes].concat()
}

/// Reads a call in the form of [`dispatch`].
pub(crate) fn read_call(bytes: &[u8]) -> Option<Call<'_>> {
    let (&port, bytes) = bytes.split_first_chunk()?;
    let (&service, bytes) = bytes.split_first()?;
    let (&group, bytes) = bytes.split_first_chunk()?;
    let (&offset, bytes) = bytes.split_first_chunk()?;
    let (&read_length, data) = bytes.split_first_chunk()?;
    let service = *SERVICES.get(usize::from(service))?;
    Some(Call {
        port: AmsPort(u16::from_le_bytes(port)),
        service,
        index_group: IndexGroup::new(u32::from_le_bytes(group)),
        index_offset: IndexOffset::new(u32::from_le_bytes(offset)),
        read_length: u32::from_le_bytes(read_length),
        // A Read has no data.
        data: if service == AdsService::Read { &[] } else { data },
    })
}

/// Writes a call in the form that [`read_call`] reads.
pub(crate) fn write_call(call: &Call<'_>) -> Vec<u8> {
    let mut bytes = call.port.0.to_le_bytes().to_vec();
    let service = SERVICES.iter().position(|&service| service == call.service);
    bytes.extend(service.and_then(|place| u8::try_from(place).ok()));
    for number in [call.index_group.get(), call.index_offset.get(), call.read_length] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(call.data);
    bytes
}

const SERVICES: [AdsService; 3] = [AdsService::Read, AdsService::Write, AdsService::ReadWrite];
