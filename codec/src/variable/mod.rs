//! The requests and replies for variables with a flexible data type, such as V.E, V.G and V.A: those
//! of the channel interface and of the axis interface.
//!
//! Requirements: VAR-1 … VAR-26 and VAR-28.

mod codes;
mod description;
mod extended;
mod handle;
mod kind;
mod name;
mod path;
mod u32_list;
mod value;

pub use crate::value::data_type::VariableType;
pub use codes::{Synchronisation, Validity, VariableAccess};
pub use description::{DescriptionByNameRef, DescriptionRef};
pub use extended::{ExtendedDescription, ExtendedReply};
pub use handle::{Handle, HandleReadRef, HandleWriteRef};
pub use kind::{Kind, VariableCount, VariableIndexKindRef, VariableKindRef};
pub use name::{NameWriteRef, VariableNameRef};
pub use path::{PathPart, PathParts, VariablePath};
pub use u32_list::{U32Iter, U32List};
pub use value::ValueRef;

#[cfg(feature = "alloc")]
pub use {
    description::{Description, DescriptionByName},
    handle::{HandleRead, HandleWrite},
    kind::{VariableIndexKind, VariableKind},
    name::{NameWrite, VariableName},
    value::Value,
};
