//! Lists the selected cases, and why a case would not be run (`run --list`).

use std::io::{self, Write};

use serde::Serialize;

use crate::judge::{Case, CaseSubject, Needs, Plan};
use crate::text::{json, plural};

#[derive(Debug, Serialize)]
pub(super) struct Listed {
    id: String,
    title: String,
    subject: CaseSubject,
    requirements: Vec<&'static str>,
    /// Why the case would not be run; `None` if it would be run.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_run: Option<String>,
}

impl Listed {
    fn new(case: &Case, not_run: Option<String>) -> Self {
        Self {
            id: case.id.clone(),
            title: case.title.clone(),
            subject: case.subject,
            requirements: case.requirements.clone(),
            not_run,
        }
    }
}

/// The selected cases of a plan in their order, each with the reason from `unmet`, if any, why it
/// cannot be run. The selected cases that the edition of --edition lacks come last.
pub(super) fn of_plan(plan: &Plan, unmet: impl Fn(Needs) -> Option<String>) -> Vec<Listed> {
    let run = plan.selected().map(|case| Listed::new(case, unmet(case.needs)));
    let foreign = plan.foreign.iter().map(|(case, why)| Listed::new(case, Some(why.clone())));
    run.chain(foreign).collect()
}

/// Sorts the cases into an order that does not depend on the seed.
pub(super) fn sort(listed: &mut [Listed]) {
    listed.sort_by(|one, other| (one.subject, &one.id).cmp(&(other.subject, &other.id)));
}

pub(super) fn to_text(listed: &[Listed], out: &mut dyn Write) -> io::Result<()> {
    for Listed { id, title, subject, requirements, not_run } in listed {
        writeln!(out, "{subject:<7}  {id}  [{}]", requirements.join(" "))?;
        writeln!(out, "         {title}")?;
        if let Some(why) = not_run {
            writeln!(out, "         not run: {why}")?;
        }
    }
    let run = listed.iter().filter(|one| one.not_run.is_none()).count();
    writeln!(out, "{}", plural(run, "case"))
}

pub(super) fn to_json(listed: &[Listed], out: &mut dyn Write) -> io::Result<()> {
    json::write(&listed, out)
}
