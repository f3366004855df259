//! Variables with a flexible data type: the streams of the channel interface (VAR-1 …).

mod codes;
mod description;
mod element;
mod handle;
mod kind;
mod name;
mod numbers;
mod value;

pub use codes::{VariableAccess, VariableType};
pub use description::DescriptionRef;
pub use element::{Element, Elements};
pub use handle::{Handle, HandleReadRef};
pub use kind::{Kind, VariableCount, VariableIndexKindRef, VariableKindRef};
pub use name::VariableNameRef;
pub use numbers::Numbers;
pub use value::ValueRef;

#[cfg(feature = "alloc")]
pub use {
    description::Description,
    handle::HandleRead,
    kind::{VariableIndexKind, VariableKind},
    name::VariableName,
    value::Value,
};
