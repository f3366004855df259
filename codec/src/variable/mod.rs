//! Variables with a flexible data type: the streams of the channel interface (VAR-1 …).

mod codes;
mod description;
mod description_by_name;
mod extended;
mod handle;
mod handle_write;
mod kind;
mod name;
mod name_write;
mod numbers;
mod path;
mod value;

pub use codes::{Synchronisation, Validity, VariableAccess, VariableType};
pub use description::DescriptionRef;
pub use description_by_name::DescriptionByNameRef;
pub use extended::{ExtendedDescription, ExtendedReply};
pub use handle::{Handle, HandleReadRef};
pub use handle_write::HandleWriteRef;
pub use kind::{Kind, VariableCount, VariableIndexKindRef, VariableKindRef};
pub use name::VariableNameRef;
pub use name_write::NameWriteRef;
pub use numbers::Numbers;
pub use path::{PathPart, PathParts, VariablePath};
pub use value::ValueRef;

#[cfg(feature = "alloc")]
pub use {
    description::Description,
    description_by_name::DescriptionByName,
    handle::HandleRead,
    handle_write::HandleWrite,
    kind::{VariableIndexKind, VariableKind},
    name::VariableName,
    name_write::NameWrite,
    value::Value,
};
