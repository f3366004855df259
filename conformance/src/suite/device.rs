//! Cases of what a device says of itself. It is known from help pages only, and need not be said.

use ads_cnc::ads::{DeviceInfoReply, DeviceStateReply};
use ads_cnc::operation::Task;

use super::case::{Case, Evidence, Step};
use super::declare;
use super::probe::Probe;
use crate::client::{Inquired, Inquiry, Said};

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "ads-device-info",
            "The COM task says its name and version",
            ["ADS-8"],
            Queries,
            device_info
        ),
        declare!(
            "ads-device-state",
            "The COM task says the state it is in",
            ["ADS-9"],
            Queries,
            device_state
        ),
    ]
}

impl Probe<'_> {
    /// Asks a task what it says of itself, and keeps it as the evidence of the checks that follow.
    pub fn inquire<R: Inquiry>(&mut self, task: Task) -> Step<Inquired<R>> {
        self.target()?;
        let inquired = self.session.client.inquire::<R>(task.port());
        let fault = inquired.outcome.as_ref().err();
        self.came(fault, &inquired.violations, &inquired, Evidence::from(&inquired))?;
        Ok(inquired)
    }
}

fn device_info(probe: &mut Probe<'_>) -> Step {
    says::<DeviceInfoReply>(probe)
}

fn device_state(probe: &mut Probe<'_>) -> Step {
    says::<DeviceStateReply>(probe)
}

fn says<R: Inquiry>(probe: &mut Probe<'_>) -> Step {
    let inquired = probe.inquire::<R>(Task::Com)?;
    let said = matches!(inquired.outcome, Ok(Said::Reply(_)));
    let expected = format!("a {}", R::STREAM.layout().name);
    probe.check(R::CLAUSE, said, expected, inquired.result());
    Ok(())
}
