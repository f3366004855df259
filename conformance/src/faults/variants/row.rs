//! Rows of variants.

use ads_cnc::ads::FrameRef;

use crate::faults::cnc::{CncFault, CncSeed, Upstream, fault};

/// A row whose printed examples are answered differently.
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

/// The text of a model that ends with the names of the instances of classes without elements.
macro_rules! with_names {
    ($model:literal) => {
        concat!(
            $model,
            r#"
[class.decoder.channel]
name = "SDA {}"
[class.decoder.axis]
name = "SDA axis {}"
[class.hld.channel]
name = "HLD {}"
[class.hld.axis]
name = "HLD axis {}"
[class.path-preparation.channel]
name = "BV {}"
[class.path-preparation.axis]
name = "BV axis {}"
"#
        )
    };
}
pub(super) use with_names;
