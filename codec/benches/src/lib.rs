//! The cost of the codec compared with code written by hand, other libraries and a plain copy.

mod case;
mod cases;
pub mod clients;
mod hand;
mod inputs;
mod plain;

pub use case::{Case, Limit, Work};
pub use cases::{all, gate, others};
