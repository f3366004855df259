//! A row of a table of cases.

use super::kit::Probe;
use crate::judge::{Needs, Step, in_catalogue};

/// The function of a case.
pub(super) type Try = fn(&mut Probe<'_>) -> Step;

/// A case with its function.
pub(super) struct CaseRow {
    pub(super) id: &'static str,
    pub(super) clauses: &'static [&'static str],
    pub(super) needs: Needs,
    pub(super) run: Try,
    pub(super) title: &'static str,
}

pub(super) const fn case(
    id: &'static str,
    clauses: &'static [&'static str],
    needs: Needs,
    run: Try,
    title: &'static str,
) -> CaseRow {
    CaseRow { id, clauses: in_catalogue(clauses), needs, run, title }
}
