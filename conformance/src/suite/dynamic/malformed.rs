//! Malformed and unusual requests about dynamic parameters.

use ads_cnc::TextRef;
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{
    CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, Request,
};
use ads_cnc_vectors::ids::*;

use super::parameters::{each, first, names_of, rejects_steadily};
use crate::judge::{Checks as _, Step, assumed};
use crate::suite::kit::{Probe, RawCall};
use crate::text::plural;

pub(super) fn bad_requests(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        let at = (channel, kind);
        let index: Request<'_> = DynamicNameByIndex::new(channel, kind, 1)?.into();
        let value = DynamicValueByIndex::new(channel, kind, 1)?.into();
        for (id, request) in [(DYN_2, index), (DYN_4, value)] {
            let with = |data: &[u8]| -> Step<RawCall> {
                Ok(RawCall::new(request)?.with(|call| call.data = data.to_vec()))
            };
            rejects_steadily(probe, DYN_5, "index 0", at, with(&[0; 4])?, request)?;
            for data in [&[][..], &[1], &[1, 0], &[1, 0, 0, 0, 0]] {
                let what = format!("an index of {}", plural(data.len(), "byte"));
                rejects_steadily(probe, assumed(id), &what, at, with(data)?, request)?;
            }
        }
        let request = Request::from(CountDynamic::new(channel, kind));
        let short = RawCall::new(request)?.with(|call| call.read_length = 3);
        let what = "a read length of 3 for a number";
        rejects_steadily(probe, assumed(ADS_1), what, at, short, request)?;
        for (_, known) in names_of(probe, channel, kind, count)? {
            let text = TextRef::from(known.as_cnc_str());
            let request = Request::from(DynamicValueByName { channel, kind, name: text });
            let valid = RawCall::new(request)?;
            // These names begin with an existing name and have 97, 98 or 256 characters: more than
            // the maximum of 96.
            let room = DYNAMIC_NAME_MAX.saturating_sub(known.as_bytes().len());
            for more in [1, 2, 160] {
                let rest = vec![b'x'; room.saturating_add(more)];
                let long = [known.as_bytes(), &rest, &[0]].concat();
                let what =
                    format!("a name of {}", plural(long.len().saturating_sub(1), "character"));
                let long = valid.with(|call| call.data = long);
                rejects_steadily(probe, DYN_6, &what, at, long, request)?;
            }
            let longest = DYNAMIC_NAME_MAX.saturating_add(1);
            let with_tail = valid.with(|call| call.data.resize(longest, b'x'));
            let what = "a request of 97 bytes, with a byte after the NUL of the name";
            rejects_steadily(probe, assumed(DYN_6), what, at, with_tail, request)?;
            let short = valid.with(|call| call.read_length = call.read_length.saturating_sub(1));
            let what = "a read length of 7 for a value";
            rejects_steadily(probe, assumed(DYN_3), what, at, short, request)?;
        }
        Ok(())
    })
}

/// Sends names without a NUL, and names padded with NULs: whether a name needs a NUL is not
/// specified.
pub(super) fn forms(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = first(probe, channel, kind)?;
        let text = TextRef::from(known.as_cnc_str());
        let valid = RawCall::new(DynamicValueByName { channel, kind, name: text })?;
        let mut padded = known.as_bytes().to_vec();
        padded.resize(DYNAMIC_NAME_MAX, 0);
        for (what, data) in [("without a NUL", known.as_bytes()), ("padded with NULs", &padded)] {
            let exchange = probe.call(&valid.with(|call| call.data = data.to_vec()))?;
            let found = exchange.success().is_some();
            let expected = || format!("the value of {known}, {what}");
            probe.check(assumed(DYN_3), found, expected, &exchange);
        }
        Ok(())
    })
}
