//! Cases of the Service Interface: its variables, and what writing them leads to.

mod variables;

use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::edition::Feature;
use ads_cnc::operation::{HandleByName, ReadByName, WriteByName};
use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::{CncStr, VariableType};
use ads_cnc_vectors::Hex;

use crate::cnc::program::{Outcome, Repeat, Script, ScriptConfig, ScriptState};
use crate::profile::{Claim, Section};
use crate::suite::case::{Case, Rule, Step, Stop, assumed};
use crate::suite::declare;
use crate::suite::probe::{Probe, harness};
use crate::suite::stream::heard;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "service-variables",
            "A channel with the interface has its five variables, and in them what they hold",
            ["SVC-1", "SVC-11"],
            Queries,
            variables
        ),
        declare!(
            "service-response",
            "A service writes its response and its state, and a request's state takes it back",
            ["SVC-1", "SVC-3", "SVC-4"],
            Writes,
            response
        ),
        declare!(
            "service-longest",
            "REQUEST and RESPONSE hold 128 bytes, and no more",
            ["SVC-1"],
            Embedded,
            variables::longest
        ),
        declare!(
            "service-texts",
            "A text of any length and of any characters is read as it was written",
            ["SVC-1"],
            Embedded,
            variables::texts
        ),
        declare!(
            "service-variables-apart",
            "Each of the variables is its own, by name and by handle",
            ["SVC-1", "SVC-3"],
            Embedded,
            variables::apart
        ),
        declare!(
            "service-asked-by-a-program",
            "When a program writes REQUEST_STATE, the interface takes the last answer back",
            ["SVC-3", "SVC-4"],
            Embedded,
            asked
        ),
        declare!(
            "service-asks-last",
            "A program writes REQUEST_STATE when UUID and REQUEST are there, and not before",
            ["SVC-12"],
            Embedded,
            asks_last
        ),
        declare!(
            "service-square-root",
            "A program asks for square roots, waits, and has the answers of the service",
            ["SVC-4", "SVC-6", "SVC-8", "SVC-9", "SVC-12"],
            Embedded,
            square_root
        ),
    ]
}

/// The channels that have the interface: all, if it is claimed; else those that describe it, or
/// answer.
pub(super) fn channels(probe: &mut Probe<'_>) -> Step<Vec<Channel>> {
    let profile = &probe.session.profile;
    let lacks = |why: &str| Err(Stop::NotApplicable(why.to_owned()));
    if !profile.has_section(Section::Service) {
        return lacks("the profile does not claim the Service Interface");
    }
    match profile.has(Feature::ServiceInterface) {
        Claim::Yes => probe.channels(),
        Claim::No => lacks("the version has no Service Interface"),
        Claim::Open => {
            let mut there = Vec::new();
            for channel in probe.channels()? {
                let name = ServiceVariable::RequestState.name();
                let state = ReadByName::new(channel, name).map_err(harness)?;
                let described = probe.variables(channel).unwrap_or_default();
                let mut names = described.iter().map(|one| one.name.text.to_string());
                let described = names.any(|name| ServiceVariable::by_name(&name).is_some());
                if described || probe.try_ask(state)?.is_some() {
                    there.push(channel);
                }
            }
            match there.is_empty() {
                true => lacks("no channel has the Service Interface, which comes with a version"),
                false => Ok(there),
            }
        }
    }
}

fn variables(probe: &mut Probe<'_>) -> Step {
    let version = probe.session.profile.cnc_version;
    let since = version.map(|version| version.has(Feature::ServiceInterface));
    let of_version = since.filter(|answer| answer.yes).map(|answer| match answer.assumed {
        true => assumed("SVC-11"),
        false => "SVC-11".into(),
    });
    for channel in channels(probe)? {
        let described = probe.variables(channel)?;
        for variable in ServiceVariable::ALL {
            let name = variable.name();
            let mut rules: Vec<Rule> = vec!["SVC-1".into()];
            rules.extend(of_version);
            let request = ReadByName::new(channel, name).map_err(harness)?;
            let value = probe.ask_for(&rules, request)?;
            probe.ask_for(&rules, HandleByName::new(channel, name).map_err(harness)?)?;
            let found = format!("{} bytes of {name}", value.len());
            if variable.var_type() == VariableType::UNS32 {
                probe.check("SVC-1", value.len() == 4, "a state of 4 bytes", found);
            } else {
                let fits = !value.is_empty() && value.len() <= 128;
                probe.check("SVC-1", fits, "a text of at most 128 bytes", found);
            }
            let own = described.iter().find(|one| one.name.text.as_cnc_str() == name);
            let Some(own) = own else { continue };
            let found = format!("{:?} of {name}", own.var_type);
            let expected = format!("{:?}", variable.var_type());
            probe.check("SVC-1", own.var_type == variable.var_type(), expected, found);
        }
    }
    Ok(())
}

fn get(probe: &mut Probe<'_>, channel: Channel, variable: ServiceVariable) -> Step<Vec<u8>> {
    let request = ReadByName::new(channel, variable.name()).map_err(harness)?;
    let exchange = heard(probe.send(request)?)?;
    let value = exchange.answer().and_then(|answer| answer.success());
    Ok(value.unwrap_or_default().to_vec())
}

fn put(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: ServiceVariable,
    value: &[u8],
) -> Step<bool> {
    let request = WriteByName::new(channel, variable.name(), value).map_err(harness)?;
    let exchange = heard(probe.send(request)?)?;
    Ok(exchange.answer().is_some_and(|answer| answer.success().is_some()))
}

/// Up to the first NUL, which fills up what is longer.
fn text(value: &[u8]) -> &[u8] {
    value.split(|&byte| byte == 0).next().unwrap_or_default()
}

const ONE: [u8; 4] = [1, 0, 0, 0];
const NONE: [u8; 4] = [0; 4];
/// Each byte another.
const WIDE: [u8; 4] = [0x63, 0x12, 0x34, 0x56];

fn response(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{RequestState, Response, ResponseState};
    let may = |probe: &Probe<'_>, channel: Channel| -> Step<bool> {
        probe.may(WriteByName::new(channel, Response.name(), b"\0").map_err(harness)?)
    };
    let mut any = false;
    for channel in channels(probe)? {
        if !may(probe, channel)? {
            continue;
        }
        any = true;
        if get(probe, channel, RequestState)? != NONE {
            let why = "a program is asking a service: it is left alone".to_owned();
            return Err(Stop::Inconclusive(why));
        }
        let before = (get(probe, channel, Response)?, get(probe, channel, ResponseState)?);
        let tried = answer(probe, channel);
        put(probe, channel, Response, &before.0)?;
        put(probe, channel, ResponseState, &before.1)?;
        tried?;
        let after = (get(probe, channel, Response)?, get(probe, channel, ResponseState)?);
        let same = (text(&after.0), &after.1) == (text(&before.0), &before.1);
        probe.check("SVC-1", same, "the old response again", format!("{after:02x?}"));
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("no service may be answered for".to_owned())),
    }
}

/// As a service does, though nobody asked.
fn answer(probe: &mut Probe<'_>, channel: Channel) -> Step {
    use ServiceVariable::{RequestState, Response, ResponseState};
    let taken = put(probe, channel, Response, b"nobody asked\0")?;
    probe.check("SVC-1", taken, "a response taken", "an error");
    let read = get(probe, channel, Response)?;
    let same = text(&read) == b"nobody asked";
    probe.check("SVC-1", same, "the response as written", Hex(read));
    // Any number: it is between the program and the service.
    for state in [ONE, WIDE, [0, 0, 0, 0x80]] {
        let taken = put(probe, channel, ResponseState, &state)?;
        probe.check("SVC-1", taken, "a response state taken", "an error");
        let read = get(probe, channel, ResponseState)?;
        probe.check("SVC-1", read == state, Hex(state.to_vec()), Hex(read));
    }
    let read = get(probe, channel, RequestState)?;
    probe.check("SVC-4", read == NONE, "no request any more", Hex(read));
    // Any write of it does, over ADS too: assumed.
    put(probe, channel, RequestState, &NONE)?;
    let read = get(probe, channel, ResponseState)?;
    probe.check(assumed("SVC-3"), read == NONE, "the response state taken back", Hex(read));
    Ok(())
}

/// Uses the interface of the first channel that has one from both sides, and leaves it as at the
/// start.
fn within(
    probe: &mut Probe<'_>,
    then: impl FnOnce(&mut Probe<'_>, Channel, &crate::cnc::Cnc) -> Step,
) -> Step {
    let cnc = probe.cnc()?;
    let lacks = || Stop::NotApplicable("no channel has the Service Interface".to_owned());
    let channel = channels(probe)?.into_iter().next().ok_or_else(lacks)?;
    let number = channel.number();
    // What asks there of itself asks nothing meanwhile.
    let script = cnc.with_script(number, |script| script.cloned()).map_err(harness)?;
    let empty = || -> Step {
        cnc.set_script(number, None).map_err(harness)?;
        cnc.with_service(number, |service| service.reset()).map_err(harness)
    };
    empty()?;
    let done = then(probe, channel, &cnc);
    empty()?;
    cnc.set_script(number, script).map_err(harness)?;
    done
}

fn asked(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, Response, ResponseState};
    within(probe, |probe, channel, cnc| {
        let write = |variable, value: &[u8]| {
            let written =
                cnc.with_service(channel.number(), |service| service.write(variable, value));
            written.map_err(harness)?.map_err(harness)
        };
        write(Request, b"1\0")?;
        write(RequestState, &ONE)?;
        put(probe, channel, Response, b"one\0")?;
        let read = get(probe, channel, RequestState)?;
        let expected = "the request until it is answered";
        probe.check(assumed("SVC-4"), read == ONE, expected, Hex(read));
        put(probe, channel, ResponseState, &ONE)?;
        // When that is, is assumed; that it is, is not.
        let read = get(probe, channel, RequestState)?;
        probe.check(assumed("SVC-4"), read == NONE, "the request is over", Hex(read));
        write(RequestState, &[2, 0, 0, 0])?;
        let read = get(probe, channel, ResponseState)?;
        probe.check("SVC-3", read == NONE, "the last response state taken back", Hex(read));
        let read = get(probe, channel, RequestState)?;
        probe.check("SVC-3", read == [2, 0, 0, 0], "the new request", Hex(read));
        Ok(())
    })
}

/// Looks at the variables after each step of a program.
fn asks_last(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, Uuid};
    within(probe, |probe, channel, cnc| {
        let config = ScriptConfig::square_root().map_err(harness)?;
        let Some(asked) = config.requests.first().cloned() else {
            return Err(harness("no request"));
        };
        let mut script = cnc.as_run(Script::new(config).map_err(harness)?);
        // Remains of another request.
        for (variable, value) in [(Uuid, &b"other\0"[..]), (Request, b"other\0")] {
            let done = cnc.with_service(channel.number(), |one| one.write(variable, value));
            done.map_err(harness)?.map_err(harness)?;
        }
        while script.state() == ScriptState::Asking(0) {
            let stepped =
                cnc.with_service(channel.number(), |service| script.step(Duration::ZERO, service));
            stepped.map_err(harness)?;
            let state = get(probe, channel, RequestState)?;
            let (uuid, request) = (get(probe, channel, Uuid)?, get(probe, channel, Request)?);
            let own = CncStr::from_bytes(text(&uuid)).and_then(ServiceId::from_text);
            let same = text(&request) == asked.text.as_bytes() && own == Ok(asked.uuid);
            let found = format!("state {}, {} of {}", Hex(state.clone()), Hex(request), Hex(uuid));
            let expected = "no request before it is all there";
            probe.check("SVC-12", same || state == NONE, expected, found);
        }
        Ok(())
    })
}

/// How long the program and the service may take over it.
const PATIENCE: Duration = Duration::from_secs(1);

fn square_root(probe: &mut Probe<'_>) -> Step {
    within(probe, |probe, channel, cnc| {
        let config = ScriptConfig::square_root().map_err(harness)?;
        let ids: Vec<_> = config.requests.iter().map(|request| request.uuid).collect();
        let (repeat, pause) = (Repeat::Times(1), Duration::ZERO);
        let cycle = Duration::from_micros(100);
        let script = Script::new(ScriptConfig { repeat, pause, cycle, ..config });
        cnc.set_script(channel.number(), Some(script.map_err(harness)?)).map_err(harness)?;
        let state = || cnc.with_script(channel.number(), |script| script.map(|one| one.state()));
        let begun = Instant::now();
        let mut host = Host::new(&ids);
        while state().map_err(harness)? != Some(ScriptState::Finished) {
            if begun.elapsed() > PATIENCE {
                probe.check("SVC-6", false, "a program with its answers", "one that waits on");
                return Ok(());
            }
            serve(probe, channel, &mut host)?;
        }
        let answers = cnc.with_script(channel.number(), |script| {
            let answers =
                script.into_iter().flat_map(|script| script.answers().cloned().collect::<Vec<_>>());
            answers.map(|answer| answer.outcome).collect::<Vec<_>>()
        });
        let text = |text: &str| text.parse().map_err(harness);
        let expected = vec![
            Outcome::Response { state: 1, text: text("1.732051")? },
            Outcome::Response { state: 99, text: text(NEGATIVE)? },
        ];
        let found = answers.map_err(harness)?;
        for rule in ["SVC-6", "SVC-8", "SVC-9"] {
            probe.check(rule, found == expected, format!("{expected:?}"), format!("{found:?}"));
        }
        let read = get(probe, channel, ServiceVariable::RequestState)?;
        probe.check("SVC-4", read == NONE, "no request any more", Hex(read));
        Ok(())
    })
}

const NEGATIVE: &str = "ERROR: cannot calc square root of negative number -3.000000";

/// A step of the service.
fn serve(probe: &mut Probe<'_>, channel: Channel, host: &mut Host<'_>) -> Step {
    match host.step() {
        HostStep::Read(variable) => {
            let value = get(probe, channel, variable)?;
            let read = host.read(&value);
            probe.check("SVC-6", read.is_ok(), "a value that fits", Hex(value));
            if read.is_err() {
                return Err(Stop::Judged);
            }
        }
        HostStep::Write(variable, value) => {
            let value = value.to_vec();
            let taken = put(probe, channel, variable, &value)?;
            probe.check("SVC-6", taken, "the answer taken", "an error");
            host.written();
        }
        HostStep::Serve { request, request_state, .. } => {
            // With the state there are UUID and request: they were written before it.
            let (request, known) = (request.to_string(), ["3", "-3"]);
            let whole = known.contains(&request.as_str()) && request_state == 1;
            let found = format!("{request:?}, state {request_state}");
            probe.check("SVC-12", whole, "3 or -3, with state 1", found);
            let (answer, state) = if request == "3" { ("1.732051", 1) } else { (NEGATIVE, 99) };
            host.answer(CncStr::new(answer).map_err(harness)?, state).map_err(harness)?;
        }
        _ => host.poll(),
    }
    Ok(())
}
