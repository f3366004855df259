//! Cases that write variables one after another, and check that no write changes another of the
//! variables read. They write the writable variables that the cases read, do not belong to the
//! Service Interface and do not change by themselves. The case of the axis interface writes only
//! axis variables.

use ads_cnc::VariableType;
use ads_cnc::address::Channel;
use ads_cnc::{Description, VariableAccess};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, axis_address, is_of_service};
use super::row::{CaseRow, case};
use crate::evidence::Evidence;
use crate::judge::{Checks as _, Needs, Rule, Step, Stop};
use crate::objects::ValueAddress;
use crate::rules::element_count;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-nothing-else-by-name", &[VAR_13], Needs::MalformedWrites, by_name,
        "A write by name changes the named variable, and no other in any channel"),
    case("write-nothing-else-by-handle", &[VAR_12], Needs::MalformedWrites, by_handle,
        "A write by handle changes the variable of the handle, and no other in any channel"),
    case("write-nothing-else-of-axes", &[VAR_26], Needs::MalformedWrites, of_axes,
        "A write on the axis interface changes the variable of its axis index, and no other"),
];

/// A variable with its initial value (`start`), its expected value (`value`) and its values in each
/// pass.
struct WatchedVariable {
    channel: Channel,
    variable: Description,
    start: Vec<u8>,
    value: Vec<u8>,
    /// The address on the axis interface, for the case that writes at this address.
    at: Option<ValueAddress>,
    seen: Vec<ReadValue>,
}

/// The expected and the actual value of a variable after a pass of writes.
struct ReadValue {
    expected: Vec<u8>,
    read: Vec<u8>,
    evidence: Option<Evidence>,
}

impl WatchedVariable {
    fn by_name(&self) -> ValueAddress {
        ValueAddress::Name { channel: self.channel, name: self.variable.name.text.clone() }
    }

    fn by_handle(&self) -> ValueAddress {
        let handle = self.variable.handle;
        ValueAddress::of_handle(self.channel, handle)
    }
}

/// The variables that the cases read and whose value did not change between two reads, so that a
/// later change is probably the effect of a write.
fn steady_variables(probe: &mut Probe<'_>) -> Step<Vec<WatchedVariable>> {
    let mut all = Vec::new();
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            let (start, value, seen) = (Vec::new(), Vec::new(), Vec::new());
            let mut one = WatchedVariable { channel, variable, start, value, at: None, seen };
            if let Some(value) = probe.value_at(&one.by_handle())? {
                (one.start, one.value) = (value.clone(), value);
                all.push(one);
            }
        }
    }
    // Each value is read again after all others were read, to exclude values that change by
    // themselves.
    let mut steady = Vec::new();
    for one in all {
        if probe.value_at(&one.by_handle())?.as_ref() == Some(&one.start) {
            steady.push(one);
        }
    }
    if steady.is_empty() {
        return Err(Stop::inconclusive("every variable changes by itself"));
    }
    Ok(steady)
}

/// A valid value of the variable. For an integer or a BOOLEAN, it differs from `value` in every
/// byte; for other types, it usually differs. Values with another `salt` usually differ, except
/// those of a BOOLEAN.
fn other_value(variable: &Description, value: &[u8], salt: usize) -> Vec<u8> {
    let mixed = (0_usize..).zip(value).map(|(place, byte)| {
        let mixed = place.wrapping_mul(37).wrapping_add(salt.wrapping_mul(101)) & 0xFF;
        let mixed = u8::try_from(mixed).unwrap_or_default();
        if mixed == *byte { !mixed } else { mixed }
    });
    match variable.var_type {
        VariableType::BOOLEAN => value.iter().map(|byte| byte ^ 1).collect(),
        // The bits of the exponent are changed so that every value is a normal number.
        VariableType::REAL64 => {
            let exponent = |(place, byte): (usize, u8)| match place % 8 {
                7 => 0x40 | byte & 0x80,
                6 => byte & 0x7F | 0x10,
                _ => byte,
            };
            mixed.enumerate().map(exponent).collect()
        }
        VariableType::STRING => {
            let letter = b'a'.saturating_add(u8::try_from(salt % 26).unwrap_or_default());
            let texts = element_count(&variable.dimensions);
            let size = usize::try_from(texts).ok().and_then(|texts| value.len().checked_div(texts));
            let size = size.unwrap_or_default().max(1);
            let ended = |(place, _): (usize, &u8)| match place.checked_rem(size) {
                Some(place) if place.saturating_add(1) < size => letter,
                _ => 0,
            };
            value.iter().enumerate().map(ended).collect()
        }
        _ => mixed.collect(),
    }
}

/// Writes the writable variables in order, or in reverse order if `backwards`, and then reads all
/// variables. `by` returns the address of a write, or `None` to leave out the variable; `look`
/// returns the address of a read. The variables of the Service Interface are not written.
fn write_and_read_all(
    probe: &mut Probe<'_>,
    all: &mut [WatchedVariable],
    (backwards, salt): (bool, usize),
    by: impl Fn(&WatchedVariable) -> Option<ValueAddress>,
    look: impl Fn(&WatchedVariable) -> ValueAddress,
) -> Step {
    let mut order: Vec<usize> = (0..all.len()).collect();
    if backwards {
        order.reverse();
    }
    for number in order {
        let Some(one) = all.get_mut(number) else { continue };
        let writable = one.variable.access == VariableAccess::READ_WRITE;
        if !writable || is_of_service(&one.variable) {
            continue;
        }
        let Some(place) = by(one) else { continue };
        let value = other_value(&one.variable, &one.value, salt.wrapping_add(number));
        if probe.write_value(&place, &value)? {
            one.value = value;
        }
    }
    for one in all {
        let place = look(one);
        let read = probe.value_at(&place)?.unwrap_or_default();
        let evidence = probe.evidence().filter(|_| read != one.value);
        // A value that has begun to change by itself is not judged.
        if read != one.value && probe.moves(&place, false)? {
            continue;
        }
        one.seen.push(ReadValue { expected: one.value.clone(), read, evidence });
    }
    Ok(())
}

/// Whether channels may share a variable: another channel has a variable with the same name that
/// had the same initial value and the same value after each pass.
fn is_shared(all: &[WatchedVariable], one: &WatchedVariable) -> bool {
    let reads = |one: &WatchedVariable| -> Vec<Vec<u8>> {
        one.seen.iter().map(|seen| seen.read.clone()).chain([one.start.clone()]).collect()
    };
    let same = |other: &WatchedVariable| {
        other.channel != one.channel
            && other.variable.name.text == one.variable.name.text
            && reads(other) == reads(one)
    };
    all.iter().any(same)
}

/// Checks that each variable had its expected value after each pass: the value of the last accepted
/// write, or the initial value. Variables that channels may share are not judged as wrong.
fn judge(probe: &mut Probe<'_>, rule: Rule, all: &[WatchedVariable]) {
    for one in all {
        let wrong = one.seen.iter().filter(|seen| seen.expected != seen.read);
        let mut wrong = wrong.filter(|_| !is_shared(all, one)).peekable();
        if wrong.peek().is_none() {
            probe.pass(rule);
        }
        for seen in wrong {
            let (name, channel) = (&one.variable.name.text, one.channel.number());
            let expected =
                || format!("{} of {name} of channel {channel}", Hex(seen.expected.clone()));
            probe.set_evidence(seen.evidence.clone());
            probe.check(rule, false, expected, || Hex(seen.read.clone()));
        }
    }
}

/// Restores the initial value of each variable whose last accepted write had a value other than the
/// initial one, at the first of its addresses that restores the value.
fn restore_all(probe: &mut Probe<'_>, rule: Rule, all: &mut [WatchedVariable]) -> Step {
    for one in all.iter_mut().filter(|one| one.start != one.value) {
        let ways = [one.at.clone(), Some(one.by_handle()), Some(one.by_name())];
        for place in ways.into_iter().flatten() {
            let start = one.start.clone();
            if probe.write_value(&place, &start)? && probe.value_at(&place)? == Some(start) {
                one.value = one.start.clone();
                break;
            }
        }
        let (name, passed) = (&one.variable.name.text, one.value == one.start);
        let expected = || format!("{} of {name}, restored", Hex(one.start.clone()));
        probe.check(rule, passed, expected, "another value");
    }
    Ok(())
}

/// Writes the variables in two passes, the second in reverse order, to detect effects of a write on
/// variables that were written earlier in the pass. `by` returns the address of a write, `look`
/// that of a read, which is of another kind.
fn both_ways(
    probe: &mut Probe<'_>,
    rule: Rule,
    mut all: Vec<WatchedVariable>,
    by: impl Fn(&WatchedVariable) -> Option<ValueAddress>,
    look: impl Fn(&WatchedVariable) -> ValueAddress,
) -> Step {
    let mut tried = Ok(());
    for (backwards, salt) in [(false, 1), (true, 1001)] {
        tried =
            tried.and_then(|()| write_and_read_all(probe, &mut all, (backwards, salt), &by, &look));
    }
    judge(probe, rule, &all);
    let restored = restore_all(probe, rule, &mut all);
    tried.and(restored)
}

fn by_name(probe: &mut Probe<'_>) -> Step {
    let all = steady_variables(probe)?;
    both_ways(probe, VAR_13.into(), all, |one| Some(one.by_name()), WatchedVariable::by_handle)
}

fn by_handle(probe: &mut Probe<'_>) -> Step {
    let all = steady_variables(probe)?;
    both_ways(probe, VAR_12.into(), all, |one| Some(one.by_handle()), WatchedVariable::by_name)
}

fn of_axes(probe: &mut Probe<'_>) -> Step {
    let mut all = steady_variables(probe)?;
    for one in &mut all {
        one.at = axis_address(probe, one.channel, &one.variable)?;
    }
    if all.iter().all(|one| one.at.is_none()) {
        return Err(Stop::not_applicable("no axis variable is on the axis interface"));
    }
    both_ways(probe, VAR_26.into(), all, |one| one.at.clone(), WatchedVariable::by_handle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ads_cnc::{Handle, Text};

    fn of_type(var_type: VariableType, dimensions: &[u32]) -> Description {
        Description {
            handle: Handle(1),
            var_type,
            access: VariableAccess::READ_WRITE,
            size: 0,
            dimensions: dimensions.to_vec(),
            name: "V.E.a".parse::<Text>().unwrap(),
        }
    }

    #[test]
    fn every_byte_of_a_number_changes() {
        for salt in 0..300 {
            let old = [0, 1, 255, 37, 74, 111, 148, 185];
            for var_type in [VariableType::UNS32, VariableType::SGN08] {
                let new = other_value(&of_type(var_type, &[]), &old, salt);
                assert!(new.iter().zip(old).all(|(new, old)| *new != old));
            }
            let new = other_value(&of_type(VariableType::REAL64, &[]), &old, salt);
            let number = f64::from_le_bytes(new.try_into().unwrap());
            assert!(number.is_normal(), "{number}");
        }
    }

    #[test]
    fn texts_are_terminated_and_booleans_stay_0_or_1() {
        let new = other_value(&of_type(VariableType::STRING, &[2]), &[0; 6], 27);
        assert_eq!(new, *b"bb\0bb\0");
        assert_eq!(other_value(&of_type(VariableType::BOOLEAN, &[2]), &[0, 1], 5), [1, 0]);
    }
}
