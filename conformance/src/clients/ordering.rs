//! The order of a client's requests: packets of an NC program, and the Service Interface.

use ads_cnc::operation::Request;
use ads_cnc::service::ServiceVariable;

use super::findings::Findings;
use super::request_match::result_of;
use super::requests::with_request;
use super::scenario::{Order, Scenario};
use super::script::ScenarioScript;
use super::test_server::Turn;
use crate::judge::assumed;
use crate::values::until_nul;

/// Maximum length of a packet, and of a line without its line end.
const PACKET_MAX: usize = 992;

/// Judges the order of the requests.
pub(super) fn judge(
    watch: Order,
    scenario: &Scenario,
    script: &ScenarioScript,
    turns: &[Turn],
    findings: &mut Findings,
) {
    match watch {
        Order::Stream => stream(scenario, turns, findings),
        Order::NoStream(rule) => {
            let sent = packets(turns).into_iter().next();
            let expected = "nothing of a program that cannot be streamed";
            let turn = sent.as_ref().map(|(turn, _)| *turn);
            let rule = if rule == "STM-8" { assumed(rule) } else { rule.into() };
            findings.check(rule, sent.is_none(), turn, expected, "a packet of it");
        }
        Order::Host => host(script, turns, findings),
        Order::IdleHost => {
            let written = accesses(script, turns).into_iter().find(|access| access.value.is_some());
            let turn = written.as_ref().map(|access| access.turn);
            let expected = "no answer to what is not its own, or is no request";
            findings.check("SVC-2", written.is_none(), turn, expected, "a write");
        }
        Order::Caller => caller(script, turns, findings),
    }
}

/// The writes to the streaming object of channel 1, identified without the codec.
fn packets(turns: &[Turn]) -> Vec<(&Turn, &[u8])> {
    let is_one = |frame: &[u8]| {
        let group = frame.get(38..42);
        let at = frame.get(42..46) == Some(&[0x90, 0, 0, 0]);
        let of_channel = group == Some(&[1, 1, 0x12, 0]) || group == Some(&[1, 1, 0x02, 0]);
        frame.get(22..24) == Some(&[3, 0]) && of_channel && at
    };
    let data = |turn: &'_ Turn| is_one(&turn.request).then_some(());
    turns
        .iter()
        .filter(|turn| data(turn).is_some())
        .map(|turn| (turn, turn.request.get(50..).unwrap_or_default()))
        .collect()
}

/// The program with CR LF after every line, as it must be sent.
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

fn stream(scenario: &Scenario, turns: &[Turn], findings: &mut Findings) {
    let packets = packets(turns);
    let some = !packets.is_empty();
    let expected = "Write 0x120101, 0x90 at port 553";
    findings.check("STM-1", some, turns.last(), expected, "none");
    let mut arrived = Vec::new();
    let mut refused: Option<&[u8]> = None;
    for &(turn, packet) in &packets {
        let turn = Some(turn);
        let len = packet.len();
        findings.check("STM-2", len <= PACKET_MAX, turn, "at most 992 bytes", len);
        let ended = packet.ends_with(b"\r\n");
        let bare = packet.windows(2).any(|pair| matches!(pair, [first, b'\n'] if *first != b'\r'))
            || packet.first() == Some(&b'\n');
        findings.check(
            "STM-4",
            ended && !bare,
            turn,
            "whole lines, each ended by CR LF",
            if ended { "a line ended by LF alone" } else { "a piece without CR LF at its end" },
        );
        let text = packet.iter().all(|&byte| byte.is_ascii() && byte != 0);
        findings.check("STM-7", text, turn, "ASCII characters and nothing else", "other bytes");
        if let Some(refused) = refused {
            let expected = "the same packet again, as it was refused for the time being";
            findings.check("STM-6", packet == refused, turn, expected, "another");
        }
        let accepted = turn.and_then(result_of) == Some(0);
        refused = (!accepted).then_some(packet);
        if accepted {
            arrived.extend(packet);
        }
    }
    let expected = on_the_wire(scenario.program.as_deref().unwrap_or_default());
    let kept = arrived == expected;
    let found = || {
        if arrived.len() == expected.len() {
            "as many bytes in another order, or others".to_owned()
        } else {
            format!("{} bytes of it", arrived.len())
        }
    };
    let last = packets.last().map(|(turn, _)| *turn);
    let what = || format!("the program line by line, {} bytes", expected.len());
    findings.check("STM-15", kept, last, what, found);
    if refused.is_some() || !scenario.refused.is_empty() {
        findings.check("STM-6", refused.is_none() && kept, last, what, found);
    }
    let lines = on_the_wire(&arrived);
    let longest = lines.split(|&byte| byte == b'\n').map(<[u8]>::len).max().unwrap_or(0);
    findings.check(
        "STM-20",
        longest < PACKET_MAX,
        last,
        "lines of at most 990 characters",
        longest,
    );
}

/// A read or write of a variable of the Service Interface.
struct ServiceVariableAccess<'t> {
    turn: &'t Turn,
    variable: ServiceVariable,
    value: Option<Vec<u8>>,
}

fn accesses<'t>(script: &ScenarioScript, turns: &'t [Turn]) -> Vec<ServiceVariableAccess<'t>> {
    let access = |turn: &'t Turn| {
        with_request(turn, |request: &Request<'_>| {
            let (variable, value) = script.service_variable(request)?;
            Some(ServiceVariableAccess { turn, variable, value: value.map(<[u8]>::to_vec) })
        })?
    };
    turns.iter().filter_map(access).collect()
}

fn is_set(access: &ServiceVariableAccess<'_>) -> bool {
    access.value.as_ref().is_some_and(|value| value.iter().any(|&byte| byte != 0))
}

fn host(script: &ScenarioScript, turns: &[Turn], findings: &mut Findings) {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let all = accesses(script, turns);
    let written =
        |variable| all.iter().position(|one| one.variable == variable && one.value.is_some());
    let first_write = all.iter().position(|one| one.value.is_some()).unwrap_or(all.len());
    for (variable, what) in [
        (Uuid, "UUID read before anything is written"),
        (RequestState, "REQUEST_STATE read before anything is written"),
    ] {
        let read = all.iter().take(first_write).any(|one| one.variable == variable);
        let turn = all.get(first_write).map(|one| one.turn).or(turns.last());
        findings.check("SVC-2", read, turn, what, "not read");
    }
    let read = all.iter().take(first_write).any(|one| one.variable == Request);
    findings.check("SVC-1", read, turns.last(), "REQUEST read", "not read");
    let (response, state) = (written(Response), written(ResponseState));
    let at = |place: Option<usize>| place.and_then(|place| all.get(place));
    let turn = at(state).or(at(response)).map(|one| one.turn).or(turns.last());
    let in_order = matches!((response, state), (Some(response), Some(state)) if response < state);
    let expected = "RESPONSE written, and then RESPONSE_STATE";
    let found = match (response, state) {
        (Some(_), Some(_)) => "RESPONSE_STATE first",
        (None, _) => "no RESPONSE",
        (_, None) => "no RESPONSE_STATE",
    };
    findings.check("SVC-5", in_order, turn, expected, found);
    let set = at(state).is_some_and(is_set);
    findings.check("SVC-5", set, turn, "a response state that is not 0", "0, or none");
    if let Some(answer) = at(response) {
        let value = answer.value.as_deref().unwrap_or_default();
        let fits = value.len() <= 128;
        let len = value.len();
        findings.check("SVC-1", fits, Some(answer.turn), "at most 128 bytes", len);
        let right = until_nul(value) == REQUEST.as_bytes();
        let found = || String::from_utf8_lossy(until_nul(value));
        findings.check("SVC-1", right, Some(answer.turn), REQUEST, found);
    }
    if let Some(cleared) =
        all.iter().position(|one| one.variable == RequestState && one.value.is_some())
    {
        // REQUEST_STATE = 0 after RESPONSE_STATE would cancel the answer (SVC-3).
        let kept = state.is_none_or(|state| cleared < state);
        let expected = "REQUEST_STATE written before RESPONSE_STATE, if at all";
        findings.check(
            "SVC-3.1",
            kept,
            at(Some(cleared)).map(|one| one.turn),
            expected,
            "after it",
        );
    }
}

fn caller(script: &ScenarioScript, turns: &[Turn], findings: &mut Findings) {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let all = accesses(script, turns);
    let asked = all.iter().position(|one| one.variable == RequestState && is_set(one));
    let turn = asked.and_then(|at| all.get(at)).map(|one| one.turn).or(turns.last());
    let before = all.get(..asked.unwrap_or(0)).unwrap_or_default();
    for variable in [Uuid, Request] {
        let kept = before.iter().any(|one| one.variable == variable && one.value.is_some());
        let expected = || format!("{variable:?} written before REQUEST_STATE");
        findings.check("SVC-12", kept, turn, expected, "not before it");
    }
    let after = all.get(asked.unwrap_or(all.len())..).unwrap_or_default();
    let read =
        |variable| after.iter().position(|one| one.variable == variable && one.value.is_none());
    let looked = after
        .iter()
        .position(|one| one.variable == ResponseState && one.value.is_none() && saw(one.turn));
    let kept = match (looked, read(Response)) {
        (Some(looked), Some(read)) => looked < read,
        _ => false,
    };
    let expected = "RESPONSE read when RESPONSE_STATE is not 0, and not before";
    let turn = read(Response).and_then(|at| after.get(at)).map(|one| one.turn).or(turn);
    findings.check("SVC-6", kept, turn, expected, "otherwise");
}

/// Whether a reply has a value other than 0 after result and length.
fn saw(turn: &Turn) -> bool {
    turn.sent.get(46..50).is_some_and(|state| state.iter().any(|&byte| byte != 0))
}

/// The request that the NC program sends and that the response must repeat.
pub(super) const REQUEST: &str = "some-command";
