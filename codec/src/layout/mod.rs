//! The field table of every stream, a walk over the bytes of a stream by its table, and the inverse
//! of a walk.
//!
//! An [`Error`](crate::Error) in a stream names a field of its table, or the stream as a whole. A
//! tool can use the tables to explain the bytes of any stream, as in the example. The
//! [front page](crate#ids) explains IDs such as VAR-9.
//!
//! ```
//! use ads_cnc::layout::Stream;
//!
//! let mut seen = Vec::new();
//! Stream::VariableIndexKind
//!     .walk(b"\x02\0\0\0V.E\0", |segment| seen.push((segment.field.name(), segment.bytes)))?;
//! assert_eq!(seen, [("index", &b"\x02\0\0\0"[..]), ("kind", b"V.E\0")]);
//! # Ok::<(), ads_cnc::Error>(())
//! ```

mod checks;
mod field;
mod head;
mod join;
mod spec;
mod subject;
mod tables;
mod walk;

pub use field::Field;
pub(crate) use spec::{ADS_DATA, Declared};
pub use spec::{FieldSpec, Layout, Size, Type};
pub use subject::Subject;
pub(crate) use subject::{
    ams_net_id, index_group, index_offset, service, text, typed_value, variable_path,
};
pub use tables::Stream;
pub use walk::Segment;
