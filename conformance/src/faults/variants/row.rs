//! Rows of variants.

use ads_cnc::ads::FrameRef;

use crate::faults::cnc::{CncDefect, CncFault, Upstream, fault};

/// A variant that does not reply literally as in the manuals' printed examples.
pub(super) const fn unprinted(mut row: CncDefect) -> CncDefect {
    row.printed = false;
    row
}

pub(super) const fn sent(
    id: &'static str,
    what: &'static str,
    frame: fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>,
) -> CncDefect {
    fault(id, &[], what, CncFault::Frame(frame))
}

/// The TOML text of a model, followed by the names of the instances of the decoder, the HLD and the
/// path preparation, which have no elements in these models.
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
