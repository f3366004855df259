//! The byte order of error numbers.

use ads_cnc::Kind;
use ads_cnc::address::IndexOffset;
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::{CountObjects, CountVariables, Request, WriteByName};
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step};
use crate::suite::kit::{Probe, RawCall};

/// Any error number is permitted, but two replies must not have the same one in reverse byte order.
pub(super) fn of_errors(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let channel = probe.channel()?;
    let requests: [Request<'_>; 3] = [
        CountObjects::new(channel).into(),
        WriteByName::new(channel, "V.E.nobody_has_this", &[0; 4][..])?.into(),
        CountVariables::new(channel, Kind::V_E).into(),
    ];
    for request in requests {
        let good = RawCall::new(request)?;
        // A request for an object, variable or function that does not exist.
        let bad = match request {
            Request::WriteByName(_) => good,
            _ => good.with(|call| call.index_offset = IndexOffset::new(0xFFFF)),
        };
        let Err(own) = cnc.answer(&bad.call()) else { continue };
        let found = number(probe, &bad)?;
        let turned = own.0.swap_bytes();
        let expected = || format!("{own:#x}, or another");
        probe
            .check(ADS_4, found.is_none_or(|found| found.0 != turned), expected, || display(found));
    }
    let good = RawCall::new(CountVariables::new(channel, Kind::V_E))?;
    let call = good.with(|call| call.port = AmsPort(1));
    let found = number(probe, &call)?;
    let turned = AdsError::TARGET_PORT_NOT_FOUND.0.swap_bytes();
    let expected = "an error, its lowest byte first";
    probe.check(ADS_5, found.is_none_or(|found| found.0 != turned), expected, || display(found));
    Ok(())
}

/// The error of the AMS header or of the service.
fn number(probe: &mut Probe<'_>, call: &RawCall) -> Step<Option<AdsError>> {
    let exchange = probe.call(call)?;
    let errors = exchange.answer().map(|answer| [answer.ams_error, answer.result]);
    Ok(errors.into_iter().flatten().find(|error| !error.is_ok()))
}

fn display(error: Option<AdsError>) -> String {
    error.map_or_else(|| "none".to_owned(), |error| format!("{error:#x}"))
}
