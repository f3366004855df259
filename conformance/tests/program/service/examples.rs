//! The examples of the manuals, and the requests that each service serves.

use std::time::Duration;

use ads_cnc::ErrorKind::*;
use ads_cnc::service::ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
use ads_cnc::service::*;
use ads_cnc_conformance::simulator::program::service::*;

use super::channel::*;
use super::parts;
use crate::square_root::square_root;

/// SVC-9: the responses to requests for the square root of 3 and of a negative number, and the order of
/// all writes (SVC-4, SVC-5), whether or not the interface itself clears REQUEST_STATE.
#[test]
fn square_root_example() {
    for (request, response, state) in [
        ("3", "1.732051", 1),
        ("-3", "ERROR: cannot calc square root of negative number -3.000000", 99),
    ] {
        for clears in [Clears::OnResponseState, Clears::Never] {
            let mut channel = Channel::with(clears);
            let ids = [id(ROOT)];
            let mut host = Host::new(&ids);
            assert!(!channel.serve(&mut host, square_root));

            let mut program = call(ROOT, request, [None; 3]);
            assert_eq!(channel.run(&mut program, millis(0)), None);
            assert!(channel.serve(&mut host, square_root));
            assert_eq!(host.outcome(), Some(Outcome::Answered));
            let answer = Some(Ok((state, response.to_string())));
            assert_eq!(channel.run(&mut program, millis(10)), answer);

            let zero_ended = |text: &str| format!("{text}\0").into_bytes();
            assert_eq!(
                channel.written,
                [
                    (Uuid, zero_ended(ROOT)),
                    (Request, zero_ended(request)),
                    (RequestState, vec![1, 0, 0, 0]),
                    (Response, zero_ended(response)),
                    (RequestState, vec![0, 0, 0, 0]),
                    (ResponseState, state.to_le_bytes().to_vec()),
                ]
            );
            // The host serves the request only once.
            assert!(!channel.serve(&mut host, square_root));
        }
    }
}

/// E-21: the UUID in the NC program of the example lacks a digit, so no service is selected.
#[test]
fn the_printed_uuid_without_a_digit_selects_no_service() {
    const SHORT: &str = "560AACBF-6335-44a9-895A-B27F3ED5E47";
    assert_eq!(parts(ServiceId::new(SHORT).unwrap_err()), (Truncated, "uuid", 0, 36, 35));
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.ask(SHORT, "3");
    assert!(!channel.serve(&mut host, square_root));
    channel.ask(ROOT, "3");
    assert!(channel.serve(&mut host, square_root));
}

/// SVC-8: the manual's example of the cycle SYS_SERVICE_WAIT, which waits for at most 5 seconds.
#[test]
fn sys_service_wait_example() {
    let program = || call(COMMAND, "some-command", [None, Some(5000), Some(1)]);
    let ids = [id(COMMAND)];
    let service = |request: &str| (format!("did {request}"), 7);
    let answer = Some(Ok((7, "did some-command".to_string())));
    let start = millis(1_000_000);

    // The response is in time. A response that only the last read finds is in time, too.
    for (answered, looked) in [(1, 2), (4999, 5000), (5000, 5000), (5000, 9000)] {
        let (mut channel, mut program) = (Channel::default(), program());
        assert_eq!(channel.run(&mut program, start), None);
        assert_eq!(program.step(), CallStep::Wait { until: Some(start + millis(5000)) });
        assert_eq!(channel.run(&mut program, start + millis(answered - 1)), None);
        assert!(channel.serve(&mut Host::new(&ids), service));
        assert_eq!(channel.run(&mut program, start + millis(looked)), answer, "{looked}");
    }

    // The response is not in time: the program has timed out before.
    let (mut channel, mut program) = (Channel::default(), program());
    assert_eq!(channel.run(&mut program, start), None);
    assert_eq!(channel.run(&mut program, start + millis(4999)), None);
    assert_eq!(channel.run(&mut program, start + millis(5000)), Some(Err(())));
    assert!(channel.serve(&mut Host::new(&ids), service));
    assert_eq!(channel.run(&mut program, start + millis(5001)), Some(Err(())));
}

/// SVC-8: the parameters of the cycle and their default values.
#[test]
fn parameters_of_the_cycle() {
    let wait = SysServiceWait::from_parameters;
    assert_eq!(wait(None, None, None), Ok(SysServiceWait::default()));
    assert_eq!(wait(Some(0), None, Some(3)), Ok(SysServiceWait::default()));
    assert_eq!(
        wait(Some(4), Some(5000), Some(1)),
        Ok(SysServiceWait { keep_waiting: 4, longest: Some(Duration::from_secs(5)) })
    );
    for p1 in [None, Some(1)] {
        let error = wait(p1, Some(0), None).unwrap_err();
        assert_eq!(error.to_string(), "sys-service-wait: @P3 at offset 8: missing");
    }

    // With a maximum wait of 0, the program reads RESPONSE_STATE once. The end of the longest
    // possible wait does not overflow.
    let mut channel = Channel::default();
    let mut program = call(COMMAND, "", [None, Some(0), Some(1)]);
    assert_eq!(channel.run(&mut program, millis(9)), Some(Err(())));
    let longest = wait(None, Some(u32::MAX), Some(1)).unwrap();
    let waiting = longest.start(Duration::MAX - millis(1));
    assert_eq!(waiting.step(), WaitStep::Read(ResponseState));
    let mut waiting = longest.start(Duration::MAX - millis(1));
    waiting.read(&[0; 4], millis(2)).unwrap();
    assert_eq!(waiting.step(), WaitStep::Wait { until: Some(Duration::MAX) });
}

/// SVC-8 and SVC-3: the cycle waits while RESPONSE_STATE equals @P1. Because a request sets
/// RESPONSE_STATE to 0, a cycle with a @P1 other than 0 does not wait for the service, unless the
/// service has already set that state.
#[test]
fn a_keep_waiting_code_other_than_0() {
    let mut channel = Channel::default();
    channel.interface.write(ResponseState, &[5, 0, 0, 0]).unwrap();
    let mut program = call(ROOT, "3", [Some(5), None, None]);
    assert_eq!(channel.run(&mut program, millis(0)), Some(Ok((0, String::new()))));

    let wait = SysServiceWait::from_parameters(Some(5), None, None).unwrap();
    let mut waiting = wait.start(millis(0));
    waiting.read(&[5, 0, 0, 0], millis(0)).unwrap();
    assert_eq!(waiting.step(), WaitStep::Wait { until: None });
    waiting.poll();
    waiting.read(&[6, 0, 0, 0], millis(0)).unwrap();
    assert_eq!(waiting.step(), WaitStep::Done { state: 6 });
}

/// SVC-6, E-20: the program waits for RESPONSE_STATE; a write of RESPONSE alone does not end the wait.
#[test]
fn a_response_alone_does_not_end_the_wait() {
    let mut channel = Channel::default();
    let mut program = call(ROOT, "3", [None; 3]);
    assert_eq!(channel.run(&mut program, millis(0)), None);
    channel.write(Response, b"1.732051\0");
    assert_eq!(channel.run(&mut program, millis(1)), None);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    assert_eq!(channel.run(&mut program, millis(2)), Some(Ok((1, "1.732051".to_string()))));
}

/// SVC-2: while REQUEST_STATE is 0, no request is served. Any other value is a request, and the host
/// passes the value to the service.
#[test]
fn only_a_request_state_starts_a_service() {
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.write(Uuid, format!("{ROOT}\0").as_bytes());
    channel.write(Request, b"3\0");
    assert!(!channel.serve(&mut host, square_root));
    for state in [1_u32, 0x100, u32::MAX] {
        channel.write(RequestState, &state.to_le_bytes());
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
        host.poll();
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
        let HostStep::Serve { request_state, .. } = host.step() else { unreachable!() };
        assert_eq!(request_state, state);
        host.answer(text("x"), 1).unwrap();
        channel.rest(&mut host);
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Wait);
    }
    let zero =
        ServiceCall::with_state(id(ROOT), text("3"), 0, SysServiceWait::default()).unwrap_err();
    assert_eq!(zero, CallError::State);
}

/// SVC-2: two services on one channel, run by one host or by two hosts, each serve only their own
/// requests.
#[test]
fn two_services_on_one_channel() {
    let both = [id(ROOT), id(COMMAND)];
    let (root, command) = ([id(ROOT)], [id(COMMAND)]);
    let mut channel = Channel::default();
    let mut one = Host::new(&both);
    for (uuid, place) in [(COMMAND, 1), (ROOT, 0), (COMMAND, 1)] {
        channel.ask(uuid, "3");
        one.poll();
        assert_eq!(channel.skip_reads(&mut one), HostEvent::Serve);
        let HostStep::Serve { uuid, .. } = one.step() else { unreachable!() };
        assert!(std::ptr::eq(uuid, &both[place]));
        one.answer(text("x"), 1).unwrap();
        channel.rest(&mut one);
    }

    let (mut first, mut second) = (Host::new(&root), Host::new(&command));
    for uuid in [COMMAND, ROOT, COMMAND] {
        channel.ask(uuid, "3");
        let served = (
            channel.serve(&mut first, square_root),
            channel.serve(&mut second, |_| ("done".to_string(), 2)),
        );
        assert_eq!(served, (uuid == ROOT, uuid == COMMAND));
    }

    // A request with an unknown UUID is not served, nor does a host without services serve any.
    channel.ask("00000000-0000-0000-0000-000000000000", "3");
    assert!(!channel.serve(&mut first, square_root));
    channel.ask(ROOT, "3");
    assert!(!channel.serve(&mut Host::new(&[]), square_root));
    assert!(channel.serve(&mut first, square_root));
}
