//! Explains bytes field by field: offset, bytes, field, value, meaning, requirement.
//!
//! [`explain`] accepts any bytes and never fails: an error in the bytes is part of the
//! [`Explanation`], which contains the fields before the error, the error itself and the unread
//! bytes. The fields are those of the tables in [`ads_cnc::layout`]; NC text is split into lines,
//! and a value that fits the specified type into elements. Bytes that no table describes are one
//! field.
//!
//! ```
//! use ads_cnc::layout::Stream;
//! use ads_cnc_conformance::explain::{
//!     ExplainQuery, ExplainSubject, ExplanationOutcome, ValueFormat, explain,
//! };
//!
//! let subject = ExplainSubject::Stream(Stream::VariableHandle);
//! let question = ExplainQuery { subject, values: ValueFormat::default() };
//! let explanation = explain(&question, &[4, 0, 0, 2]);
//! assert_eq!(explanation.outcome, ExplanationOutcome::Explained);
//! let row = &explanation.parts[0].rows[0];
//! assert_eq!((row.field.as_str(), row.value.as_str()), ("handle", "33554436 (0x2000004)"));
//!
//! let cut = explain(&question, &[4, 0]);
//! assert_eq!(cut.outcome, ExplanationOutcome::Faulty);
//! assert_eq!(cut.parts[0].faults[0].text, "handle at offset 0: truncated, expected 4 bytes, found 2");
//! ```

mod address;
mod codes;
mod explanation;
mod frame;
mod group;
mod nc;
mod part;
#[allow(clippy::restriction)]
mod show;
mod typed;
mod value;

pub use crate::text::hex::{HexError, parse_hex};
pub use crate::value_format::{UnknownType, ValueFormat, type_by_name};
pub(crate) use codes::command as command_name;
pub(crate) use explanation::sources;
pub use explanation::{
    ExplainQuery, ExplainSubject, ExplainedAddress, ExplainedFault, ExplainedField,
    ExplainedStream, Explanation, ExplanationOutcome, FunctionReport, ServiceAddress, Unread,
};
pub use frame::looks_like_frame;
pub use group::describe;
pub use show::print;

use ads_cnc::layout::Stream;

/// Explains bytes. The result depends only on the arguments, and no bytes cause a panic.
pub fn explain(question: &ExplainQuery, bytes: &[u8]) -> Explanation {
    let values = &question.values;
    let parts = match &question.subject {
        ExplainSubject::Stream(stream) => vec![part::of_stream(*stream, 0, bytes, values)],
        ExplainSubject::Place(ads_address) => vec![address::of_data(ads_address, 0, bytes, values)],
        ExplainSubject::Address(ads_address) => vec![address::alone(ads_address)],
        ExplainSubject::Frames(ads_address) => {
            frame::of_frames(ads_address.as_ref(), bytes, values)
        }
    };
    Explanation::new(bytes.len(), parts)
}

/// The names of the streams whose tables accept all the bytes: suggestions for a user who has not
/// specified a stream.
pub fn candidates(bytes: &[u8]) -> Vec<&'static str> {
    let takes = |stream: &Stream| stream.walk(bytes, |_| ()).is_ok();
    Stream::all().filter(takes).map(|stream| stream.layout().name).collect()
}
