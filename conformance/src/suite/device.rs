//! Cases of device information and state. Both are documented online only, so the verdict of these
//! cases on a missing or wrong reply is only a warning.

use ads_cnc::ads::{AdsState, DeviceInfoReply, DeviceStateReply};
use ads_cnc::operation::Task;
use ads_cnc_vectors::ids::*;

use super::kit::Probe;
use super::row::{CaseRow, case};
use crate::client::{Inquired, Inquiry, InquiryReply};
use crate::evidence::Evidence;
use crate::judge::{Checks as _, Needs, Step};
use crate::values::until_nul;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("ads-device-info", &[ADS_8], Needs::Queries, device_info,
        "Each task returns the name and the version of its device"),
    case("ads-device-state", &[ADS_9], Needs::Queries, device_state,
        "Each task returns its state"),
];

impl Probe<'_> {
    /// Sends an inquiry (ReadDeviceInfo or ReadState) to a task. The exchange becomes the evidence
    /// of the following checks.
    pub fn inquire<R: Inquiry>(&mut self, task: Task) -> Step<Inquired<R>> {
        self.target()?;
        let inquired = self.target.client.inquire::<R>(task.port());
        let fault = inquired.outcome.as_ref().err();
        self.record_exchange(fault, &inquired.violations, &inquired, Evidence::from(&inquired))?;
        Ok(inquired)
    }
}

fn device_info(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, info: DeviceInfoReply| {
        let name = until_nul(&info.name);
        let is_text = !name.is_empty() && !name.iter().any(u8::is_ascii_control);
        probe.check(DeviceInfoReply::CLAUSE, is_text, "a name", || format!("{:02x?}", info.name));
        Ok(())
    })
}

fn device_state(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, state: DeviceStateReply| {
        let valid = state.ads_state != AdsState(0);
        probe.check(DeviceStateReply::CLAUSE, valid, "an ADS state", "0");
        Ok(())
    })
}

/// Sends an inquiry to each claimed task, checks that it succeeds, and calls `then` with the reply.
fn each<R: Inquiry>(
    probe: &mut Probe<'_>,
    mut then: impl FnMut(&mut Probe<'_>, R) -> Step,
) -> Step {
    for task in [Task::Com, Task::Sda, Task::Geo] {
        if !probe.target.profile.has_task(task) {
            continue;
        }
        let inquired = probe.inquire::<R>(task)?;
        let (expected, found) = (format!("a {}", R::STREAM.layout().name), inquired.result());
        match inquired.outcome {
            Ok(InquiryReply::Reply(reply)) => {
                probe.pass(R::CLAUSE);
                then(probe, reply)?;
            }
            _ => {
                probe.check(R::CLAUSE, false, expected, found);
            }
        }
    }
    Ok(())
}
