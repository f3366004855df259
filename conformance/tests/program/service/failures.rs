//! Failed steps of hosts, late responses, calls in the wrong order, resets and restarts.

use ads_cnc::service::ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
use ads_cnc::service::*;
use ads_cnc_conformance::simulator::program::service::*;

use super::channel::*;
use crate::square_root::square_root;

/// A failed write may have reached the CNC, so the host reads the variables before it writes again.
/// It repeats a failed write of RESPONSE in any case, and any other write only if the variable does
/// not have the new value.
#[test]
fn failed_writes_are_completed() {
    let ids = [id(ROOT)];
    for variable in [Response, RequestState, ResponseState] {
        for arrives in [false, true] {
            let mut channel = Channel::default();
            let mut program = call(ROOT, "3", [None; 3]);
            assert_eq!(channel.run(&mut program, millis(0)), None);
            channel.written.clear();
            let mut host = Host::new(&ids);
            assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
            host.answer(text("x"), 1).unwrap();
            channel.reach(&mut host, variable);
            let HostStep::Write(_, value) = host.step() else { unreachable!() };
            if arrives {
                channel.write(variable, value);
            }
            host.failed();
            assert!(matches!(host.step(), HostStep::Read(_)), "{variable}: looks first");
            channel.rest(&mut host);
            assert_eq!(host.outcome(), Some(Outcome::Answered), "{variable}");
            let answer = Some(Ok((1, "x".to_string())));
            assert_eq!(channel.run(&mut program, millis(1)), answer);
            // If the failed write arrived, the host writes only RESPONSE again, which is harmless.
            let times = channel.written.iter().filter(|(one, _)| *one == variable).count();
            assert_eq!(times, if arrives && variable == Response { 2 } else { 1 }, "{variable}");
        }
    }
}

/// RESPONSE_STATE reached the CNC although its write failed, and the program has sent another request:
/// the host serves this request, and does not answer it with the previous response.
#[test]
fn a_failed_write_does_not_answer_the_next_request() {
    let ids = [id(ROOT)];
    let mut channel = Channel::default();
    let mut program = call(ROOT, "3", [None; 3]);
    channel.run(&mut program, millis(0));
    let mut host = Host::new(&ids);
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    host.answer(text("first"), 1).unwrap();
    channel.reach(&mut host, ResponseState);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    assert_eq!(channel.run(&mut program, millis(1)), Some(Ok((1, "first".to_string()))));
    let mut program = call(ROOT, "3", [None; 3]);
    channel.run(&mut program, millis(2));
    host.failed();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
    assert_eq!(channel.run(&mut program, millis(3)), None);
    assert!(channel.serve(&mut host, |_| ("second".to_string(), 1)));
    assert_eq!(channel.run(&mut program, millis(4)), Some(Ok((1, "second".to_string()))));
}

/// The write of RESPONSE_STATE failed, and the variables now contain a request to, or a response of,
/// another service: the host writes nothing.
#[test]
fn a_failed_write_is_not_repeated_over_another_service() {
    let ids = [id(ROOT)];
    // First another service has responded; then another service has a request without a response.
    for (response_state, uuid) in [(2, ROOT), (0, COMMAND)] {
        let mut channel = Channel::default();
        channel.ask(ROOT, "3");
        let mut host = Host::new(&ids);
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
        host.answer(text("x"), 1).unwrap();
        channel.reach(&mut host, ResponseState);
        host.failed();
        channel.interface.write(Uuid, uuid.as_bytes()).unwrap();
        channel.interface.write(ResponseState, &[response_state, 0, 0, 0]).unwrap();
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
        assert_eq!(host.outcome(), Some(Outcome::Abandoned));
        assert_eq!(channel.interface.read(ResponseState), [response_state, 0, 0, 0]);
    }
}

/// The documented limit of [`Host`] with two hosts on one channel: a RESPONSE_STATE that reached the CNC
/// although its write failed is written again, and the program takes it for the response to its next
/// request.
#[test]
fn two_hosts_may_end_an_unserved_request() {
    let (own, others) = ([id(ROOT)], [id(COMMAND)]);
    let (mut host, mut other) = (Host::new(&own), Host::new(&others));
    let mut channel = Channel::default();
    let mut program = call(ROOT, "3", [None; 3]);
    channel.run(&mut program, millis(0));
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    host.answer(text("first"), 1).unwrap();
    channel.reach(&mut host, ResponseState);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    host.failed();
    assert_eq!(channel.run(&mut program, millis(1)), Some(Ok((1, "first".to_string()))));

    let mut program = call(COMMAND, "3", [None; 3]);
    channel.run(&mut program, millis(2));
    assert_eq!(channel.skip_reads(&mut other), HostEvent::Serve);
    other.answer(text("other"), 1).unwrap();
    channel.reach(&mut other, ResponseState);
    for variable in [ResponseState, RequestState] {
        assert_eq!(channel.step(&mut host), HostEvent::Read(variable));
    }
    assert_eq!(channel.step(&mut other), HostEvent::Write(ResponseState));
    assert_eq!(channel.run(&mut program, millis(3)), Some(Ok((1, "other".to_string()))));

    let mut program = call(ROOT, "4", [None; 3]);
    let CallStep::Write(Uuid, value) = program.step() else { unreachable!() };
    channel.write(Uuid, value);
    program.written(millis(4));
    assert_eq!(channel.step(&mut host), HostEvent::Read(Uuid));
    assert_eq!(channel.run(&mut program, millis(5)), None);
    assert_eq!(channel.step(&mut host), HostEvent::Write(ResponseState));
    assert_eq!(channel.run(&mut program, millis(6)), Some(Ok((1, "other".to_string()))));
}

/// A failed step that is not a write, and calls in the wrong order, have no effect.
#[test]
fn calls_in_the_wrong_order_do_nothing() {
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    host.failed();
    host.written();
    host.poll();
    host.answer(text("x"), 1).unwrap();
    assert_eq!((host.step(), host.outcome()), (HostStep::Read(RequestState), None));
    host.read(&[0; 4]).unwrap();
    host.failed();
    host.read(b"no state").unwrap();
    host.answer(text("x"), 1).unwrap();
    assert_eq!(host.step(), HostStep::Wait);

    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    host.poll();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    host.failed();
    host.written();
    host.poll();
    host.read(&[0; 4]).unwrap();
    assert!(matches!(host.step(), HostStep::Serve { .. }));

    let mut program = call(ROOT, "3", [None; 3]);
    program.poll();
    program.read(b"", millis(0)).unwrap();
    assert!(matches!(program.step(), CallStep::Write(Uuid, _)));
    assert_eq!(channel.run(&mut program, millis(0)), None);
    program.written(millis(0));
    program.read(&[9, 0, 0, 0], millis(0)).unwrap();
    assert_eq!(program.step(), CallStep::Wait { until: None });
    program.poll();
    program.poll();
    assert_eq!(program.step(), CallStep::Read(ResponseState));
}

/// The program has timed out and sent another request, to the same or another service: the host drops
/// the late response, and writes no part of it.
#[test]
fn a_late_response_is_dropped() {
    let ids = [id(ROOT)];
    for (uuid, request, ours) in [(ROOT, "4", true), (COMMAND, "3", false)] {
        let mut channel = Channel::default();
        channel.ask(ROOT, "3");
        let mut host = Host::new(&ids);
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
        channel.ask(uuid, request);
        host.answer(text("late"), 1).unwrap();
        assert_eq!(host.outcome(), None);
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
        assert_eq!(host.outcome(), Some(Outcome::Abandoned));
        assert_eq!((channel.written.len(), channel.interface.read(Response)), (0, &b"\0"[..]));
        assert_eq!(channel.serve(&mut host, |_| ("x".to_string(), 1)), ours);
        let last = if ours { Outcome::Answered } else { Outcome::Abandoned };
        assert_eq!(host.outcome(), Some(last));
        // When the next response begins, the outcome of the previous response is discarded.
        channel.ask(ROOT, "5");
        host.poll();
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
        host.answer(text("x"), 1).unwrap();
        assert_eq!(host.outcome(), None);
    }
    // A request with the same text, but another request state, is another request.
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    let mut host = Host::new(&ids);
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    channel.interface.write(RequestState, &[2, 0, 0, 0]).unwrap();
    host.answer(text("late"), 1).unwrap();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
    assert_eq!((host.outcome(), channel.written.len()), (Some(Outcome::Abandoned), 0));
}

/// SVC-2: between two reads of a host, the program ends its request to another service and begins the
/// next request. The host does not serve this request until it has read all its variables again.
#[test]
fn a_request_is_read_twice() {
    let ids = [id(COMMAND)];
    let mut host = Host::new(&ids);
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    assert_eq!(channel.step(&mut host), HostEvent::Read(RequestState));
    channel.write(RequestState, &[0; 4]);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    channel.write(Uuid, format!("{COMMAND}\0").as_bytes());
    assert_eq!(channel.step(&mut host), HostEvent::Read(Uuid));
    assert_eq!(channel.step(&mut host), HostEvent::Read(Request));
    channel.write(Request, b"some-command\0");
    channel.write(RequestState, &[1, 0, 0, 0]);
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
    assert_eq!(host.outcome(), None);
    host.poll();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    let HostStep::Serve { request, .. } = host.step() else { unreachable!() };
    assert_eq!(request, "some-command");
}

/// The CNC is reset after any step of a host: the host continues, and the next program receives the
/// response to its own request.
#[test]
fn a_reset_during_a_response() {
    let ids = [id(ROOT)];
    for steps in 0..24 {
        for told in [false, true] {
            let mut channel = Channel::default();
            channel.ask(ROOT, "3");
            let mut host = Host::new(&ids);
            for _ in 0..steps {
                if channel.step(&mut host) == HostEvent::Serve {
                    host.answer(text("old"), 99).unwrap();
                }
            }
            channel.interface.reset();
            if told {
                host.restart();
                assert_eq!(host.step(), HostStep::Read(RequestState));
            }
            // Executes steps up to the next wait. A host that was not told of the reset may complete
            // the response that it had begun.
            while channel.skip_reads(&mut host) != HostEvent::Wait {
                if channel.step(&mut host) == HostEvent::Serve {
                    host.answer(text("old"), 99).unwrap();
                }
            }
            let mut program = call(ROOT, "3", [None; 3]);
            assert_eq!(channel.run(&mut program, millis(0)), None);
            assert!(channel.serve(&mut host, square_root), "{steps}");
            let answer = Some(Ok((1, "1.732051".to_string())));
            assert_eq!(channel.run(&mut program, millis(1)), answer, "{steps}");
        }
    }
}

/// A request that was served, but whose response was not written, is served again after a restart of
/// the host.
#[test]
fn a_restarted_host_serves_again() {
    let ids = [id(ROOT)];
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    let mut host = Host::new(&ids);
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    host.answer(text("x"), 1).unwrap();
    host.restart();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    assert_eq!((host.outcome(), channel.written.len()), (None, 0));
}
