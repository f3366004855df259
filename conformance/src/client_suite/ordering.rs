//! Checks the order and the data of a client's requests: of the packets of an NC program, and of
//! the reads and writes of the variables of the Service Interface.

use ads_cnc::operation::Request;
use ads_cnc::service::ServiceVariable;
use ads_cnc_vectors::ids::*;

use super::request_match::result_of;
use super::requests::with_request;
use super::scenario::{RequestOrder, Scenario};
use super::scenario_checks::ScenarioChecks;
use super::script::ScenarioScript;
use super::test_server::RecordedExchange;
use crate::judge::assumed;
use crate::text::plural;
use crate::values::until_nul;

/// Maximum length in bytes of a packet, and so of a line with its CR LF.
const PACKET_MAX: usize = 992;

/// Judges the order of the requests of a scenario.
pub(super) fn judge(
    watch: RequestOrder,
    scenario: &Scenario,
    script: &ScenarioScript,
    exchanges: &[RecordedExchange],
    scenario_checks: &mut ScenarioChecks,
) {
    match watch {
        RequestOrder::Stream => stream(scenario, exchanges, scenario_checks),
        RequestOrder::NoStream(rule) => {
            let sent = packets(exchanges).into_iter().next();
            let expected = "no part of a program that cannot be streamed";
            let exchange = sent.as_ref().map(|(exchange, _)| *exchange);
            let rule = if rule == STM_8 { assumed(rule) } else { rule.into() };
            scenario_checks.check(
                rule,
                sent.is_none(),
                exchange,
                expected,
                "a packet of the program",
            );
        }
        RequestOrder::Host => host(script, exchanges, scenario_checks),
        RequestOrder::IdleHost => {
            let written =
                accesses(script, exchanges).into_iter().find(|access| access.value.is_some());
            let exchange = written.as_ref().map(|access| access.exchange);
            let expected = "no response without a request to its own service";
            scenario_checks.check(SVC_2, written.is_none(), exchange, expected, "a write");
        }
        RequestOrder::Caller => caller(script, exchanges, scenario_checks),
    }
}

/// The writes to the program stream of channel 1 with their data, identified without the codec.
fn packets(exchanges: &[RecordedExchange]) -> Vec<(&RecordedExchange, &[u8])> {
    let is_one = |frame: &[u8]| {
        let group = frame.get(38..42);
        let at = frame.get(42..46) == Some(&[0x90, 0, 0, 0]);
        let of_channel = group == Some(&[1, 1, 0x12, 0]) || group == Some(&[1, 1, 0x02, 0]);
        frame.get(22..24) == Some(&[3, 0]) && of_channel && at
    };
    let data = |exchange: &'_ RecordedExchange| is_one(&exchange.request).then_some(());
    exchanges
        .iter()
        .filter(|exchange| data(exchange).is_some())
        .map(|exchange| (exchange, exchange.request.get(50..).unwrap_or_default()))
        .collect()
}

/// The program as the client must send it, with CR LF after every line.
fn on_the_wire(program: &[u8]) -> Vec<u8> {
    let text = program.strip_suffix(b"\n").unwrap_or(program);
    let lines = text.split(|&byte| byte == b'\n');
    let mut wire = Vec::new();
    for line in lines {
        wire.extend(line.strip_suffix(b"\r").unwrap_or(line));
        wire.extend(b"\r\n");
    }
    wire
}

fn stream(
    scenario: &Scenario,
    exchanges: &[RecordedExchange],
    scenario_checks: &mut ScenarioChecks,
) {
    let packets = packets(exchanges);
    let some = !packets.is_empty();
    let expected = "Write 0x120101, 0x90 at port 553";
    scenario_checks.check(STM_1, some, exchanges.last(), expected, "none");
    let mut arrived = Vec::new();
    let mut rejected_packet: Option<&[u8]> = None;
    for &(exchange, packet) in &packets {
        let exchange = Some(exchange);
        let len = packet.len();
        scenario_checks.check(STM_2, len <= PACKET_MAX, exchange, "at most 992 bytes", len);
        let ended = packet.ends_with(b"\r\n");
        let bare = packet.windows(2).any(|pair| matches!(pair, [first, b'\n'] if *first != b'\r'))
            || packet.first() == Some(&b'\n');
        scenario_checks.check(
            STM_4,
            ended && !bare,
            exchange,
            "whole lines, each ended by CR LF",
            if ended { "a line that ends with LF only" } else { "no CR LF at the end" },
        );
        let text = packet.iter().all(|&byte| byte.is_ascii() && byte != 0);
        scenario_checks.check(STM_7, text, exchange, "ASCII characters only", "other bytes");
        if let Some(rejected_packet) = rejected_packet {
            let expected = "the same packet again, because it was rejected as busy";
            scenario_checks.check(STM_6, packet == rejected_packet, exchange, expected, "another");
        }
        let accepted = exchange.and_then(result_of) == Some(0);
        rejected_packet = (!accepted).then_some(packet);
        if accepted {
            arrived.extend(packet);
        }
    }
    let expected = on_the_wire(scenario.program.as_deref().unwrap_or_default());
    let passed = arrived == expected;
    let found = || {
        if arrived.len() == expected.len() {
            "the same number of bytes, but other bytes or another order".to_owned()
        } else {
            format!("{} of it", plural(arrived.len(), "byte"))
        }
    };
    let last = packets.last().map(|(exchange, _)| *exchange);
    let what = || format!("all lines of the program in order, {}", plural(expected.len(), "byte"));
    scenario_checks.check(STM_15, passed, last, what, found);
    if rejected_packet.is_some() || !scenario.rejections.is_empty() {
        scenario_checks.check(STM_6, rejected_packet.is_none() && passed, last, what, found);
    }
    let lines = on_the_wire(&arrived);
    let longest = lines.split(|&byte| byte == b'\n').map(<[u8]>::len).max().unwrap_or(0);
    scenario_checks.check(
        STM_20,
        longest < PACKET_MAX,
        last,
        "lines of at most 990 characters",
        longest,
    );
}

/// A read or write of a variable of the Service Interface; `value` is `None` for a read.
struct ServiceVariableAccess<'t> {
    exchange: &'t RecordedExchange,
    variable: ServiceVariable,
    value: Option<Vec<u8>>,
}

fn accesses<'t>(
    script: &ScenarioScript,
    exchanges: &'t [RecordedExchange],
) -> Vec<ServiceVariableAccess<'t>> {
    let access = |exchange: &'t RecordedExchange| {
        with_request(exchange, |request: &Request<'_>| {
            let (variable, value) = script.service_variable(request)?;
            Some(ServiceVariableAccess { exchange, variable, value: value.map(<[u8]>::to_vec) })
        })?
    };
    exchanges.iter().filter_map(access).collect()
}

fn is_set(access: &ServiceVariableAccess<'_>) -> bool {
    access.value.as_ref().is_some_and(|value| value.iter().any(|&byte| byte != 0))
}

fn host(
    script: &ScenarioScript,
    exchanges: &[RecordedExchange],
    scenario_checks: &mut ScenarioChecks,
) {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let all = accesses(script, exchanges);
    let written =
        |variable| all.iter().position(|one| one.variable == variable && one.value.is_some());
    let first_write = all.iter().position(|one| one.value.is_some()).unwrap_or(all.len());
    for (variable, what) in [
        (Uuid, "UUID read before the first write"),
        (RequestState, "REQUEST_STATE read before the first write"),
    ] {
        let read = all.iter().take(first_write).any(|one| one.variable == variable);
        let exchange = all.get(first_write).map(|one| one.exchange).or(exchanges.last());
        scenario_checks.check(SVC_2, read, exchange, what, "not read");
    }
    let read = all.iter().take(first_write).any(|one| one.variable == Request);
    scenario_checks.check(SVC_1, read, exchanges.last(), "REQUEST read", "not read");
    // A service may clear RESPONSE_STATE before it writes the response.
    let state = all.iter().position(|one| one.variable == ResponseState && is_set(one));
    let (response, state) = (written(Response), state.or_else(|| written(ResponseState)));
    let at = |place: Option<usize>| place.and_then(|place| all.get(place));
    let exchange = at(state).or(at(response)).map(|one| one.exchange).or(exchanges.last());
    let in_order = matches!((response, state), (Some(response), Some(state)) if response < state);
    let expected = "RESPONSE written before RESPONSE_STATE";
    let found = match (response, state) {
        (Some(_), Some(_)) => "RESPONSE_STATE first",
        (None, _) => "no RESPONSE",
        (_, None) => "no RESPONSE_STATE",
    };
    scenario_checks.check(SVC_5, in_order, exchange, expected, found);
    let set = at(state).is_some_and(is_set);
    scenario_checks.check(SVC_5, set, exchange, "a response state that is not 0", "0, or no value");
    if let Some(answer) = at(response) {
        let value = answer.value.as_deref().unwrap_or_default();
        let fits = value.len() <= 128;
        let len = value.len();
        scenario_checks.check(SVC_1, fits, Some(answer.exchange), "at most 128 bytes", len);
        let right = until_nul(value) == REQUEST.as_bytes();
        let found = || String::from_utf8_lossy(until_nul(value));
        scenario_checks.check(SVC_1, right, Some(answer.exchange), REQUEST, found);
    }
    if let Some(cleared) =
        all.iter().position(|one| one.variable == RequestState && one.value.is_some())
    {
        // A write of REQUEST_STATE after RESPONSE_STATE would cancel the response (SVC-3).
        let passed = state.is_none_or(|state| cleared < state);
        let expected = "no write of REQUEST_STATE after RESPONSE_STATE";
        scenario_checks.check(
            SVC_3_1,
            passed,
            at(Some(cleared)).map(|one| one.exchange),
            expected,
            "a write of REQUEST_STATE after RESPONSE_STATE",
        );
    }
}

fn caller(
    script: &ScenarioScript,
    exchanges: &[RecordedExchange],
    scenario_checks: &mut ScenarioChecks,
) {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let all = accesses(script, exchanges);
    let state_write = all.iter().position(|one| one.variable == RequestState && is_set(one));
    let exchange =
        state_write.and_then(|at| all.get(at)).map(|one| one.exchange).or(exchanges.last());
    let before = all.get(..state_write.unwrap_or(0)).unwrap_or_default();
    for variable in [Uuid, Request] {
        let passed = before.iter().any(|one| one.variable == variable && one.value.is_some());
        let expected = || format!("{variable:?} written before REQUEST_STATE");
        scenario_checks.check(
            SVC_12,
            passed,
            exchange,
            expected,
            "not written before REQUEST_STATE",
        );
    }
    let after = all.get(state_write.unwrap_or(all.len())..).unwrap_or_default();
    let read =
        |variable| after.iter().position(|one| one.variable == variable && one.value.is_none());
    let state_read = after
        .iter()
        .position(|one| one.variable == ResponseState && one.value.is_none() && saw(one.exchange));
    let passed = match (state_read, read(Response)) {
        (Some(state_read), Some(read)) => state_read < read,
        _ => false,
    };
    let expected = "RESPONSE read only after RESPONSE_STATE is not 0";
    let exchange = read(Response).and_then(|at| after.get(at)).map(|one| one.exchange).or(exchange);
    scenario_checks.check(SVC_6, passed, exchange, expected, "otherwise");
}

/// Whether the value of 4 bytes in a reply, which follows the result and the length, is not 0.
fn saw(exchange: &RecordedExchange) -> bool {
    exchange.sent.get(46..50).is_some_and(|state| state.iter().any(|&byte| byte != 0))
}

/// The text of the request in the scenarios of the Service Interface. A client that answers the
/// request must repeat it in its response.
pub(super) const REQUEST: &str = "some-command";

#[cfg(test)]
mod tests {
    use ads_cnc::address::Channel;
    use ads_cnc::ads::{AmsAddr, AmsHeader, AmsPort};
    use ads_cnc::operation::WriteByName;

    use super::*;
    use crate::client::frame;
    use crate::judge::Verdict;
    use crate::simulator::{Cnc, NET_ID};

    fn write(variable: ServiceVariable, value: &[u8]) -> RecordedExchange {
        let write = WriteByName::new(Channel::new(1).unwrap(), variable.name(), value).unwrap();
        let request = Request::from(write);
        let mut buf = vec![0; request.encoded_len()];
        let call = request.encode(&mut buf).unwrap();
        let [target, source] =
            [call.port, AmsPort(0x8000)].map(|port| AmsAddr { net_id: NET_ID, port });
        let header = AmsHeader::request(target, source, call.service.command(), 7);
        RecordedExchange { request: frame(header, &call).unwrap(), ..RecordedExchange::default() }
    }

    /// A service may clear RESPONSE_STATE before it writes the response, but not set it.
    #[test]
    fn only_a_set_response_state_must_follow_the_response() {
        let script = ScenarioScript::new(Cnc::with_default_model().unwrap());
        for (first, fails) in [(0, false), (1, true)] {
            let exchanges = [
                write(ServiceVariable::ResponseState, &[first, 0, 0, 0]),
                write(ServiceVariable::Response, REQUEST.as_bytes()),
                write(ServiceVariable::ResponseState, &[1, 0, 0, 0]),
            ];
            let mut checks = ScenarioChecks::default();
            host(&script, &exchanges, &mut checks);
            let mut failed =
                checks.record.judgements.iter().filter(|one| one.verdict == Verdict::Fail);
            assert_eq!(failed.any(|one| one.requirement == SVC_5.as_str()), fails);
        }
    }
}
