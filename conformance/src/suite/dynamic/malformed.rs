//! Requests about dynamic parameters that no client should send.

use ads_cnc::TextRef;
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{
    Call, CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, Request,
};

use super::super::probe::{Probe, harness};
use super::{each, first, refused_still, told};
use crate::judge::{Step, assumed};

pub(super) fn bad_requests(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        let at = (channel, kind);
        let index = DynamicNameByIndex::new(channel, kind, 1).map_err(harness)?;
        let value = DynamicValueByIndex::new(channel, kind, 1).map_err(harness)?;
        for (id, request) in [("DYN-2", Request::from(index)), ("DYN-4", value.into())] {
            let mut buf = [0; 4];
            let good = request.encode(&mut buf).map_err(harness)?;
            let zero = Call { data: &[0; 4], ..good };
            refused_still(probe, "DYN-5", "index 0", at, &zero, request)?;
            for data in [&[][..], &[1], &[1, 0], &[1, 0, 0, 0, 0]] {
                let what = format!("an index of {} bytes", data.len());
                refused_still(probe, assumed(id), &what, at, &Call { data, ..good }, request)?;
            }
        }
        let request = Request::from(CountDynamic::new(channel, kind));
        let mut buf = [0; 4];
        let good = request.encode(&mut buf).map_err(harness)?;
        let short = Call { read_length: 3, ..good };
        let what = "a read length of 3 for a number";
        refused_still(probe, assumed("ADS-1"), what, at, &short, request)?;
        for (_, known) in told(probe, channel, kind, count)? {
            let text = TextRef::from(known.as_cnc_str());
            let request = Request::from(DynamicValueByName { channel, kind, name: text });
            let mut buf = [0; 256];
            let good = request.encode(&mut buf).map_err(harness)?;
            // Names of one byte too many and of more, which begin with one that is there.
            let room = DYNAMIC_NAME_MAX.saturating_sub(known.as_bytes().len());
            for more in [1, 2, 160] {
                let rest = vec![b'x'; room.saturating_add(more)];
                let long = [known.as_bytes(), &rest, &[0]].concat();
                let what = format!("a name of {} characters", long.len().saturating_sub(1));
                let long = Call { data: &long, ..good };
                refused_still(probe, "DYN-6", &what, at, &long, request)?;
            }
            let mut behind = good.data.to_vec();
            behind.resize(DYNAMIC_NAME_MAX.saturating_add(1), b'x');
            let what = "a request of 97 bytes, with something behind the name's end";
            let behind = Call { data: &behind, ..good };
            refused_still(probe, assumed("DYN-6"), what, at, &behind, request)?;
            let read = good.read_length.saturating_sub(1);
            let short = Call { read_length: read, ..good };
            let what = "a read length of 7 for a value";
            refused_still(probe, assumed("DYN-3"), what, at, &short, request)?;
        }
        Ok(())
    })
}

/// How a name ends nobody says.
pub(super) fn forms(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = first(probe, channel, kind)?;
        let text = TextRef::from(known.as_cnc_str());
        let request = Request::from(DynamicValueByName { channel, kind, name: text });
        let mut buf = [0; 256];
        let good = request.encode(&mut buf).map_err(harness)?;
        let mut padded = known.as_bytes().to_vec();
        padded.resize(DYNAMIC_NAME_MAX, 0);
        for (what, data) in [("without a NUL", known.as_bytes()), ("padded with NULs", &padded)] {
            let exchange = probe.call(&Call { data, ..good })?;
            let found = exchange.answer().and_then(|answer| answer.success()).is_some();
            let expected = format!("the value of {known}, {what}");
            probe.check(assumed("DYN-3"), found, expected, exchange.result());
        }
        Ok(())
    })
}
