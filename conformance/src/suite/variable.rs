//! Cases of variables: how many there are, what they are, how they are called.

use std::collections::HashSet;

use ads_cnc::limits::TEXT_MAX;
use ads_cnc::operation::{
    CountVariables, DescribeByIndex, HandleByName, ReadByHandle, ReadByName, Request,
};
use ads_cnc::{
    Decode as _, Description, Handle, Kind, Numbers, TextRef, VariableAccess, VariableCount,
};
use ads_cnc_vectors::Hex;

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::described::kinds;
use super::probe::{Probe, harness};
use super::record::Checks;
use super::survey::{KINDS, VARIABLES_MAX};

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "var-count",
            "Each kind has a number, and no kind at all asks for their sum",
            ["VAR-1", "VAR-2"],
            Queries,
            count
        ),
        declare!(
            "var-descriptions",
            "Every index from 0 on has a description that holds together",
            [
                "VAR-2", "VAR-3", "VAR-4", "VAR-5", "VAR-6", "VAR-7", "VAR-8", "VAR-9", "GEN-1",
                "GEN-3"
            ],
            Queries,
            descriptions
        ),
        declare!(
            "var-index-beyond-last",
            "The index behind the last is answered by an error",
            ["VAR-2"],
            Queries,
            index_beyond_last
        ),
        declare!(
            "var-handle-by-name",
            "A name's handle is the one in its description, and no other's",
            ["VAR-9", "VAR-10"],
            Queries,
            handle_by_name
        ),
        declare!(
            "var-unknown-name",
            "A name nobody has is answered by an error",
            ["ADS-4"],
            Queries,
            unknown_name
        ),
        declare!(
            "var-structures-are-resolved",
            "A structure's own name addresses nothing",
            ["VAR-20"],
            Queries,
            structures_are_resolved
        ),
        declare!(
            "var-padded-name",
            "NULs may pad a name or a kind up to 256 bytes",
            ["VAR-1", "VAR-9"],
            Malformed,
            padded_name
        ),
    ]
}

fn count(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let mut sum = 0_u32;
        for (_, kind) in kinds(probe) {
            let VariableCount(number) = probe.read("VAR-2", CountVariables::new(channel, kind))?;
            sum = sum.saturating_add(number);
        }
        let VariableCount(all) = probe.read("VAR-1", CountVariables::new(channel, Kind::ALL))?;
        let found = format!("{all} of channel {}", channel.number());
        // What is not claimed is not counted here, but may well be there.
        let whole = kinds(probe).len() == KINDS.len();
        let kept = if whole { all == sum } else { all >= sum };
        probe.check("VAR-1", kept, format!("{sum} variables of all kinds"), found);
        if !probe.session.client.gate().lets_malformed_pass() {
            continue;
        }
        // The same question in no byte at all.
        let absent = Kind::from_field(TextRef::with_tail(ads_cnc::CncStr::EMPTY, None));
        let exchange = probe.send(CountVariables::new(channel, absent))?;
        let data = exchange.answer().and_then(|answer| answer.success().map(<[u8]>::to_vec));
        let same = data.as_deref() == Some(&all.to_le_bytes());
        probe.check(assumed("VAR-1"), same, format!("{all} as for one NUL"), exchange.result());
    }
    Ok(())
}

fn descriptions(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for (name, kind) in kinds(probe) {
            let VariableCount(number) = probe.read("VAR-2", CountVariables::new(channel, kind))?;
            let mut names = HashSet::new();
            for index in 0..number.min(VARIABLES_MAX) {
                let request = DescribeByIndex::new(channel, index, kind);
                let variable: Description = probe.read("VAR-4", request)?;
                holds_together(probe, &variable, name);
                let unique = names.insert(variable.name.text.clone());
                let found = format!("{} again at index {index}", variable.name.text);
                probe.check("VAR-3", unique, "another variable at each index", found);
            }
        }
    }
    Ok(())
}

/// What a description says of itself.
pub(crate) fn holds_together(probe: &mut impl Checks, variable: &Description, kind: &str) {
    let name = variable.name.text.to_string();
    let of_kind = name.strip_prefix(kind).is_some_and(|rest| rest.starts_with('.'));
    probe.check("VAR-3", of_kind, format!("a name of {kind}"), format!("{name:?}"));
    let askable = name.chars().count() < TEXT_MAX;
    probe.check("VAR-9", askable, "a name of at most 255 characters", format!("{name:?}"));
    let readable = !name.chars().any(char::is_control);
    probe.check(assumed("GEN-3"), readable, "a name of CP1252 characters", format!("{name:?}"));
    let known = variable.var_type.name().is_some();
    let expected = "a type from 1 to 9";
    probe.check("VAR-5", known, expected, format!("{} of {name}", variable.var_type.0));
    let access = variable.access;
    let known = matches!(access, VariableAccess::READ_ONLY | VariableAccess::READ_WRITE);
    probe.check("VAR-6", known, "access 1 or 2", format!("{} of {name}", access.0));
    let empty = variable.dimensions.contains(&0);
    let found = format!("{:?} of {name}", variable.dimensions);
    probe.check("VAR-4", !empty, "at least one element in each dimension", found);
    let Some(size) = variable.var_type.element_size() else { return };
    if variable.dimensions.is_empty() {
        let one = variable.size < size.saturating_mul(2);
        let found = format!("{} bytes of {name}", variable.size);
        probe.check("VAR-7", one, "one element where there is no dimension", found);
    }
    let whole = variable.dimensions.iter().fold(size, |size, &n| size.saturating_mul(n));
    let expected = format!("{whole} bytes for {:?} {:?}", variable.dimensions, variable.var_type);
    let found = format!("{} bytes of {name}", variable.size);
    probe.check("VAR-8", variable.size == whole, expected, found);
    // A size read in the wrong order of bytes is the first to leave all limits.
    let plausible = variable.size <= 0x00FF_FFFF;
    probe.check("GEN-1", plausible, "a little-endian size", format!("{:#x}", variable.size));
}

fn index_beyond_last(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for (_, kind) in kinds(probe) {
            let VariableCount(number) = probe.read("VAR-2", CountVariables::new(channel, kind))?;
            let Some(last) = number.checked_sub(1) else {
                let first = DescribeByIndex::new(channel, 0, kind);
                probe.refuses_alone("VAR-2", "index 0 of no variable", first)?;
                continue;
            };
            for index in probe.beyond(number) {
                probe.refuses(
                    "VAR-2",
                    "an index behind the last",
                    DescribeByIndex::new(channel, index, kind),
                    DescribeByIndex::new(channel, last, kind),
                )?;
            }
        }
    }
    Ok(())
}

/// The name of a description, as a request carries it.
pub(super) fn name_of(variable: &Description) -> TextRef<'_> {
    variable.name.text.as_cnc_str().into()
}

fn handle_by_name(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let variables = probe.variables(channel)?;
        let mut handles = HashSet::new();
        for variable in &variables {
            let name = name_of(variable);
            let rules = ["VAR-9", "VAR-10"].map(Rule::from);
            let data = probe.ask_for(&rules, HandleByName { channel, name })?;
            let handle = Handle::decode(&data);
            probe.require(&rules, handle.is_ok(), "a handle of four bytes", Hex(data))?;
            let Ok(handle) = handle else { continue };
            // That there is but one handle is said nowhere: what counts is what it reads.
            let expected = format!("the description's {:?} for {}", variable.handle, name.text());
            let rule = assumed("VAR-10");
            probe.check(rule, handle == variable.handle, expected, format!("{handle:?}"));
            let found = format!("{handle:?} of {} again", name.text());
            probe.check(rule, handles.insert(handle), "a handle of its own", found);
            let whole = |handle| ReadByHandle::new(channel, handle, Numbers::EMPTY);
            let read = probe.ask("VAR-10", whole(handle))?;
            let sized = u32::try_from(read.len()) == Ok(variable.size)
                || variable.var_type.element_size().is_none();
            let found = format!("{} bytes of {}", read.len(), name.text());
            probe.check("VAR-10", sized, format!("its {} bytes", variable.size), found);
        }
    }
    Ok(())
}

fn unknown_name(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let known = variables.first().ok_or(Stop::Inconclusive("no variable".to_owned()))?;
    let known = name_of(known);
    for name in ["V.E.no such variable", "V.E.", "V.X.a", "no kind", ""] {
        let unknown = TextRef::new(name).map_err(harness)?;
        probe.refuses(
            "ADS-4",
            &format!("the name {name:?}"),
            HandleByName { channel, name: unknown },
            HandleByName { channel, name: known },
        )?;
        probe.refuses(
            "ADS-4",
            &format!("the name {name:?}"),
            ReadByName { channel, name: unknown },
            ReadByName { channel, name: known },
        )?;
    }
    Ok(())
}

fn structures_are_resolved(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let names: HashSet<String> =
        variables.iter().map(|variable| variable.name.text.to_string()).collect();
    // Axis variables end in the axis's name; what is before it is no structure.
    let leaf = variables.iter().filter_map(|variable| {
        let name = variable.name.text.to_string();
        let (structure, _) = name.rsplit_once('.')?;
        let is_structure = structure.matches('.').count() > 1 && !name.starts_with("V.A.");
        (is_structure && !names.contains(structure)).then(|| (structure.to_owned(), variable))
    });
    let leaves: Vec<_> = leaf.collect();
    if leaves.is_empty() {
        return Err(Stop::NotApplicable("no variable is part of a structure".to_owned()));
    }
    for (structure, leaf) in leaves {
        let (name, leaf) = (TextRef::new(&structure).map_err(harness)?, name_of(leaf));
        probe.refuses(
            "VAR-20",
            &format!("the structure {structure}"),
            HandleByName { channel, name },
            HandleByName { channel, name: leaf },
        )?;
    }
    Ok(())
}

fn padded_name(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let variable = variables.first().ok_or(Stop::Inconclusive("no variable".to_owned()))?;
    let text = variable.name.text.as_cnc_str();
    let plain = HandleByName { channel, name: text.into() };
    let zeros = [0; 256];
    let tail = zeros.get(..255_usize.saturating_sub(text.len()));
    let padded = HandleByName { channel, name: TextRef::with_tail(text, tail) };
    same(probe, "VAR-9", plain.into(), padded.into())?;
    let tail = zeros.get(..252);
    let kind = Kind::from_field(TextRef::with_tail(Kind::V_E.text(), tail));
    let plain = CountVariables::new(channel, Kind::V_E);
    same(probe, "VAR-1", plain.into(), CountVariables::new(channel, kind).into())
}

/// Asks the same twice, the second time in an assumed form.
fn same(probe: &mut Probe<'_>, rule: &'static str, plain: Request<'_>, odd: Request<'_>) -> Step {
    let expected = probe.send(plain)?;
    let exchange = probe.send(odd)?;
    let data = |exchange: &crate::exchange::Exchange| {
        exchange.answer().and_then(|answer| answer.success().map(<[u8]>::to_vec))
    };
    let kept = data(&exchange).is_some() && data(&exchange) == data(&expected);
    probe.check(assumed(rule), kept, "the same answer as without padding", exchange.result());
    Ok(())
}
