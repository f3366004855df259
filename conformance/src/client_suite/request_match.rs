//! Compares the requests of a client with the requests that the scenario expects.

use ads_cnc::CncStr;
use ads_cnc::ads::FrameRef;
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::requests::writes;
use super::scenario::{ExpectedRequest, ReadLength};
use super::scenario_checks::ScenarioChecks;
use super::test_server::RecordedExchange;
use crate::judge::assumed;
use crate::number::u32_at;
use crate::text::plural;
use crate::values::until_nul;

/// The fields of a client's request, read from its bytes without the codec. The group is converted
/// by [`logical`].
#[derive(Clone, Debug, PartialEq, Eq)]
struct RawRequest {
    command: u16,
    port: u16,
    group: u32,
    offset: u32,
    length: u32,
    data: Vec<u8>,
}

impl RawRequest {
    fn of(exchange: &RecordedExchange) -> Option<Self> {
        let frame = exchange.request.as_slice();
        let word = |at: usize| u32_at(frame, at);
        let half = |at: usize| {
            let bytes: [u8; 2] = frame.get(at..at.checked_add(2)?)?.try_into().ok()?;
            Some(u16::from_le_bytes(bytes))
        };
        let command = half(22)?;
        let (length, data) = match command {
            2 => (word(46)?, &[][..]),
            3 => (0, frame.get(50..)?),
            9 => (word(46)?, frame.get(54..)?),
            _ => return None,
        };
        let (group, offset) = (logical(word(38)?), word(42)?);
        Some(Self { command, port: half(12)?, group, offset, length, data: data.to_vec() })
    }
}

/// Converts an index group from addressing by rank to logical addressing, for the default model, in
/// which the channels 1, 2 and 6 have the ranks 1, 2 and 3. Groups of spindles and logical groups
/// are returned unchanged.
pub(super) const fn logical(group: u32) -> u32 {
    let spindle = group & 0xF000 == 0x5000;
    let known = group & 0xF0_0000 == 0 && group & 0x0F_0000 >= 0x02_0000;
    match (known && !spindle, group & 0xFF) {
        (false, _) => group,
        (true, 3) => (group & !0xFF) | 0x10_0006,
        (true, _) => group | 0x10_0000,
    }
}

/// Checks that the client sent all requests of the scenario and, unless `may_write`, no write at
/// any other address.
pub(super) fn judge(
    asks: &[ExpectedRequest],
    exchanges: &[RecordedExchange],
    may_write: bool,
    scenario_checks: &mut ScenarioChecks,
) {
    let sent: Vec<(RawRequest, &RecordedExchange)> = exchanges
        .iter()
        .filter_map(|exchange| Some((RawRequest::of(exchange)?, exchange)))
        .collect();
    for ask in asks {
        one(ask, &sent, exchanges, scenario_checks);
    }
    if may_write {
        return;
    }
    for exchange in exchanges {
        let Some(clause) = writes(exchange) else { continue };
        let is_expected = RawRequest::of(exchange).is_some_and(|sent| {
            asks.iter().any(|ask| (ask.group, ask.offset) == (sent.group, sent.offset))
        });
        scenario_checks.check(clause, is_expected, Some(exchange), "no other write", "a write");
    }
}

fn one(
    ask: &ExpectedRequest,
    sent: &[(RawRequest, &RecordedExchange)],
    exchanges: &[RecordedExchange],
    scenario_checks: &mut ScenarioChecks,
) {
    let place = |one: &RawRequest| (one.group, one.offset) == (ask.group, ask.offset);
    let is_data = |one: &RawRequest| one.data == ask.data || ask.also.contains(&one.data);
    let service = |one: &RawRequest| one.command == ask.command;
    // The request that is most similar to the expected request, by the ranking in `alike`.
    let nearest = sent.iter().max_by_key(|(one, _)| {
        let alike = [
            place(one) && is_data(one) && service(one) && one.port == ask.port,
            place(one) && is_data(one) && service(one),
            place(one) && service(one),
            is_data(one) && service(one) && one.group == ask.group,
            is_data(one) && service(one) && one.offset == ask.offset,
            place(one),
            is_data(one) && !ask.data.is_empty(),
            service(one),
        ];
        alike.iter().position(|alike| *alike).map_or(0, |at| alike.len().saturating_sub(at))
    });
    let Some((one, exchange)) = nearest else {
        let found = match exchanges.last() {
            None => "no request",
            Some(_) => "no similar request",
        };
        scenario_checks.check(ask.place, false, exchanges.last(), || describe(ask), found);
        return;
    };
    let exchange = Some(*exchange);
    let hex = |number: u32| move || format!("{number:#x}");
    let found = || format!("command {}", one.command);
    scenario_checks.check(
        ask.service_rule(),
        service(one),
        exchange,
        || format!("command {}: {}", ask.command, describe(ask)),
        found,
    );
    if !service(one) {
        scenario_checks.check(ask.place, false, exchange, || describe(ask), found);
        return;
    }
    // The manuals assign only the variables of the decoder to SDA (ADR-10). For other classes, the
    // port of GEO is accepted too.
    let is_decoder = ask.group & 0xF000 == 0x2000;
    let port = one.port == ask.port || (ask.port, one.port) == (552, 551) && !is_decoder;
    scenario_checks.check(GEN_4, port, exchange, || format!("port {}", ask.port), || one.port);
    let group = one.group == ask.group;
    scenario_checks.check(ask.group_rule(), group, exchange, hex(ask.group), hex(one.group));
    let offset = one.offset == ask.offset;
    scenario_checks.check(
        ask.place,
        group && offset,
        exchange,
        || format!("index group {:#x}, index offset {:#x}", ask.group, ask.offset),
        || format!("{:#x}, {:#x}", one.group, one.offset),
    );
    let (expected, found) = (|| Hex(ask.data.clone()), || Hex(one.data.clone()));
    if ask.tolerated.contains(&one.data) {
        scenario_checks.check(assumed(ask.stream), false, exchange, expected, found);
    } else if !ask.data.is_empty() || !one.data.is_empty() {
        let rule = if is_in_utf8(&ask.data, &one.data) { GEN_3.into() } else { ask.stream };
        scenario_checks.check(rule, is_data(one), exchange, expected, found);
    }
    let enough = match ask.length {
        ReadLength::AtLeast(least) => one.length >= least,
        ReadLength::Times(size) => one.length > 0 && one.length.checked_rem(size) == Some(0),
    };
    let expected = || match ask.length {
        ReadLength::AtLeast(least) => {
            format!("a read length of at least {}", plural(least, "byte"))
        }
        ReadLength::Times(size) => format!("a read length of {size} or a multiple of it"),
    };
    let rule = if matches!(ask.length, ReadLength::Times(_)) { COM_3 } else { ask.service_rule() };
    scenario_checks
        .check(rule, enough, exchange, expected, || format!("a read length of {}", one.length));
}

/// Whether the data starts with the expected text in UTF-8 instead of CP1252, and the text has
/// characters whose bytes differ.
fn is_in_utf8(expected: &[u8], found: &[u8]) -> bool {
    let text = until_nul(expected);
    let utf8 = CncStr::from_bytes(text).map(|text| text.to_string()).unwrap_or_default();
    !utf8.is_empty() && utf8.as_bytes() != text && found.starts_with(utf8.as_bytes())
}

fn describe(ask: &ExpectedRequest) -> String {
    let service = match ask.command {
        2 => "Read",
        3 => "Write",
        _ => "ReadWrite",
    };
    let ExpectedRequest { group, offset, port, data, .. } = ask;
    let data = if data.is_empty() { String::new() } else { format!(" of {}", Hex(data.clone())) };
    format!("{service} {group:#x}, {offset:#x} at port {port}{data}")
}

/// The result in the reply to a Write; `None` if the reply is not a complete frame with a result.
pub(super) fn result_of(exchange: &RecordedExchange) -> Option<u32> {
    let (frame, _) = FrameRef::split(&exchange.sent, u32::MAX).ok()??;
    u32_at(frame.data(), 0)
}
