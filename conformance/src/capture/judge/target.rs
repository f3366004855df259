//! The variable that a request is about.

use ads_cnc::Description;

/// A variable that a request is about.
#[derive(Clone, Debug)]
pub(in super::super) struct TargetVariable {
    pub(in super::super) description: Description,
    /// The indices that select an element; none for the whole.
    pub(in super::super) indices: Vec<u32>,
}
