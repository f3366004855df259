//! Cases of the structure of names, of variables that are accessible by name only, and of texts.

use ads_cnc::operation::{DynamicValueByName, HandleByName, ReadByName};
use ads_cnc::{CncString, TextRef, VariablePath, VariableType};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Compared, Probe, Steady, compare, dynamic_among_variables, name_of};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, OrStop as _, Step, Stop, assumed};
use crate::text::plural;
use crate::values::until_nul;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("var-names-are-paths", &[VAR_20], Needs::Queries, paths,
        "Each name is a path of structures, indices and a variable"),
    case("var-by-name-only", &[VAR_18], Needs::Queries, by_name_only,
        "A variable accessible only by name is read by its name and has no handle"),
    case("var-dynamic-by-name", &[VAR_18, VAR_19, DYN_3, VAR_14, GEN_1], Needs::Queries, dynamic_by_name,
        "V.P, V.L and V.S have the same value as variables and as dynamic parameters"),
    case("var-texts", &[VAR_22], Needs::Queries, texts,
        "A text ends at its first NUL, or at the end of the value"),
];

fn paths(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            let name = &variable.name.text;
            let path = VariablePath::from_text(name.as_cnc_str());
            let found = || match &path {
                Ok(_) => name.to_string(),
                Err(error) => format!("{name}: {error}"),
            };
            probe.check(
                VAR_20,
                path.is_ok(),
                "a name that consists of structures, indices and a variable",
                found,
            );
            let Ok(path) = path else { continue };
            // An array is described as a single variable; its elements have no description.
            let whole = path.elements().is_empty();
            probe.check(VAR_20, whole, "the name of the variable, not of an element", found);
        }
    }
    Ok(())
}

/// The name of the first described variable of the first channel. The request for its handle is the
/// valid request with which a rejected request is compared.
fn known(probe: &mut Probe<'_>) -> Step<CncString> {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let known = variables.first().or_inconclusive("no variable")?;
    Ok(known.name.text.clone())
}

fn by_name_only(probe: &mut Probe<'_>) -> Step {
    let names = probe.target.profile.by_name_only.clone();
    if names.is_empty() {
        return Err(Stop::not_applicable(
            "no variable is known that has only a name; a profile can name one",
        ));
    }
    let (channel, known) = (probe.channel()?, known(probe)?);
    for name in names.iter() {
        let name = TextRef::new(name)?;
        probe.ask(VAR_18, ReadByName { channel, name })?;
        let valid = HandleByName { channel, name: known.as_cnc_str().into() };
        let what = format!("the handle of {}", name.text());
        probe.rejects(VAR_18, &what, HandleByName { channel, name }, valid)?;
    }
    Ok(())
}

fn dynamic_by_name(probe: &mut Probe<'_>) -> Step {
    let all = dynamic_among_variables(probe)?;
    let (channel, known) = (probe.channel()?, known(probe)?);
    let mut steady = Steady::default();
    for (kind, name) in &all {
        let name = TextRef::from(name.as_cnc_str());
        let by_name = ReadByName { channel, name };
        let one = DynamicValueByName { channel, kind: *kind, name };
        let compared = compare(
            probe,
            |probe| probe.try_ask(one),
            |probe, _| probe.try_ask(by_name),
            |before, read| before == read,
        )?;
        if matches!(compared, Compared::Same) {
            probe.pass([DYN_3, VAR_14, GEN_1]);
        }
        steady.judge(probe, VAR_19, &name.text(), compared, |probe, rules, (before, read, _)| {
            let (expected, found) = (|| Hex(before.clone()), || Hex(read.clone()));
            probe.check(rules, false, expected, found);
            // Either the value of the parameter (DYN-3) or the value of the variable (VAR-14) may
            // be wrong.
            probe.check([DYN_3, VAR_14], false, expected, found);
            let (low, high) = before.split_at(before.len() / 2);
            let is_reversed = before.iter().rev().eq(&read) || [high, low].concat() == read;
            probe.check(GEN_1, !is_reversed, expected, found);
        });
        let valid = HandleByName { channel, name: known.as_cnc_str().into() };
        let what = format!("the handle of {}", name.text());
        probe.rejects(VAR_18, &what, HandleByName { channel, name }, valid)?;
    }
    steady.finish()
}

fn texts(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            if variable.var_type != VariableType::STRING || !variable.dimensions.is_empty() {
                continue;
            }
            probe.found_subject();
            let value = probe.try_ask(ReadByName { channel, name: name_of(&variable) })?;
            let Some(value) = value else { continue };
            let found = || format!("{} of {}", plural(value.len(), "byte"), variable.name.text);
            let fits = u32::try_from(value.len()).is_ok_and(|len| len <= variable.size);
            let expected =
                || format!("at most the {} of its description", plural(variable.size, "byte"));
            probe.check(assumed(VAR_22), fits, expected, found);
            let text = until_nul(&value);
            let readable = text.iter().all(|&byte| byte >= b' ' || byte == b'\t');
            let found = || format!("{text:02x?} of {}", variable.name.text);
            probe.check(assumed(VAR_22), readable, "characters up to the first NUL", found);
        }
    }
    probe.finish("no variable is a STRING")
}
