//! The field table of every stream, and a walk over the bytes of a stream by its table.
//!
//! An [`Error`](crate::Error) names the fields of these tables, and the documentation of each stream
//! shows its table. A tool can use the tables to explain the bytes of any stream, as in the example.
//! The [front page](crate#ids) explains IDs such as VAR-9.
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
