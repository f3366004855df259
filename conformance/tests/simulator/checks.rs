//! Checks of the simulated CNC. Each check is a test of the CNC without a defect; `defects.rs` also
//! runs the checks for a CNC with a defect.

use ads_cnc_conformance::matrix::SIMULATOR_CHECKS;
use ads_cnc_vectors::ClauseId;

use crate::target::{CheckResult, TestCnc};

/// A check that starts with a CNC in its initial state.
pub(crate) struct SimulatorCheck {
    pub(crate) name: &'static str,
    pub(crate) run: fn(&TestCnc) -> CheckResult,
}

impl SimulatorCheck {
    /// The requirements that the check covers.
    pub(crate) fn clauses(&self) -> &'static [ClauseId] {
        let mut listed = SIMULATOR_CHECKS.iter().filter(|(name, _)| *name == self.name);
        listed.next().unwrap_or_else(|| panic!("{} is not in src/matrix/simulated.rs", self.name)).1
    }
}

/// Lists functions as checks, and makes a test of each for the CNC without a defect.
macro_rules! checks {
    ($($name:ident,)+) => {
        pub(crate) const CHECKS: &[$crate::checks::SimulatorCheck] = &[
            $($crate::checks::SimulatorCheck { name: stringify!($name), run: $name },)+
        ];

        mod tests {
            $(#[test]
            fn $name() {
                super::$name(&$crate::target::TestCnc::new(None)).unwrap();
            })+
        }
    };
}

pub(crate) use checks;
