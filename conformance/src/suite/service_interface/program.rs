//! An NC program that sends a request, run directly, and the effects over ADS.

use std::time::{Duration, Instant};

use ads_cnc::CncStr;
use ads_cnc::address::Channel;
use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::interface::{NONE, read_variable, within, write_variable};
use crate::judge::{Checks as _, Step, Stop};
use crate::simulator::program::{Repeat, Script, ScriptConfig, ScriptState, ServiceOutcome};
use crate::suite::kit::Probe;
use crate::values::until_nul;

/// Reads the variables after each step of a program.
pub(super) fn asks_last(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, Uuid};
    within(probe, |probe, channel, cnc| {
        let config = ScriptConfig::square_root()?;
        let asked = config.requests.first().cloned();
        let asked = asked.ok_or_else(|| Stop::Harness("no request".to_owned()))?;
        let mut script = cnc.as_run(Script::new(config)?);
        // Values of an earlier request.
        for (variable, value) in [(Uuid, &b"other\0"[..]), (Request, b"other\0")] {
            let done = cnc.with_service(channel.number(), |one| one.write(variable, value));
            done??;
        }
        while script.state() == ScriptState::Asking(0) {
            let stepped =
                cnc.with_service(channel.number(), |service| script.step(Duration::ZERO, service));
            stepped?;
            let state = read_variable(probe, channel, RequestState)?;
            let (uuid, request) =
                (read_variable(probe, channel, Uuid)?, read_variable(probe, channel, Request)?);
            let own = CncStr::from_bytes(until_nul(&uuid)).and_then(ServiceId::from_text);
            let same = until_nul(&request) == asked.text.as_bytes() && own == Ok(asked.uuid);
            let found =
                || format!("state {}, {} of {}", Hex(state.clone()), Hex(request), Hex(uuid));
            let expected = "no request before it is all there";
            probe.check(SVC_12, same || state == NONE, expected, found);
        }
        Ok(())
    })
}

/// Time limit for program and service.
const SERVICE_TIMEOUT: Duration = Duration::from_secs(1);

pub(super) fn square_root(probe: &mut Probe<'_>) -> Step {
    within(probe, |probe, channel, cnc| {
        let config = ScriptConfig::square_root()?;
        let ids: Vec<_> = config.requests.iter().map(|request| request.uuid).collect();
        let (repeat, pause) = (Repeat::Times(1), Duration::ZERO);
        let cycle = Duration::from_micros(100);
        let script = Script::new(ScriptConfig { repeat, pause, cycle, ..config });
        cnc.set_script(channel.number(), Some(script?))?;
        let state = || cnc.with_script(channel.number(), |script| script.map(|one| one.state()));
        let begun = Instant::now();
        let mut host = Host::new(&ids);
        while state()? != Some(ScriptState::Finished) {
            if begun.elapsed() > SERVICE_TIMEOUT {
                probe.check(SVC_6, false, "a program with its answers", "one that waits on");
                return Ok(());
            }
            serve(probe, channel, &mut host)?;
        }
        let answers = cnc.with_script(channel.number(), |script| {
            let answers =
                script.into_iter().flat_map(|script| script.answers().cloned().collect::<Vec<_>>());
            answers.map(|answer| answer.outcome).collect::<Vec<_>>()
        });
        let expected = vec![
            ServiceOutcome::Response { state: 1, text: "1.732051".parse()? },
            ServiceOutcome::Response { state: 99, text: NEGATIVE.parse()? },
        ];
        let found = answers?;
        probe.check(
            [SVC_6, SVC_8, SVC_9],
            found == expected,
            || format!("{expected:?}"),
            || format!("{found:?}"),
        );
        let read = read_variable(probe, channel, ServiceVariable::RequestState)?;
        probe.check(SVC_4, read == NONE, "no request any more", || Hex(read));
        Ok(())
    })
}

const NEGATIVE: &str = "ERROR: cannot calc square root of negative number -3.000000";

/// Executes one step of the service.
fn serve(probe: &mut Probe<'_>, channel: Channel, host: &mut Host<'_>) -> Step {
    match host.step() {
        HostStep::Read(variable) => {
            let value = read_variable(probe, channel, variable)?;
            let read = host.read(&value);
            probe.check(SVC_6, read.is_ok(), "a value that fits", || Hex(value));
            if read.is_err() {
                return Err(Stop::Judged);
            }
        }
        HostStep::Write(variable, value) => {
            let value = value.to_vec();
            let taken = write_variable(probe, channel, variable, &value)?;
            probe.check(SVC_6, taken, "the answer taken", "an error");
            host.written();
        }
        HostStep::Serve { request, request_state, .. } => {
            // UUID and request were written before the state.
            let (request, known) = (request.to_string(), ["3", "-3"]);
            let whole = known.contains(&request.as_str()) && request_state == 1;
            let found = || format!("{request:?}, state {request_state}");
            probe.check(SVC_12, whole, "3 or -3, with state 1", found);
            let (answer, state) = if request == "3" { ("1.732051", 1) } else { (NEGATIVE, 99) };
            host.answer(CncStr::new(answer)?, state)?;
        }
        _ => host.poll(),
    }
    Ok(())
}
