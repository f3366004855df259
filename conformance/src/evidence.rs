//! The bytes that a check is based on, and the texts of its expected and its actual result.

use std::fmt::{self, Display};

use ads_cnc::operation::Function;
use ads_cnc_vectors::Hex;

use crate::text::plural;
use crate::value_format::ValueFormat;

/// The bytes of an exchange, as shown in a report.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// The request in words, for example its service and address.
    pub call: String,
    /// The variable or object that the exchange is about, if any.
    pub subject: Option<String>,
    /// The function that a request to a target, or a captured request, calls; `None` for any other
    /// evidence, and if the codec cannot dispatch the request.
    pub function: Option<Function>,
    /// The functions called since the last comparison ended; the check may compare their replies.
    pub compared: Vec<Function>,
    /// Whether the reply must be a rejection.
    pub is_rejection: bool,
    /// Name of the stream in `sent`, if it is known and the frame is not truncated.
    pub request_stream: Option<&'static str>,
    /// Name of the stream in the data of a successful reply, if it is known and the frame is not
    /// truncated.
    pub reply_stream: Option<&'static str>,
    /// Data of the request, or bytes that are not a request.
    pub sent: Vec<u8>,
    /// Data of the reply; `None` for example for a reply to a Write.
    pub received: Option<Vec<u8>>,
    /// The expected data of the reply, if all of its bytes are known.
    pub expected: Option<Vec<u8>>,
    /// The types of the values in the data.
    pub values: ValueFormat,
    /// The result in a few words.
    pub result: String,
    /// The first bytes of the frame sent, at most `EVIDENCE_MAX`.
    pub frame_sent: Vec<u8>,
    /// The first bytes of the frame received, or of the bytes that arrived instead, at most
    /// `EVIDENCE_MAX`.
    pub frame_received: Vec<u8>,
}

/// Maximum number of bytes that the evidence of an exchange with a CNC has of each part: the data
/// and the frame of the request, those of the reply, and the expected data.
const EVIDENCE_MAX: usize = 4096;

impl Evidence {
    /// The first [`EVIDENCE_MAX`] bytes, or all bytes if there are fewer.
    pub(crate) fn start(bytes: &[u8]) -> &[u8] {
        bytes.get(..EVIDENCE_MAX).unwrap_or(bytes)
    }

    /// Sets the expected data of the reply.
    pub(crate) fn expect(&mut self, reply: &[u8]) {
        self.expected = Some(Self::start(reply).to_vec());
    }

    /// Stores the two frames, each truncated to [`EVIDENCE_MAX`] bytes. If a frame is longer, adds
    /// a note to `result`.
    pub(crate) fn cut(mut self, sent: &[u8], received: &[u8]) -> Self {
        (self.frame_sent, self.frame_received) =
            (Self::start(sent).to_vec(), Self::start(received).to_vec());
        for (whole, stream) in
            [(sent, &mut self.request_stream), (received, &mut self.reply_stream)]
        {
            if whole.len() > EVIDENCE_MAX {
                // A report would show a truncated stream as a faulty one.
                *stream = None;
                let note = format!(
                    " (only the first {EVIDENCE_MAX} of {} are stored)",
                    plural(whole.len(), "byte")
                );
                self.result.push_str(&note);
            }
        }
        self
    }
}

/// The expected or the actual result of a check. If the check passes, no closure is called and no
/// `format_args!` is formatted.
pub trait Describe {
    /// The text in a report.
    fn describe(self) -> String;
}

impl<F: FnOnce() -> D, D: Display> Describe for F {
    fn describe(self) -> String {
        self().to_string()
    }
}

macro_rules! describe {
    ($($displayed:ty),+ $(,)?) => {$(
        impl Describe for $displayed {
            fn describe(self) -> String {
                self.to_string()
            }
        }
    )+};
}

describe! { &str, String, &String, fmt::Arguments<'_>, Hex, u32, usize, ads_cnc::Error }
