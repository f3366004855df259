//! The bytes that a check is about.

use crate::values::ValueFormat;

/// The bytes of an exchange, as a report shows them.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// Where the request went.
    pub call: String,
    /// Stream of the request's data, by name, if a documented function was asked.
    pub request_stream: Option<&'static str>,
    /// Stream of the reply's data.
    pub reply_stream: Option<&'static str>,
    /// Data of the request.
    pub sent: Vec<u8>,
    /// Data of the reply.
    pub received: Option<Vec<u8>>,
    /// What the data of the reply should have been, where that is known to the byte.
    pub expected: Option<Vec<u8>>,
    /// How values among the data are to be read.
    pub values: ValueFormat,
    /// What came of it, in a few words.
    pub result: String,
    /// The whole frame sent.
    pub frame_sent: Vec<u8>,
    /// The whole frame received, or as much as came.
    pub frame_received: Vec<u8>,
}

/// The most bytes that are kept of each part of an exchange.
const EVIDENCE_MAX: usize = 4096;

impl Evidence {
    /// The bytes, or the first that are kept of many.
    pub(crate) fn start(bytes: &[u8]) -> &[u8] {
        bytes.get(..EVIDENCE_MAX).unwrap_or(bytes)
    }

    /// Adds what the data of the reply should have been.
    pub(crate) fn expect(&mut self, reply: &[u8]) {
        self.expected = Some(Self::start(reply).to_vec());
    }

    /// Keeps the first bytes of a long exchange, and says so.
    pub(crate) fn cut(mut self, sent: &[u8], received: &[u8]) -> Self {
        (self.frame_sent, self.frame_received) =
            (Self::start(sent).to_vec(), Self::start(received).to_vec());
        for (whole, stream) in
            [(sent, &mut self.request_stream), (received, &mut self.reply_stream)]
        {
            if whole.len() > EVIDENCE_MAX {
                // Half of a stream would be read as a faulty one.
                *stream = None;
                let note = format!(" (of {} bytes the first {EVIDENCE_MAX} are kept)", whole.len());
                self.result.push_str(&note);
            }
        }
        self
    }
}
