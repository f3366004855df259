//! The variable that a request is about.

use ads_cnc::Description;

/// A variable that a request is about.
#[derive(Clone, Debug)]
pub(super) struct TargetVariable {
    pub(super) description: Description,
    /// The indices that select an element; empty for the whole variable.
    pub(super) indices: Vec<u32>,
}
