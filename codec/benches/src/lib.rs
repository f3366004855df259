//! Compares the cost of the codec with code written by hand, other libraries and a plain copy of
//! the bytes.

mod case;
mod cases;
mod hand;
mod inputs;
mod plain;

pub use case::{Case, Limit, Work};
pub use cases::{all, gate, others};
