//! Checks that are tests, and that defects fail.

use ads_cnc_vectors::ClauseId;

use crate::target::{Check, Target};

/// A check of a CNC in its initial state.
pub(crate) struct SimulatorCheck {
    pub(crate) name: &'static str,
    /// The requirements that it checks.
    pub(crate) clauses: &'static [ClauseId],
    pub(crate) run: fn(&Target) -> Check,
}

/// Lists functions as checks, and makes a test of each for the CNC without a defect.
macro_rules! checks {
    ($($name:ident: [$($clause:ident),+ $(,)?],)+) => {
        pub(crate) const CHECKS: &[$crate::checks::SimulatorCheck] = &[
            $($crate::checks::SimulatorCheck {
                name: stringify!($name),
                clauses: &[$($clause),+],
                run: $name,
            },)+
        ];

        mod tests {
            $(#[test]
            fn $name() {
                super::$name(&$crate::target::Target::new(None)).unwrap();
            })+
        }
    };
}

pub(crate) use checks;
