//! A row of a table of cases.

use ads_cnc_vectors::ClauseId;

use super::kit::Probe;
use crate::judge::{Needs, Step};

/// The function of a case.
pub(super) type CaseFunction = fn(&mut Probe<'_>) -> Step;

/// A case with its function.
pub(super) struct CaseRow {
    pub(super) id: &'static str,
    pub(super) clauses: &'static [ClauseId],
    pub(super) needs: Needs,
    pub(super) run: CaseFunction,
    pub(super) title: &'static str,
}

pub(super) const fn case(
    id: &'static str,
    clauses: &'static [ClauseId],
    needs: Needs,
    run: CaseFunction,
    title: &'static str,
) -> CaseRow {
    CaseRow { id, clauses, needs, run, title }
}
