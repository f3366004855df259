//! Prints the result of a self-test.

use std::io::{self, Write};

use super::detection::{CheckedTable, Figures, Mode, PairFigures};
use super::{SelfTest, SelfTestGroup, Trial, TrialResult};
use crate::exit::Exit;
use crate::text::plural;

/// Maximum number of requirements that are printed for a trial.
const TARGETS_SHOWN: usize = 6;

/// Prints the result of a self-test, and each trial that does not have the desired result; with
/// `verbose`, every trial and every missed defect.
pub fn print(test: &SelfTest, verbose: bool, out: &mut dyn Write) -> io::Result<()> {
    for one in &test.tried {
        let fine = matches!(
            one.result,
            TrialResult::Caught | TrialResult::Noticed | TrialResult::Quiet | TrialResult::Same
        );
        if verbose || !fine {
            entry(one, out)?;
        }
    }
    for id in &test.stale {
        writeln!(out, "stale reason: no surviving defect has the ID {id}")?;
    }
    if test.tried.is_empty() {
        return writeln!(out, "Nothing was tested.");
    }
    for group in SelfTestGroup::ALL {
        let (right, all) = test.rate(group);
        if all == 0 {
            continue;
        }
        match group {
            // The function `detection` prints these defects below, for each mode.
            SelfTestGroup::Cnc => {}
            SelfTestGroup::Different => {
                let alarms = all.saturating_sub(right);
                writeln!(out, "{:<10}  {} of {all}", group.name(), plural(alarms, "false alarm"))?;
            }
            _ => {
                let percent = percent(right, all);
                let mine = || test.tried.iter().filter(|one| one.group == group);
                let same = mine().filter(|one| one.result == TrialResult::Same).count();
                let noticed = mine().filter(|one| one.result == TrialResult::Noticed).count();
                let mut beside = match noticed {
                    0 => String::new(),
                    _ => format!(", {noticed} of them by a warning or a difference"),
                };
                if same > 0 {
                    beside += &format!(", not counting {same} without an effect here");
                }
                writeln!(
                    out,
                    "{:<10}  {right} caught of {all} ({percent} %){beside}",
                    group.name()
                )?;
            }
        }
    }
    detection(test, verbose, out)?;
    let verdict = if test.exit() == Exit::Success { "PASSED" } else { "NOT PASSED" };
    writeln!(out, "{verdict}  exit code {}", test.exit().code())
}

/// Prints how many defects of a CNC are detected: in runs against a device, for each mode, and by
/// all cases for the simulated CNC.
fn detection(test: &SelfTest, verbose: bool, out: &mut dyn Write) -> io::Result<()> {
    let CheckedTable { table, measured, differences } = &test.detection;
    for difference in differences {
        writeln!(out, "DIFFERS      {difference}")?;
    }
    writeln!(out, "\nDefects of a CNC, detected from outside; {measured} measured again now")?;
    writeln!(
        out,
        "{:<10} {:>8} {:>7} {:>10} {:>7} {:>13} {:>13}",
        "mode", "defects", "caught", "elsewhere", "missed", "undetectable", "false alarms"
    )?;
    for mode in Mode::ALL {
        let Figures { caught, elsewhere, missed, undetectable, quiet, alarms } =
            table.figures(mode);
        let variants = quiet + alarms;
        let defects: usize = [caught, elsewhere, missed, undetectable].iter().sum();
        let alarms = format!("{alarms} of {variants}");
        writeln!(
            out,
            "{:<10} {defects:>8} {caught:>7} {elsewhere:>10} {missed:>7} {undetectable:>13} {alarms:>13}",
            mode.name()
        )?;
    }
    let (right, all) = test.rate(SelfTestGroup::Cnc);
    if all > 0 {
        let missed = all.saturating_sub(right);
        writeln!(out, "{:<10} {all:>8} {right:>7} {:>10} {missed:>7}", "simulated", "")?;
    }
    let ((fields, fields_most), (others, others_most)) = (table.blame(true), table.blame(false));
    writeln!(
        out,
        "Requirements that fail, read-only: {fields} by a defect of one field ({fields_most} at the 90th \
         percentile),\n{others} by others ({others_most})"
    )?;
    pairs(&test.pairs, out)?;
    if verbose {
        for mode in Mode::ALL {
            writeln!(out, "\nMissed, {}:", mode.name())?;
            for (row, request) in table.missed(mode) {
                writeln!(out, "  {}: {request}", row.id)?;
            }
        }
    }
    Ok(())
}

fn pairs(figures: &PairFigures, out: &mut dyn Write) -> io::Result<()> {
    let PairFigures { both, masked, hidden } = figures;
    for pair in hidden {
        writeln!(out, "HIDDEN       {pair}")?;
    }
    let all = both + masked + hidden.len();
    if all == 0 {
        return Ok(());
    }
    writeln!(
        out,
        "Pairs of defects, read-only: both detected in {both} of {all}; in {masked} one makes the other \
         undetectable"
    )
}

fn percent(part: usize, all: usize) -> String {
    let tenths = (part * 1000).checked_div(all).unwrap_or_default();
    format!("{}.{}", tenths / 10, tenths % 10)
}

fn entry(one: &Trial, out: &mut dyn Write) -> io::Result<()> {
    let result = match one.result {
        TrialResult::Caught => "caught",
        TrialResult::Noticed => "noticed",
        TrialResult::Elsewhere => "ELSEWHERE",
        TrialResult::Survived => "SURVIVED",
        TrialResult::Quiet => "quiet",
        TrialResult::Same => "same",
        TrialResult::FalseAlarm => "FALSE ALARM",
        TrialResult::Broken => "BROKEN",
    };
    let targets: Vec<&str> = one.targets.iter().take(TARGETS_SHOWN).map(String::as_str).collect();
    let more = if one.targets.len() > TARGETS_SHOWN { " …" } else { "" };
    let (group, id, targets) = (one.group.name(), &one.id, targets.join(" "));
    writeln!(out, "{result:<11}  {group:<9}  {id}  [{targets}{more}]")?;
    writeln!(out, "             {}", one.what)?;
    if !one.failed.is_empty() {
        writeln!(out, "             failed: {}", one.failed.join(" "))?;
    }
    match &one.reason {
        Some(reason) => writeln!(out, "             may survive: {reason}"),
        None => Ok(()),
    }
}
