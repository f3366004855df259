//! Printed requests and replies as whole frames: the data that the manuals print and handwritten
//! headers, without the codec. These frames can detect errors of the codec, which this project's
//! client and the simulated CNC share.

use crate::number::to_u32;

/// A printed example: the expected request and its reply.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Literal {
    /// The command number of the service: 2 Read, 3 Write, 9 ReadWrite.
    pub(super) command: u8,
    pub(super) port: u16,
    pub(super) group: u32,
    pub(super) offset: u32,
    pub(super) data: Vec<u8>,
    /// The length in bytes to which a client may pad `data` with NULs, if `data` is a name;
    /// otherwise 0.
    pub(super) padded: usize,
    /// The data of the reply, without result and length; empty for a Write.
    pub(super) reply: Vec<u8>,
}

/// Length of the AMS/TCP header and the AMS header.
const HEADERS: usize = 38;

impl Literal {
    /// The request and its equivalents: with the channel addressed by rank, and with a padded name.
    fn forms(&self) -> Vec<Self> {
        let by_index = Self { group: self.group & !0x10_0000, ..self.clone() };
        let mut forms = vec![self.clone(), by_index];
        if self.padded > 0 {
            let filled = |one: &Self| {
                let mut data = one.data.clone();
                data.resize(self.padded, 0);
                Self { data, ..one.clone() }
            };
            let all: Vec<Self> = forms.iter().map(filled).collect();
            forms.extend(all);
        }
        forms
    }

    /// The service data of the request before the read length, and after it; for a Write, which has
    /// no read length, the address and the rest. The read length is not compared, because the
    /// client may choose it.
    fn request(&self) -> (Vec<u8>, Vec<u8>) {
        let mut front = self.group.to_le_bytes().to_vec();
        front.extend(self.offset.to_le_bytes());
        let mut after = Vec::new();
        if self.command != 2 {
            let length = to_u32(self.data.len());
            after.extend(length.to_le_bytes());
            after.extend(&self.data);
        }
        (front, after)
    }

    /// Whether a frame is this request; its NetIds, source port, invoke ID and read length are not
    /// compared.
    fn is(&self, frame: &[u8]) -> bool {
        let (front, after) = self.request();
        let between = if self.command == 3 { 0_usize } else { 4 };
        let len = front.len().saturating_add(between).saturating_add(after.len());
        let at = |start: usize, bytes: &[u8]| {
            frame.get(start..start.saturating_add(bytes.len())) == Some(bytes)
        };
        let word = |number: usize| to_u32(number).to_le_bytes();
        let after_at = frame.len().saturating_sub(after.len());
        frame.len() == HEADERS.saturating_add(len)
            && at(0, &[0, 0])
            && at(2, &word(len.saturating_add(32)))
            && at(12, &self.port.to_le_bytes())
            && at(22, &[self.command, 0, 4, 0])
            && at(26, &word(len))
            && at(30, &[0; 4])
            && at(HEADERS, &front)
            && at(after_at, &after)
    }

    /// The reply to a frame; `None` unless the frame is this request.
    pub(super) fn reply(&self, frame: &[u8]) -> Option<Vec<u8>> {
        if !self.forms().iter().any(|form| form.is(frame)) {
            return None;
        }
        let mut body = vec![0; 4];
        if self.command != 3 {
            body.extend(u32::try_from(self.reply.len()).ok()?.to_le_bytes());
            body.extend(&self.reply);
        }
        let length = u32::try_from(body.len()).ok()?;
        let mut reply = vec![0, 0];
        reply.extend(length.checked_add(32)?.to_le_bytes());
        // The target of the reply is the source of the request.
        reply.extend(frame.get(14..22)?);
        reply.extend(frame.get(6..14)?);
        reply.extend([self.command, 0, 5, 0]);
        reply.extend(length.to_le_bytes());
        reply.extend([0; 4]);
        reply.extend(frame.get(34..38)?);
        reply.extend(body);
        Some(reply)
    }
}
