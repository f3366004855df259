//! The values of the five variables of the Service Interface, and their limits.

use ads_cnc::ErrorKind::*;
use ads_cnc::service::ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
use ads_cnc::service::*;
use ads_cnc_conformance::simulator::program::service::*;

use super::channel::*;
use super::parts;

/// SVC-1: each text has at most 128 bytes including the NUL. The program, the host and the interface
/// reject longer texts without a write.
#[test]
fn texts_have_128_bytes() {
    let wait = SysServiceWait::default();
    for letter in ["a", "ä"] {
        let (fits, over) = (letter.repeat(127), letter.repeat(128));
        let too_long = |field| (TooLong, field, 0, 128, 129);

        // The program accepts requests of 127 and 128 bytes including the NUL, but not of 129 bytes.
        let shorter = &letter.repeat(126);
        assert!(ServiceCall::new(id(ROOT), text(shorter), wait).is_ok());
        let mut program = ServiceCall::new(id(ROOT), text(&fits), wait).unwrap();
        let error = ServiceCall::new(id(ROOT), text(&over), wait).unwrap_err();
        let CallError::Text(error) = error else { panic!("{error}") };
        assert_eq!(parts(error), too_long("request"));

        // The longest request reaches the service, and the longest response reaches the program.
        let mut channel = Channel::default();
        assert_eq!(channel.run(&mut program, millis(0)), None);
        let ids = [id(ROOT)];
        let mut host = Host::new(&ids);
        assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
        let before = channel.interface.clone();
        let error = host.answer(text(&over), 1).unwrap_err();
        assert_eq!(parts(error), too_long("response"));
        let HostStep::Serve { request, .. } = host.step() else { panic!("{:?}", host.step()) };
        assert_eq!((request, &channel.interface), (text(&fits), &before));
        host.answer(text(&fits), 1).unwrap();
        channel.rest(&mut host);
        assert_eq!(channel.run(&mut program, millis(0)), Some(Ok((1, fits.clone()))));
        assert_eq!(channel.interface.read(Response).len(), 128);

        // The interface accepts texts of 128 bytes including the NUL, and ignores bytes after the NUL.
        let (fits, over) = (vec![b'x'; 127], vec![b'x'; 128]);
        for (variable, field) in [(Uuid, "uuid"), (Request, "request"), (Response, "response")] {
            let mut interface = ServiceInterface::new();
            interface.write(variable, &[&fits[..], b"\0behind"].concat()).unwrap();
            assert_eq!(interface.read(variable), [&fits[..], b"\0"].concat());
            let before = interface.clone();
            for long in [over.clone(), [&over[..], b"\0"].concat()] {
                let error = interface.write(variable, &long).unwrap_err();
                assert_eq!(parts(error), too_long(field));
            }
            assert_eq!(interface, before);
        }
    }
}

/// The host rejects a request that is longer than its variable, and serves the next request.
#[test]
fn a_too_long_request_is_rejected() {
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.ask(ROOT, "3");
    let reach = |channel: &mut Channel, host: &mut Host<'_>| {
        while host.step() != HostStep::Read(Request) {
            channel.step(host);
        }
    };
    reach(&mut channel, &mut host);
    let error = host.read(&[b'3'; 128]).unwrap_err();
    assert_eq!(parts(error), (TooLong, "request", 0, 128, 129));
    assert_eq!(host.step(), HostStep::Wait);
    host.poll();
    reach(&mut channel, &mut host);
    // NULs after the text are padding, and do not count towards its length.
    host.read(&[&b"3\0"[..], &[0; 300]].concat()).unwrap();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    let HostStep::Serve { request, .. } = host.step() else { unreachable!() };
    assert_eq!(request, "3");
    // When the response is ready, another request (which is too long) has replaced the served one:
    // the host drops the response.
    host.answer(text("x"), 1).unwrap();
    reach(&mut channel, &mut host);
    host.read(&[b'3'; 128]).unwrap();
    assert_eq!((host.step(), host.outcome()), (HostStep::Wait, Some(Outcome::Abandoned)));
}

/// SVC-5, E-35: the host rejects a response state of 0, and then accepts another response to the same
/// request.
#[test]
fn a_response_state_of_0_is_rejected() {
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.ask(ROOT, "3");
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    let error = host.answer(text("x"), 0).unwrap_err();
    assert_eq!(parts(error), (OutOfRange, "response_state", 0, 1, 0));
    assert!(matches!(host.step(), HostStep::Serve { .. }));
    assert_eq!((host.outcome(), channel.written.len()), (None, 0));
    host.answer(text("x"), u32::MAX).unwrap();
    channel.rest(&mut host);
    assert_eq!(channel.interface.read(ResponseState), [0xFF; 4]);
}

/// A state that does not have exactly four bytes is an error.
#[test]
fn states_have_four_bytes() {
    let cut = |field| (Truncated, field, 0, 4, 3);
    let long = |field| (Trailing, field, 4, 4, 5);
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    assert_eq!(parts(host.read(&[1; 3]).unwrap_err()), cut("request_state"));
    assert_eq!(host.step(), HostStep::Wait);
    host.poll();
    assert_eq!(parts(host.read(&[0; 5]).unwrap_err()), long("request_state"));

    // If a state is invalid while a response is ready, the host reads the state again.
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    host.poll();
    assert_eq!(channel.skip_reads(&mut host), HostEvent::Serve);
    host.answer(text("x"), 1).unwrap();
    assert_eq!(host.read(&[]).unwrap_err().kind(), Truncated);
    assert_eq!(host.step(), HostStep::Read(RequestState));
    channel.rest(&mut host);
    assert_eq!(host.outcome(), Some(Outcome::Answered));

    let mut waiting = SysServiceWait::default().start(millis(0));
    assert_eq!(parts(waiting.read(&[1; 3], millis(0)).unwrap_err()), cut("response_state"));
    assert_eq!(waiting.step(), WaitStep::Read(ResponseState));

    let mut interface = ServiceInterface::new();
    interface.write(RequestState, &[2, 0, 0, 0]).unwrap();
    let before = interface.clone();
    for (variable, field) in [(RequestState, "request_state"), (ResponseState, "response_state")] {
        let rejected = interface.write(variable, &[0; 3]).unwrap_err();
        assert_eq!(parts(rejected), cut(field));
        let rejected = interface.write(variable, &[0; 5]).unwrap_err();
        assert_eq!(parts(rejected), long(field));
    }
    assert_eq!(interface, before);
}
