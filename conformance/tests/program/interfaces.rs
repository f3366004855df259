//! Tests of the CNC's side of data streaming and of the Service Interface, each separately.

use std::time::Duration;

use ads_cnc::CncStr;
use ads_cnc::limits::{STREAM_MAX, STREAM_PACKET_MAX};
use ads_cnc::service::ServiceId;
use ads_cnc::service::ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
use ads_cnc::streaming::{Ack, LineErrorKind};
use ads_cnc_conformance::simulator::program::StreamingInterface;
use ads_cnc_conformance::simulator::program::service::{
    CallError, CallStep, Clears, ServiceCall, ServiceInterface, SysServiceWait,
};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::kept;
use crate::machines::{CheckedInterface, InterfaceMutation};

const TOO_LONG: &str =
    "service: response at offset 0: too long, expected at most 128 bytes, found 129";

fn id() -> ServiceId {
    ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47").unwrap()
}

fn program() -> ServiceCall {
    ServiceCall::new(id(), CncStr::new("3").unwrap(), SysServiceWait::default()).unwrap()
}

/// SVC-3: any write of REQUEST_STATE resets RESPONSE_STATE; writes of other variables do not.
#[test]
fn a_request_state_resets_the_response_state() {
    for clears in [Clears::OnResponseState, Clears::Never] {
        for state in [0, 1, 7_u32] {
            let mut interface = ServiceInterface::with(clears);
            interface.write(Response, b"r\0").unwrap();
            interface.write(ResponseState, &[9, 0, 0, 0]).unwrap();
            interface.write(Uuid, b"u\0").unwrap();
            interface.write(Request, b"q\0").unwrap();
            assert_eq!(interface.read(ResponseState), [9, 0, 0, 0]);
            interface.write(RequestState, &state.to_le_bytes()).unwrap();
            assert_eq!(interface.read(ResponseState), [0; 4]);
            assert_eq!(interface.read(RequestState), state.to_le_bytes());
            assert_eq!(interface.read(Response), b"r\0");
            interface.reset();
            assert_eq!(interface, ServiceInterface::with(clears));
        }
    }
}

/// SVC-4: the interface determines whether a write to RESPONSE_STATE sets REQUEST_STATE to 0.
#[test]
fn a_response_state_may_clear_the_request_state() {
    for (clears, left) in [(Clears::OnResponseState, 0), (Clears::Never, 3)] {
        let mut interface = ServiceInterface::with(clears);
        interface.write(RequestState, &[3, 0, 0, 0]).unwrap();
        interface.write(Response, b"r\0").unwrap();
        assert_eq!(interface.read(RequestState), [3, 0, 0, 0]);
        interface.write(ResponseState, &[1, 0, 0, 0]).unwrap();
        assert_eq!(interface.read(RequestState), [left, 0, 0, 0]);
        assert_eq!(interface.read(ResponseState), [1, 0, 0, 0]);
    }
}

/// For the program, a response that is longer than its variable is an error; the program then reads the
/// response again.
#[test]
fn a_too_long_response_is_rejected() {
    let mut program = program();
    (0..3).for_each(|_| program.written(Duration::ZERO));
    program.read(&[1, 0, 0, 0], Duration::ZERO).unwrap();
    let error = program.read(&[b'x'; 128], Duration::ZERO).unwrap_err();
    assert_eq!(error.to_string(), TOO_LONG);
    assert_eq!(program.step(), CallStep::Read(Response));
    program.read(b"x", Duration::ZERO).unwrap();
    assert_eq!(program.step(), CallStep::Done { state: 1, response: CncStr::new("x").unwrap() });
}

/// The driver that the manual of data streaming prints (`stream-en`, chapter 5) sends the last
/// line, and each line that does not fit into its buffer, without a line end. The interface detects
/// this error only when the CNC reads it.
#[test]
fn errors_of_the_printed_driver_are_detected_on_read() {
    let mut interface = StreamingInterface::new();
    assert_eq!(interface.write(b"N10 G0 X0\r\n"), Ack::Accepted);
    assert_eq!(interface.write(b"N20 M30"), Ack::Accepted);
    let error = interface.read().unwrap_err();
    assert_eq!(error.kind(), LineErrorKind::NoLineEnd);
    assert_eq!(error.to_string(), "line 2, column 8: CR LF expected, end of data found (STM-5)");
    assert_eq!((interface.len(), interface.read()), (0, Ok(&b""[..])));
    // The interface does not store the boundaries of writes: a line may be split into two writes if
    // the decoder reads both writes together.
    interface.write(b"N10 \r");
    interface.write(b"\nN20");
    interface.write(b" M30\r\n");
    assert_eq!(interface.read(), Ok(&b"N10 \r\nN20 M30\r\n"[..]));
    interface.write(b"N10\r\nN20\rN30\r\n");
    assert_eq!(
        interface.read().unwrap_err().to_string(),
        "line 2, column 4: CR LF expected, CR alone found (STM-5)"
    );
}

#[test]
fn the_interface_holds_4094_bytes() {
    let line = [b' '; STREAM_PACKET_MAX];
    let mut interface = StreamingInterface::new();
    for _ in 0..4 {
        assert_eq!(interface.write(&line), Ack::Accepted);
    }
    let room = STREAM_MAX - 4 * STREAM_PACKET_MAX;
    assert_eq!(interface.write(&line), Ack::Busy);
    assert_eq!(interface.write(&line[..room + 1]), Ack::Busy);
    assert_eq!(interface.write(&[b' '; STREAM_PACKET_MAX + 1]), Ack::Rejected);
    assert_eq!(interface.len(), STREAM_MAX - room, "a rejected write leaves nothing");
    assert_eq!(interface.write(&line[..room]), Ack::Accepted);
    assert_eq!((interface.write(b"X"), interface.write(b"")), (Ack::Busy, Ack::Rejected));
    interface.reset();
    assert!(interface.is_empty());
    assert_eq!((interface.write(&line), interface.len()), (Ack::Accepted, STREAM_PACKET_MAX));
}

/// The error messages have the same form as those of the codec.
#[test]
fn invalid_calls_are_rejected() {
    let wait = SysServiceWait::default();
    let zero = ServiceCall::with_state(id(), CncStr::EMPTY, 0, wait).unwrap_err();
    assert_eq!(
        zero.to_string(),
        "service: request_state at offset 0: expected at least 1, found 0"
    );
    let long = "x".repeat(128);
    let long = ServiceCall::new(id(), CncStr::new(&long).unwrap(), wait).unwrap_err();
    assert_eq!(long.to_string(), TOO_LONG.replace("response", "request"));
    let timer = SysServiceWait::from_parameters(None, Some(1), None).unwrap_err();
    assert_eq!(CallError::from(timer).to_string(), "sys-service-wait: @P3 at offset 8: missing");
}

proptest! {
    #![proptest_config(kept::cases(500, file!()))]

    /// Compares the interface with a vector of bytes.
    #[test]
    fn an_interface_is_a_bounded_queue(steps in vec((0..12_u8, 0..1100_usize, any::<u8>()), 0..60)) {
        let mut interface = CheckedInterface::new(InterfaceMutation::NONE);
        for (step, len, byte) in steps {
            match step {
                0 => interface.reset(),
                1 => drop(interface.read()),
                _ if step % 2 == 0 => {
                    interface.write(&[vec![byte; len], b"\r\n".to_vec()].concat());
                }
                _ => drop(interface.write(&vec![byte; len])),
            }
        }
    }
}
