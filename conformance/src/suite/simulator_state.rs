//! Cases that compare values over ADS with the simulated CNC's state: every content has another
//! value, so that none is mistaken for another.

use ads_cnc_vectors::ids::*;

use super::kit::{self, Addresses, JudgedAddress, Probe, is_permutation};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Rule, Step, Stop};
use crate::objects::{List, Object, ValueAddress};
use crate::simulator::{ContentOwner, StoredContent};
use crate::text::hex::spaced;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("held-is-read",
        &[ADR_1, ADR_2, ADR_3, ADR_5, ADR_6, ADR_7, ADR_12, ADR_13, COM_4, COM_5,
            GEN_1, GEN_6],
        Needs::Simulator, is_read,
        "What the CNC holds is read at the address of what holds it, the lowest byte first"),
    case("written-is-held",
        &[ADR_1, ADR_2, ADR_3, ADR_5, ADR_6, ADR_7, ADR_12, ADR_13, COM_5, GEN_1,
            GEN_6],
        Needs::Simulator, is_held,
        "What is written is held by what has the address, and by nothing else"),
    case("held-is-described", &[COM_2, OBJ_1], Needs::Simulator, is_described,
        "All that the CNC holds is in its list, an object with its own name and size"),
];

/// Rounds of values: enough to give each content of one bit a different sequence.
const ROUNDS: u32 = 6;
/// Rounds of longer contents.
const ROUNDS_OF_NUMBERS: u32 = 2;

fn is_bit(held: &StoredContent) -> bool {
    matches!(held.type_name, "BOOL" | "BOOLEAN")
}

/// Whether the value's bytes have an order.
fn is_number(held: &StoredContent) -> bool {
    held.type_name != "STRING" && held.value.len() > 1
}

/// The value of the content with this number, different in each round. All bytes of a number
/// differ, and REALs are finite.
fn value(held: &StoredContent, number: u32, round: u32) -> Vec<u8> {
    if is_bit(held) {
        return vec![u8::from(number.checked_shr(round).unwrap_or_default() & 1 == 1)];
    }
    let mut seed = number.wrapping_mul(0x9E37_79B9) ^ round.wrapping_mul(0x85EB_CA6B);
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let [.., high] = seed.to_le_bytes();
        high
    };
    let len = held.value.len();
    match held.type_name {
        "STRING" => {
            let letters = std::iter::repeat_with(|| b'a'.saturating_add(next() % 26));
            letters.take(len.saturating_sub(1)).chain([0]).collect()
        }
        _ if len == 1 => vec![next()],
        _ => (0_u8..).map(|place| next() & 0x1F | place.wrapping_shl(5)).take(len).collect(),
    }
}

fn same(held: &StoredContent, one: &[u8], other: &[u8]) -> bool {
    kit::same(one, other, held.type_name == "STRING")
}

/// Judges a value over ADS against the expected one. The same bytes in another order are not judged
/// as a wrong address.
fn judge(
    probe: &mut Probe<'_>,
    rules: &[Rule],
    held: &StoredContent,
    (expected, found): (&[u8], Option<&[u8]>),
    result: &str,
) {
    let passed = found.is_some_and(|found| same(held, expected, found));
    let permuted = is_number(held) && found.is_some_and(|found| is_permutation(expected, found));
    let what = || format!("{} of {} ({:?})", spaced(expected), held.name, held.holder);
    let shown = || found.map_or_else(|| result.to_owned(), spaced);
    if is_number(held) && found.is_some_and(|found| found.len() == expected.len()) {
        probe.check(GEN_1, !permuted, what, shown);
    }
    let rules = rules.iter().filter(|rule| !permuted || rule.id == COM_5.as_str()).copied();
    probe.check(&rules.collect::<Vec<_>>(), passed, what, shown);
}

/// Sets and reads every content in each round; the original values are restored in any case.
fn is_read(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let all = cnc.stored_contents();
    if all.is_empty() {
        return Err(Stop::not_applicable("the CNC holds nothing"));
    }
    let addresses = Addresses::new(probe)?;
    let mut done = Ok(());
    for round in 0..ROUNDS {
        let values: Vec<Vec<u8>> =
            (1..).zip(&all).map(|(number, held)| value(held, number, round)).collect();
        all.iter().zip(&values).for_each(|(held, value)| cnc.set_content(held, value));
        let of_round = |held: &StoredContent| is_bit(held) || round < ROUNDS_OF_NUMBERS;
        for (held, value) in all.iter().zip(&values).filter(|(held, _)| of_round(held)) {
            done = done.and_then(|()| read(probe, &addresses, held, value));
        }
    }
    all.iter().for_each(|held| cnc.set_content(held, &held.value));
    done
}

fn read(probe: &mut Probe<'_>, addresses: &Addresses, held: &StoredContent, value: &[u8]) -> Step {
    for (place, rules) in addresses.of(held)? {
        // The program stream and the offsets of functions are not read.
        let Ok(request) = place.read() else { continue };
        let exchange = probe.send(request)?;
        let found = exchange.success();
        judge(probe, &rules, held, (value, found), &exchange.result());
    }
    Ok(())
}

fn is_held(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let all = cnc.stored_contents();
    let addresses = Addresses::new(probe)?;
    let mut done = Ok(());
    for (number, held) in (1..).zip(&all).filter(|(_, held)| held.writable) {
        let value = if is_bit(held) {
            held.value.iter().map(|bit| bit ^ 1).collect()
        } else {
            value(held, number, 0)
        };
        done = done.and_then(|()| write(probe, &all, held, &addresses.of(held)?, &value));
        all.iter().for_each(|held| cnc.set_content(held, &held.value));
    }
    done
}

fn write(
    probe: &mut Probe<'_>,
    all: &[StoredContent],
    held: &StoredContent,
    addresses: &[JudgedAddress],
    value: &[u8],
) -> Step {
    let cnc = probe.cnc()?;
    for (place, rules) in addresses {
        // Other cases judge that the platform's data is under both addresses.
        let rules: Vec<Rule> =
            rules.iter().filter(|rule| rule.id != COM_4.as_str()).copied().collect();
        let Ok(request) = place.write(value) else { continue };
        if probe.target.profile.leaves(&held.name.to_string()) || !probe.may(request)? {
            continue;
        }
        let exchange = probe.send(request)?;
        // Another case judges that a writable content accepts the value.
        if exchange.success().is_none() {
            continue;
        }
        let mut others = Vec::new();
        for (now, before) in cnc.stored_contents().iter().zip(all) {
            if (now.holder, now.element) == (held.holder, held.element) {
                judge(probe, &rules, held, (value, Some(&now.value)), "");
            } else if now.value != before.value {
                others.push(format!("{} ({:?})", now.name, now.holder));
            }
        }
        let expected = || format!("no change but that of {} ({:?})", held.name, held.holder);
        let found = others.join(", ");
        probe.check(&rules, others.is_empty(), expected, found);
        all.iter().for_each(|held| cnc.set_content(held, &held.value));
    }
    Ok(())
}

/// Whether a list has the objects of an owner; channel 1's includes the platform's.
fn is_list_of(holder: ContentOwner, list: List) -> bool {
    match (holder, list) {
        (ContentOwner::Platform, List::Platform) => true,
        (
            ContentOwner::Channel(channel) | ContentOwner::ChannelAxis { channel, .. },
            List::Channel(number),
        ) => channel == number,
        _ => false,
    }
}

fn is_described(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let addresses = Addresses::new(probe)?;
    let objects = addresses.objects();
    let all = cnc.stored_contents();
    for held in &all {
        let mine = |object: &&Object| is_list_of(held.holder, object.list);
        // Other cases judge which instances exist.
        if let Some(count) = addresses.count(held) {
            let expected = || format!("element {} of {:?}", held.element, held.holder);
            let found = || format!("{count} elements");
            probe.check(OBJ_1, held.element <= count, expected, found);
        }
        // That platform axes have lists is assumed; an owner that is not claimed has none.
        if !objects.iter().any(|object| mine(&object)) {
            continue;
        }
        let places = addresses.of(held)?;
        let at = |object: &&Object| {
            let content = object.address.content();
            places.iter().any(|(place, _)| {
                matches!(place, ValueAddress::Object { .. }) && place.content() == content
            })
        };
        let listed = objects.iter().filter(mine).find(at);
        let what = format!("{} ({:?})", held.name, held.holder);
        probe.check(
            [COM_2, OBJ_1],
            listed.is_some(),
            || format!("{what} in its list"),
            "it is not",
        );
        let Some(object) = listed else { continue };
        let sized = u32::try_from(held.value.len()) == Ok(object.size());
        let expected = || format!("{} bytes of {what}", held.value.len());
        probe.check(COM_2, sized, expected, || format!("{} bytes", object.size()));
        // The object may have another name, but not that of another object, nor half of its own.
        let taken = all.iter().any(|one| one.name == object.name);
        let cut = held.name.as_bytes().starts_with(object.name.as_bytes());
        let named = object.name == held.name || !taken && !cut;
        probe.check(COM_2, named, || format!("the name of {what}"), || &object.name);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulator::Cnc;

    /// Values of other contents, and values in another byte order, are detected.
    #[test]
    fn values_are_told_apart() {
        let all = Cnc::with_default_model().unwrap().stored_contents();
        let sequence = |number: u32, held: &StoredContent| {
            let rounds = if is_bit(held) { ROUNDS } else { ROUNDS_OF_NUMBERS };
            (0..rounds).map(|round| value(held, number, round)).collect::<Vec<_>>()
        };
        let sequences: Vec<_> =
            (1..).zip(&all).map(|(number, held)| sequence(number, held)).collect();
        let mut alike = 0;
        for (at, one) in sequences.iter().enumerate() {
            assert_eq!(one[0].len(), all[at].value.len());
            if is_number(&all[at]) {
                let mut reversed = one[0].clone();
                reversed.reverse();
                assert!(is_permutation(&one[0], &reversed));
            }
            alike += sequences[..at].iter().filter(|other| *other == one).count();
        }
        // There are more contents of one bit than sequences.
        assert!(alike < 40, "{alike}");
    }
}
