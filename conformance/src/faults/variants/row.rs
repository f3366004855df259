//! Rows of variants.

use ads_cnc::ads::FrameRef;

use crate::faults::cnc::{CncFault, CncSeed, Upstream, fault};

/// A row whose printed examples are answered otherwise.
pub(super) const fn unprinted(mut row: CncSeed) -> CncSeed {
    row.printed = false;
    row
}

pub(super) const fn sent(
    id: &'static str,
    what: &'static str,
    frame: fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>,
) -> CncSeed {
    fault(id, &[], what, CncFault::Frame(frame))
}
