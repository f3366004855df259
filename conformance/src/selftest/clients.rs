//! Clients with a defect.

use super::Candidate;

pub(super) fn candidates() -> Vec<Candidate> {
    Vec::new()
}
