//! Changes to a reply: to its bytes, or to the way in which they are sent.

use std::time::Duration;

use ads_cnc::Encode as _;
use ads_cnc::ads::{AdsError, AmsHeader, Command, FrameRef, StateFlags};
use ads_cnc::limits::{DESCRIPTOR_LEN, TEXT_MAX};
use ads_cnc::operation::AdsService;

use crate::ads_service::{decode_reply, encode_reply, service_of};

/// How a reply is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tamper {
    /// Sends one byte at a time.
    Bytewise,
    /// Sends two pieces with a pause between them; the first piece has this many bytes.
    Pieces(usize),
    /// Sends a reply with another invoke ID and, if it has data, other data, and then the reply, in
    /// one write.
    Foreign,
    /// Sends the reply twice, in one write.
    Twice,
    /// Sends the reply to the previous request once more, and then the reply, in one write.
    Late,
    /// Sends only a reply with another invoke ID and, if it has data, other data, and closes the
    /// connection after a pause.
    OtherInvokeId,
    /// Sends a reply with a wrong length field, and closes the connection after a pause.
    Length(LengthField, WrongLength),
    /// Sends a reply with another command in its AMS header, and closes the connection after a
    /// pause.
    OtherCommand,
    /// Sends a reply with the state flags of a request, and closes the connection after a pause.
    Request,
    /// Sends an error in the AMS header, without service data.
    AmsError,
    /// Sends an error in the result field, without the length field and the data.
    BareResult,
    /// Sends an error in the result field, with the length 0 and no data.
    EmptyResult,
    /// Sends an error in the result field, but the length and data of the successful reply.
    ResultWithData,
    /// Closes the connection after this many bytes of the reply.
    CutAt(usize),
    /// Closes the connection before the last byte of the reply.
    CutEnd,
    /// Sends no reply.
    Silence,
    /// Appends this many bytes to the data; all length fields match.
    More(usize),
    /// Removes this many bytes from the end of the data; all length fields match.
    Less(usize),
    /// Sends only this many bytes of the data; all length fields match.
    Only(usize),
    /// Pads the name that begins at this offset of the data with NULs to 256 bytes.
    Padded(usize),
    /// Removes the NUL at the end of the data.
    Open,
    /// Replaces the four bytes of the data at this offset.
    Patch(usize, [u8; 4]),
    /// Sends at most this many descriptors of a list.
    Descriptors(usize),
}

/// A length field of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LengthField {
    /// The length of the AMS/TCP header.
    AmsTcp,
    /// The data length of the AMS header.
    Ams,
    /// The length before the data of the reply.
    Data,
}

/// A wrong value for a length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WrongLength {
    /// One more than the right value.
    Longer,
    /// One less than the right value.
    Shorter,
    /// 0.
    Zero,
    /// All bits set.
    Huge,
}

/// A step of sending a reply.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum SendStep {
    Send(Vec<u8>),
    Pause(Duration),
    Close,
}

/// A pause in which a client should read the bytes sent before the pause.
const PAUSE: Duration = Duration::from_millis(40);

/// The AMS error with which an AMS router reports an unknown port.
const AMS_ERROR: AdsError = AdsError::TARGET_PORT_NOT_FOUND;

impl Tamper {
    /// The steps that send the changed reply. `before` is the unchanged reply to the previous
    /// request on the same connection.
    pub(super) fn steps(self, reply: &[u8], before: Option<&[u8]>) -> Vec<SendStep> {
        let send = |bytes: Vec<u8>| vec![SendStep::Send(bytes)];
        let then_close =
            |bytes: Vec<u8>| vec![SendStep::Send(bytes), SendStep::Pause(PAUSE), SendStep::Close];
        let all = || reply.to_vec();
        match self {
            Self::Bytewise => reply.iter().map(|&byte| SendStep::Send(vec![byte])).collect(),
            Self::Pieces(at) => {
                let (front, rest) = reply.split_at(at.min(reply.len()));
                vec![
                    SendStep::Send(front.to_vec()),
                    SendStep::Pause(PAUSE),
                    SendStep::Send(rest.to_vec()),
                ]
            }
            Self::Foreign => send([foreign(reply), all()].concat()),
            Self::Twice => send([all(), all()].concat()),
            Self::Late => send([before.unwrap_or_default().to_vec(), all()].concat()),
            Self::OtherInvokeId => then_close(foreign(reply)),
            Self::Length(place, wrong) => then_close(with_length(reply, place, wrong)),
            Self::OtherCommand => then_close(with_header(reply, |header| {
                header.command = match header.command {
                    Command::READ => Command::READ_WRITE,
                    _ => Command::READ,
                };
            })),
            Self::Request => {
                then_close(with_header(reply, |header| header.state_flags = StateFlags::REQUEST))
            }
            Self::AmsError => send(rebuilt(reply, |header, body| {
                header.error = AMS_ERROR;
                *body = None;
            })),
            Self::BareResult => send(rebuilt(reply, |_, body| {
                *body = Some((AdsError::INVALID_DATA, None));
            })),
            Self::EmptyResult => send(rebuilt(reply, |_, body| {
                *body = Some((AdsError::INVALID_DATA, Some(Vec::new())));
            })),
            Self::ResultWithData => send(rebuilt(reply, |_, body| {
                if let Some((result, _)) = body {
                    *result = AdsError::INVALID_DATA;
                }
            })),
            Self::CutAt(len) => {
                vec![SendStep::Send(reply.iter().take(len).copied().collect()), SendStep::Close]
            }
            Self::CutEnd => {
                let len = reply.len().saturating_sub(1);
                vec![SendStep::Send(reply.iter().take(len).copied().collect()), SendStep::Close]
            }
            Self::Silence => Vec::new(),
            Self::More(count) => send(with_data(reply, |data| {
                data.resize(data.len().saturating_add(count), 0x2A);
            })),
            Self::Less(count) => {
                send(with_data(reply, |data| data.truncate(data.len().saturating_sub(count))))
            }
            Self::Only(len) => send(with_data(reply, |data| data.truncate(len))),
            Self::Padded(name) => {
                send(with_data(reply, |data| data.resize(name.saturating_add(TEXT_MAX), 0)))
            }
            Self::Open => send(with_data(reply, |data| {
                if data.last() == Some(&0) {
                    data.pop();
                }
            })),
            Self::Patch(at, bytes) => send(with_data(reply, |data| {
                data.iter_mut().skip(at).zip(bytes).for_each(|(byte, new)| *byte = new);
            })),
            Self::Descriptors(count) => {
                send(with_data(reply, |data| data.truncate(count.saturating_mul(DESCRIPTOR_LEN))))
            }
        }
    }
}

/// The result of a reply and its data, which is `None` for a Write, and if the reply ends after the
/// result; `None` if nothing follows the headers.
type ReplyBody = Option<(AdsError, Option<Vec<u8>>)>;

/// The reply, changed and encoded again with matching lengths. A reply that does not decode, or
/// cannot be encoded after the change, is left unchanged.
fn rebuilt(reply: &[u8], change: impl FnOnce(&mut AmsHeader, &mut ReplyBody)) -> Vec<u8> {
    let rebuilt = || {
        let (frame, _) = FrameRef::split(reply, u32::MAX).ok().flatten()?;
        let mut header = frame.header();
        // A reply to a command that is not a service is decoded like a reply to a Write: a result
        // without data.
        let service = service_of(header.command).unwrap_or(AdsService::Write);
        let (result, data) = decode_reply(service, frame.data()).ok()?;
        let mut body = Some((result, data.map(<[u8]>::to_vec)));
        change(&mut header, &mut body);
        let bytes = match body {
            None => Vec::new(),
            Some((result, data)) => encode_reply(service, result, data.as_deref()).ok()?,
        };
        FrameRef::new(header, &bytes).ok()?.encode_to_vec().ok()
    };
    rebuilt().unwrap_or_else(|| reply.to_vec())
}

fn with_header(reply: &[u8], change: impl FnOnce(&mut AmsHeader)) -> Vec<u8> {
    rebuilt(reply, |header, _| change(header))
}

fn with_data(reply: &[u8], change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    rebuilt(reply, |_, body| {
        if let Some((_, Some(data))) = body {
            change(data);
        }
    })
}

/// The reply with another invoke ID and, if it has data, other data of the same length.
fn foreign(reply: &[u8]) -> Vec<u8> {
    let other = with_data(reply, |data| {
        for byte in data.iter_mut() {
            *byte ^= 0x15;
        }
    });
    with_header(&other, |header| header.invoke_id = header.invoke_id.wrapping_add(0x0100_0000))
}

/// The reply with one length field overwritten, and all other bytes unchanged.
fn with_length(reply: &[u8], place: LengthField, wrong: WrongLength) -> Vec<u8> {
    // Offsets in the frame: 6 bytes of AMS/TCP header, 32 of AMS header, 4 of result.
    let at = match place {
        LengthField::AmsTcp => 2,
        LengthField::Ams => 26,
        LengthField::Data => 42,
    };
    let mut bytes = reply.to_vec();
    if let Some(Ok(field)) = bytes.get_mut(at..).map(|rest| {
        let field: Result<&mut [u8; 4], _> = rest.get_mut(..4).unwrap_or_default().try_into();
        field
    }) {
        let number = u32::from_le_bytes(*field);
        let other = match wrong {
            WrongLength::Longer => number.wrapping_add(1),
            WrongLength::Shorter => number.wrapping_sub(1),
            WrongLength::Zero => 0,
            WrongLength::Huge => u32::MAX,
        };
        *field = other.to_le_bytes();
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reply with the number 123: headers, result 0, length 4, data.
    fn reply() -> Vec<u8> {
        let mut bytes = vec![0, 0, 44, 0, 0, 0];
        bytes.extend([127, 0, 0, 1, 1, 2, 0, 0x80, 127, 0, 0, 1, 1, 1, 0x28, 2]);
        bytes.extend([9, 0, 5, 0, 12, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0]);
        bytes.extend([0, 0, 0, 0, 4, 0, 0, 0, 123, 0, 0, 0]);
        bytes
    }

    fn sent(tamper: Tamper) -> Vec<u8> {
        let steps = tamper.steps(&reply(), None);
        let sent = steps.into_iter().filter_map(|deed| match deed {
            SendStep::Send(bytes) => Some(bytes),
            _ => None,
        });
        sent.flatten().collect()
    }

    #[test]
    fn only_the_chosen_length_is_wrong() {
        let at = |tamper, place: usize| sent(tamper)[place..place + 4].to_vec();
        assert_eq!(at(Tamper::Length(LengthField::AmsTcp, WrongLength::Longer), 2), [45, 0, 0, 0]);
        assert_eq!(at(Tamper::Length(LengthField::Ams, WrongLength::Shorter), 26), [11, 0, 0, 0]);
        assert_eq!(at(Tamper::Length(LengthField::Data, WrongLength::Huge), 42), [0xFF; 4]);
        for wrong in
            [WrongLength::Longer, WrongLength::Shorter, WrongLength::Zero, WrongLength::Huge]
        {
            for place in [LengthField::AmsTcp, LengthField::Ams, LengthField::Data] {
                let sent = sent(Tamper::Length(place, wrong));
                let differing = sent.iter().zip(reply()).filter(|(new, old)| **new != *old);
                assert!(sent.len() == 50 && differing.count() >= 1);
            }
        }
    }

    #[test]
    fn a_rebuilt_reply_is_valid_except_for_the_change() {
        assert_eq!(sent(Tamper::Bytewise), reply());
        assert_eq!(sent(Tamper::Pieces(7)), reply());
        assert_eq!(sent(Tamper::Less(1)).len(), 49);
        assert_eq!(sent(Tamper::Less(1))[2..6], [43, 0, 0, 0]);
        assert_eq!(sent(Tamper::More(1))[42..46], [5, 0, 0, 0]);
        assert_eq!(sent(Tamper::AmsError).len(), 38);
        assert_eq!(sent(Tamper::AmsError)[30..34], [6, 0, 0, 0]);
        assert_eq!(sent(Tamper::BareResult)[38..], [6, 7, 0, 0]);
        assert_eq!(sent(Tamper::EmptyResult)[38..], [6, 7, 0, 0, 0, 0, 0, 0]);
        let with_data = sent(Tamper::ResultWithData);
        assert_eq!(with_data[38..], [6, 7, 0, 0, 4, 0, 0, 0, 123, 0, 0, 0]);
        assert_eq!(sent(Tamper::Foreign)[50..], reply());
        assert_eq!(sent(Tamper::Foreign)[34..38], [7, 0, 0, 1]);
        assert_eq!(sent(Tamper::CutEnd), reply()[..49]);
    }
}
