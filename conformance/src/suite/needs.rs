//! Decides from the gate and the profile of a target whether the need of a case is met.

use crate::gate::Gate;
use crate::judge::{Needs, Verdict};
use crate::profile::Profile;

impl Needs {
    /// The verdict and the reason if a case with this need is not run on the target; `None` if the
    /// need does not prevent the case.
    pub fn unmet(self, gate: &Gate, profile: &Profile) -> Option<(Verdict, &'static str)> {
        let not_run = |why| Some((Verdict::NotRun, why));
        match self {
            Self::Malformed if !gate.lets_malformed_pass() => {
                not_run("malformed requests are sent only with --malformed")
            }
            Self::Writes if !gate.may_let_writes_pass() => {
                not_run("writes are sent only with --allow-write, for the values in its file")
            }
            Self::MalformedWrites if gate.simulated().is_none() => {
                not_run("malformed writes are sent only to the simulated CNC")
            }
            Self::PrintedExamples if !profile.printed_examples => Some((
                Verdict::NotApplicable,
                "the target does not claim to answer the printed examples",
            )),
            _ => None,
        }
    }
}
