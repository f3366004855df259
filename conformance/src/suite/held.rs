//! Cases that hold what is read and written over ADS against what the CNC has within: every
//! content another value, so that none passes for another.

use ads_cnc::address::{
    Access, Addressing, Attribute, AxisStride, Class, ClassGroup, ComGroup, ComTable,
    ElementAddress, IndexOffset,
};
use ads_cnc_vectors::Hex;

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::numbers::is_permuted;
use super::place::Place;
use super::probe::{Probe, harness};
use crate::cnc::{Held, Holder};

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "held-is-read",
            "What the CNC holds is read at the address of what holds it, the lowest byte first",
            [
                "ADR-1", "ADR-2", "ADR-3", "ADR-5", "ADR-6", "ADR-7", "ADR-12", "ADR-13", "COM-4",
                "COM-5", "GEN-1", "GEN-6"
            ],
            Embedded,
            is_read
        ),
        declare!(
            "written-is-held",
            "What is written is held by what has the address, and by nothing else",
            [
                "ADR-1", "ADR-2", "ADR-3", "ADR-5", "ADR-6", "ADR-7", "ADR-12", "ADR-13", "COM-4",
                "COM-5", "GEN-1", "GEN-6"
            ],
            Embedded,
            is_held
        ),
    ]
}

/// Rounds of values: enough to give each content of one bit another sequence of them.
const ROUNDS: u32 = 6;
/// Rounds of longer contents.
const ROUNDS_OF_NUMBERS: u32 = 2;

fn is_bit(held: &Held) -> bool {
    matches!(held.type_name, "BOOL" | "BOOLEAN")
}

/// Whether its bytes have an order.
fn is_number(held: &Held) -> bool {
    held.type_name != "STRING" && held.value.len() > 1
}

/// A value of the content with this number, another in each round. No two bytes of a number are
/// the same, and no REAL is an odd one.
fn value(held: &Held, number: u32, round: u32) -> Vec<u8> {
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

/// The offset of an element of an axis as its object address has it: the stride is printed for the
/// decoder and for the HLD, and of other classes nobody says it (ADR-7).
fn told(probe: &mut Probe<'_>, held: &Held) -> Step<Option<IndexOffset>> {
    let (class, channel, axis) = match held.holder {
        Holder::OfAxis { class, axis } => (class, 0, axis),
        Holder::OfPlace { class, channel, place } => (class, channel, place),
        _ => return Ok(None),
    };
    if matches!(class, Class::Decoder | Class::Hld) {
        return Ok(None);
    }
    let instances = match probe.instances() {
        Err(Stop::NotApplicable(_)) => Vec::new(),
        instances => instances?,
    };
    let wanted = (class, u32::from(channel), u32::from(axis));
    let one = instances.iter().find(|one| (one.class, one.channel, one.axis) == wanted);
    let element = one.and_then(|one| one.first.following(held.element).ok());
    Ok(element.map(ElementAddress::index_offset))
}

/// Where a content is, by everything that is said of addresses, and by what rules.
fn addresses(probe: &mut Probe<'_>, held: &Held) -> Step<Vec<(Place, Vec<Rule>)>> {
    use Addressing::{Index, Logical};
    let told = told(probe, held)?;
    let size = u32::try_from(held.value.len()).map_err(harness)?;
    let channels = &probe.session.profile.channels;
    let first = channels.first().copied();
    let rank = |channel: u8| (1_u8..).zip(channels.iter()).find(|one| *one.1 == u32::from(channel));
    let rank = |channel: u8| rank(channel).map(|(rank, _)| rank);
    let offset =
        |axis: u8, stride| IndexOffset::of_axis(stride, axis.into(), held.element).map_err(harness);
    let object = |addressing, table, instance, offset| {
        let group = ComGroup { addressing, access: Access::Element, table, instance };
        Place::Object { group: group.index_group(), offset, size }
    };
    let element = |addressing, class, instance, offset| {
        let attribute = Attribute::Content;
        let group = ClassGroup { addressing, class, attribute, instance };
        Place::Element { element: ElementAddress::new(group, offset), length: size }
    };
    let own = offset(0, AxisStride::X10000)?;
    let rules = |ids: &[&'static str]| ids.iter().map(|&id| Rule::from(id)).collect::<Vec<_>>();
    // Each in both forms of its group.
    let both = |of: &dyn Fn(Addressing, u8) -> Place, channel: u8, logical: &[&'static str]| {
        let by_rank = rank(channel).map(|rank| (of(Index, rank), rules(&["ADR-1", "ADR-12"])));
        let logical = rank(channel).map(|_| (of(Logical, channel), rules(logical)));
        logical.into_iter().chain(by_rank).collect::<Vec<_>>()
    };
    Ok(match held.holder {
        Holder::Platform => {
            let of = |addressing, instance| object(addressing, ComTable::Channel, instance, own);
            let mut all = vec![
                (of(Logical, 0), rules(&["COM-5", "COM-4", "ADR-3"])),
                (of(Index, 0), rules(&["ADR-12"])),
            ];
            // Channel 1 drives it.
            if first == Some(1) {
                all.push((of(Logical, 1), rules(&["COM-4", "ADR-3"])));
            }
            all
        }
        Holder::Channel(channel) => {
            let of = |addressing, instance| object(addressing, ComTable::Channel, instance, own);
            both(&of, channel, &["COM-5", "ADR-3"])
        }
        Holder::PlatformAxis(axis) => {
            let of = |addressing| object(addressing, ComTable::Axis, axis, own);
            vec![
                (of(Logical), rules(&["COM-5", "ADR-3", "ADR-13", "GEN-6"])),
                (of(Index), rules(&["ADR-12"])),
            ]
        }
        Holder::ChannelAxis { channel, place } => {
            let at = offset(place, AxisStride::X10000)?;
            let of = |addressing, instance| object(addressing, ComTable::Channel, instance, at);
            both(&of, channel, &["COM-5", "ADR-13"])
        }
        Holder::OfChannel { class, channel } => {
            let of = |addressing, instance| element(addressing, class, instance, own);
            both(&of, channel, &["ADR-5", "ADR-6"])
        }
        Holder::OfAxis { class, axis } => {
            // As printed, E-01.
            let stride = if class == Class::Hld { AxisStride::X1000 } else { AxisStride::X10000 };
            let mut rules = rules(&["ADR-5", "ADR-13", "GEN-6"]);
            rules.push(assumed("ADR-7"));
            let at = told.unwrap_or(offset(axis, stride)?);
            vec![(element(Logical, class, 0, at), rules)]
        }
        Holder::OfPlace { class, channel, place } => {
            let at = told.unwrap_or(offset(place, AxisStride::X10000)?);
            let of = |addressing, instance| element(addressing, class, instance, at);
            let printed = if class == Class::Decoder { "ADR-7" } else { "ADR-5" };
            both(&of, channel, &[printed, "ADR-13", "GEN-6"])
        }
        Holder::Spindle(index) => {
            vec![(element(Index, Class::Spindle, index, own), rules(&["ADR-2", "ADR-5", "GEN-6"]))]
        }
    })
}

fn same(held: &Held, one: &[u8], other: &[u8]) -> bool {
    let text = |bytes: &[u8]| bytes.split(|&byte| byte == 0).next().map(<[u8]>::to_vec);
    one == other || held.type_name == "STRING" && text(one) == text(other)
}

/// The element that a content is, if it is one, at its first address.
pub(super) fn element_of(probe: &mut Probe<'_>, held: &Held) -> Step<Option<ElementAddress>> {
    let first = addresses(probe, held)?.into_iter().next();
    Ok(first.and_then(|(place, _)| match place {
        Place::Element { element, .. } => Some(element),
        _ => None,
    }))
}

/// Judges a value that was read or is held now. One with its bytes in another order is of the
/// right place.
fn judge(
    probe: &mut Probe<'_>,
    rules: &[Rule],
    held: &Held,
    (expected, found): (&[u8], Option<&[u8]>),
    result: &str,
) {
    let kept = found.is_some_and(|found| same(held, expected, found));
    let permuted = is_number(held) && found.is_some_and(|found| is_permuted(expected, found));
    let what = format!("{} of {} ({:?})", Hex(expected.to_vec()), held.name, held.holder);
    let shown = found.map_or_else(|| result.to_owned(), |found| Hex(found.to_vec()).to_string());
    if is_number(held) && found.is_some_and(|found| found.len() == expected.len()) {
        probe.check("GEN-1", !permuted, &what, &shown);
    }
    for &rule in rules.iter().filter(|rule| !permuted || rule.id == "COM-5") {
        probe.check(rule, kept, &what, &shown);
    }
}

/// Every content with its values over the rounds; they are put back whatever comes of it.
fn is_read(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let all = cnc.held();
    if all.is_empty() {
        return Err(Stop::NotApplicable("the CNC holds nothing".to_owned()));
    }
    let mut done = Ok(());
    for round in 0..ROUNDS {
        let values: Vec<Vec<u8>> =
            (1..).zip(&all).map(|(number, held)| value(held, number, round)).collect();
        all.iter().zip(&values).for_each(|(held, value)| cnc.hold(held, value));
        let of_round = |held: &Held| is_bit(held) || round < ROUNDS_OF_NUMBERS;
        for (held, value) in all.iter().zip(&values).filter(|(held, _)| of_round(held)) {
            done = done.and_then(|()| read(probe, held, value));
        }
    }
    all.iter().for_each(|held| cnc.hold(held, &held.value));
    done
}

fn read(probe: &mut Probe<'_>, held: &Held, value: &[u8]) -> Step {
    for (place, rules) in addresses(probe, held)? {
        // Of the program stream, and where functions are, nothing is read.
        let Ok(request) = place.read() else { continue };
        let exchange = probe.send(request)?;
        let found = exchange.answer().and_then(|answer| answer.success());
        judge(probe, &rules, held, (value, found), &exchange.result());
    }
    Ok(())
}

fn is_held(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let all = cnc.held();
    let mut done = Ok(());
    for (number, held) in (1..).zip(&all).filter(|(_, held)| held.writable) {
        let value = match is_bit(held) {
            true => held.value.iter().map(|bit| bit ^ 1).collect(),
            false => value(held, number, 0),
        };
        done = done.and_then(|()| write(probe, &all, held, &value));
        all.iter().for_each(|held| cnc.hold(held, &held.value));
    }
    done
}

fn write(probe: &mut Probe<'_>, all: &[Held], held: &Held, value: &[u8]) -> Step {
    let cnc = probe.cnc()?;
    for (place, rules) in addresses(probe, held)? {
        let Ok(request) = place.write(value) else { continue };
        if probe.session.profile.leaves(&held.name.to_string()) || !probe.may(request)? {
            continue;
        }
        let exchange = probe.send(request)?;
        // That what may be written is taken is judged elsewhere.
        if exchange.answer().is_none_or(|answer| answer.success().is_none()) {
            continue;
        }
        let mut others = Vec::new();
        for (now, before) in cnc.held().iter().zip(all) {
            if (now.holder, now.element) == (held.holder, held.element) {
                judge(probe, &rules, held, (value, Some(&now.value)), "");
            } else if now.value != before.value {
                others.push(format!("{} ({:?})", now.name, now.holder));
            }
        }
        let expected = format!("no change but that of {} ({:?})", held.name, held.holder);
        let found = others.join(", ");
        for &rule in &rules {
            probe.check(rule, others.is_empty(), &expected, &found);
        }
        all.iter().for_each(|held| cnc.hold(held, &held.value));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cnc::Cnc;

    /// What is read in place of another, or in another order, is not taken for it.
    #[test]
    fn values_are_told_apart() {
        let all = Cnc::with_default_model().unwrap().held();
        let sequence = |number: u32, held: &Held| {
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
                assert!(is_permuted(&one[0], &reversed));
            }
            alike += sequences[..at].iter().filter(|other| *other == one).count();
        }
        // More contents of a bit than there are sequences.
        assert!(alike < 40, "{alike}");
    }
}
