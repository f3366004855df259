//! Sessions: typed requests, allowed writes, and errors with advice if a device does not reply.

use std::io::{Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::thread;
use std::time::{Duration, Instant};

use crate::common::Serve;
use ads_cnc::address::Channel;
use ads_cnc::ads::{AdsError, AdsState, AmsNetId};
use ads_cnc::operation::{
    CountObjects, DescribeByName, HandleByName, ReadByName, ReadDescriptors, Task, WriteByHandle,
    WriteByName, WriteObject,
};
use ads_cnc::{Descriptors, U32List};
use ads_cnc_conformance::client::Target;
use ads_cnc_conformance::exit::Exit;
use ads_cnc_conformance::gate::{Allowed, Gate};
use ads_cnc_conformance::net;
use ads_cnc_conformance::session::{Session, ToolError};
use ads_cnc_conformance::simulator::{Cnc, NET_ID};

fn channel() -> Channel {
    Channel::new(1).unwrap()
}

fn allowing(tables: &str) -> Gate {
    let file = format!("target = \"{NET_ID}\"\nexpires = 9999-12-31T23:59:59Z\n{tables}");
    Gate::queries().with_allowed(Some(Allowed::from_toml(&file).unwrap()))
}

fn simulated(gate: Gate) -> Session {
    Session::simulated(Cnc::with_default_model().unwrap(), gate).unwrap()
}

fn variable(name: &str) -> String {
    format!("[[variable]]\nchannel = 1\nname = \"{name}\"\n")
}

/// A writable variable of the default model.
const WRITABLE: &str = "V.E.test";

#[test]
fn only_allowed_values_are_written() {
    let mut session = simulated(allowing(&variable(WRITABLE)));
    let value = [7, 0, 0, 0];
    let write = |name| WriteByName::new(channel(), name, &value[..]).unwrap();
    session.call(&write("V.E.test[4]")).unwrap();
    let read = ReadByName::new(channel(), "V.E.test[4]").unwrap();
    assert_eq!(session.call(&read).unwrap().bytes, value);

    let error = session.call(&write("V.E.Testvar[4]")).unwrap_err();
    assert_eq!(error.exit(), Exit::NotPermitted);
    let text = error.to_string();
    assert!(text.contains("rejected for safety") && text.contains("V.E.Testvar[4]"), "{text}");
}

#[test]
fn a_handle_confirmed_for_an_allowed_name_is_written() {
    let mut session = simulated(allowing(&variable(WRITABLE)));
    let handle = session.call(&HandleByName::new(channel(), WRITABLE).unwrap()).unwrap();
    let other = session.call(&HandleByName::new(channel(), "V.E.Testvar").unwrap()).unwrap();
    let write =
        |handle| WriteByHandle::new(channel(), handle, U32List::from(&[4]), &[8, 0, 0, 0][..]);
    // A write by handle is allowed only after a description has confirmed the handle.
    assert!(matches!(session.call(&write(handle)), Err(ToolError::NotPermitted(_))));
    session.call(&DescribeByName::new(channel(), WRITABLE).unwrap()).unwrap();
    session.call(&write(handle)).unwrap();
    assert!(matches!(session.call(&write(other)), Err(ToolError::NotPermitted(_))));
}

#[test]
fn a_named_object_is_written_after_reading_its_list() {
    const NAME: &str = "mc_command_single_block_w";
    let mut session = simulated(allowing(&format!("[[object]]\nchannel = 1\nname = \"{NAME}\"\n")));
    let count = session.call(&CountObjects::new(channel())).unwrap().0;
    let list = ReadDescriptors::new(channel(), 1, count).unwrap();
    let objects: Descriptors =
        session.call(&list).unwrap().iter().map(|one| one.to_owned()).collect();
    let objects = objects.as_ref();
    let object = objects.iter().find(|object| object.name() == NAME).unwrap();
    let (group, offset) = (object.index_group(), object.index_offset());
    session.call(&WriteObject::new(group, offset, &[1][..]).unwrap()).unwrap();

    let mut session = simulated(allowing(&format!("[[object]]\nchannel = 1\nname = \"{NAME}\"\n")));
    let write = WriteObject::new(group, offset, &[1][..]).unwrap();
    assert!(matches!(session.call(&write), Err(ToolError::NotPermitted(_))));
}

#[test]
fn an_error_of_the_cnc_contains_its_meaning() {
    let mut session = simulated(Gate::queries());
    let read = ReadByName::new(channel(), "V.E.nothing_there").unwrap();
    let error = session.call(&read).unwrap_err();
    assert_eq!(error.ads_error(), Some(AdsError::SYMBOL_NOT_FOUND));
    assert_eq!(error.exit(), Exit::Failure);
    assert!(error.to_string().contains("no such name"), "{error}");
}

#[test]
fn a_dry_run_continues_after_writes_and_stops_at_queries() {
    let gate = allowing(&variable(WRITABLE));
    let nobody = Target::local(SocketAddr::from(([127, 0, 0, 1], 1)), NET_ID);
    let mut session = Session::dry(nobody, gate, |_| {}).unwrap();
    let write = |name| WriteByName::new(channel(), name, &[1][..]).unwrap();
    for _ in 0..3 {
        session.call(&write(WRITABLE)).unwrap();
    }
    assert!(matches!(session.call(&write("V.E.b")), Err(ToolError::NotPermitted(_))));
    let read = ReadByName::new(channel(), WRITABLE).unwrap();
    assert!(matches!(session.call(&read), Err(ToolError::NotSent)));
}

/// A target that handles its connections with this function.
fn device(with: fn(TcpStream)) -> Target {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let addr = listener.local_addr().unwrap();
    thread::spawn(move || listener.incoming().flatten().for_each(with));
    let net_id = AmsNetId([192, 0, 2, 7, 1, 1]);
    Target { timeout: Duration::from_millis(200), ..Target::local(addr, net_id) }
}

fn ask(target: Target) -> (Exit, String) {
    let asked = Session::connect(target, Gate::queries())
        .and_then(|mut session| session.call(&CountObjects::new(channel())).map(drop));
    let error = asked.unwrap_err();
    (error.exit(), error.to_string())
}

/// The errors for several kinds of unreachable devices differ, and contain advice.
#[test]
fn unreachable_devices_are_distinguished() {
    let gone: TcpListener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let nobody = Target::local(gone.local_addr().unwrap(), NET_ID);
    drop(gone);
    let (exit, text) = ask(nobody);
    assert_eq!(exit, Exit::Nothing);
    assert!(text.contains("refuses the connection") && text.contains("48898"), "{text}");

    // A router without a route to the client closes the connection.
    let (exit, text) = ask(device(drop));
    assert_eq!(exit, Exit::Nothing);
    let parts = ["closed the connection without a reply", "route", "127.0.0.1.1.2"];
    assert!(parts.iter().all(|part| text.contains(part)), "{text}");

    // The device receives the request, but does not reply.
    let (exit, text) = ask(device(|stream| {
        thread::spawn(move || {
            thread::sleep(Duration::from_secs(5));
            drop(stream);
        });
    }));
    assert_eq!(exit, Exit::Nothing);
    let parts = ["does not reply within 200 ms", "192.0.2.7.1.1", "--source-net-id"];
    assert!(parts.iter().all(|part| text.contains(part)), "{text}");

    // A server of another protocol listens at the address.
    let (exit, text) = ask(device(|mut stream| {
        let _asked = stream.read(&mut [0; 64]);
        let _answered = stream.write_all(b"HTTP/1.1 400 Bad Request\r\n\r\n");
        thread::sleep(Duration::from_millis(50));
    }));
    assert_eq!(exit, Exit::Nothing);
    assert!(text.contains("does not use AMS/TCP"), "{text}");

    // The device has another NetId.
    let serve = Serve::start(&[]);
    let addr = serve.addr.parse().unwrap();
    let (exit, text) = ask(Target::local(addr, AmsNetId([1, 2, 3, 4, 1, 1])));
    assert_eq!(exit, Exit::Nothing);
    assert!(text.contains("0x7") && text.contains("--net-id"), "{text}");
}

/// If the connection is lost after a write, the write is not sent again.
#[test]
fn a_write_is_not_repeated() {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let target = Target::local(listener.local_addr().unwrap(), NET_ID);
    let taken = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let len = stream.read(&mut [0; 256]).unwrap();
        drop(stream);
        listener.set_nonblocking(true).unwrap();
        thread::sleep(Duration::from_millis(300));
        (len, listener.accept().is_ok())
    });
    let mut session = Session::connect(target, allowing(&variable(WRITABLE))).unwrap();
    let write = WriteByName::new(channel(), WRITABLE, &[1][..]).unwrap();
    assert!(matches!(session.call(&write), Err(ToolError::NoReply(_))));
    let (len, again) = taken.join().unwrap();
    assert!(len > 38 && !again);
}

/// With a rate, the client does not send more requests per second than the rate.
#[test]
fn the_rate_of_requests_is_limited() {
    let serve = Serve::start(&[]);
    let pace = Duration::from_millis(40);
    let target = Target { pace, ..Target::local(serve.addr.parse().unwrap(), NET_ID) };
    let mut session = Session::connect(target, Gate::queries()).unwrap();
    let begun = Instant::now();
    for _ in 0..6 {
        session.call(&CountObjects::new(channel())).unwrap();
    }
    assert!(begun.elapsed() >= 5 * pace);
}

/// A session with a device that replies to each request with the same data and AMS error.
fn saying(error: u8, data: &'static [u8]) -> Session {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let target = Target::local(listener.local_addr().unwrap(), NET_ID);
    thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let mut frame = [0; 38];
            while stream.read_exact(&mut frame).is_ok() {
                let (target, source) = (frame[6..14].to_vec(), frame[14..22].to_vec());
                frame[2] = u8::try_from(32 + data.len()).unwrap();
                frame[6..14].copy_from_slice(&source);
                frame[14..22].copy_from_slice(&target);
                (frame[24], frame[26], frame[30]) = (5, u8::try_from(data.len()).unwrap(), error);
                let _gone = stream.write_all(&[&frame[..], data].concat());
            }
        }
    });
    Session::connect(target, Gate::queries()).unwrap()
}

#[test]
fn device_information_is_read() {
    let info = b"\0\0\0\0\x03\x01\xF1\x0BFr\xE4se 1\0\0\0\0\0\0\0\0\0";
    let info = saying(0, info).device_info(Task::Geo).unwrap();
    assert_eq!((info.major, info.minor, info.build), (3, 1, 3057));
    assert_eq!(info.name().to_string(), "Fr\u{e4}se 1");
    let state = saying(0, &[0, 0, 0, 0, 15, 0, 1, 0]).device_state(Task::Com).unwrap();
    assert_eq!((state.ads_state, state.device_state), (AdsState::CONFIG, 1));

    // All tasks of the simulated CNC return the same device information.
    let mut session = simulated(Gate::queries());
    for task in [Task::Geo, Task::Sda, Task::Com] {
        assert_eq!(session.device_info(task).unwrap().name(), "ads-cnc serve");
        assert_eq!(session.device_state(task).unwrap().ads_state, AdsState::RUN);
    }
}

/// Errors in the replies to ReadState and ReadDeviceInfo: a result with or without the other
/// fields, an AMS error, and invalid replies (ADS-6).
#[test]
fn missing_device_information_is_an_error() {
    for data in [&[1, 7, 0, 0][..], &[1, 7, 0, 0, 0, 0, 0, 0]] {
        let error = saying(0, data).device_state(Task::Com).unwrap_err();
        assert_eq!(error.ads_error(), Some(AdsError::SERVICE_NOT_SUPPORTED));
        assert_eq!(error.exit(), Exit::Failure);
        assert_eq!(error.to_string(), "the device rejects ReadState with 0x701");
    }
    let error = saying(6, &[]).device_info(Task::Com).unwrap_err();
    assert_eq!(error.exit(), Exit::Nothing);
    assert!(error.to_string().contains("AMS port 553"), "{error}");
    // A successful result without the other fields, and the reply to ReadState instead.
    for data in [&[0; 4][..], &[0, 0, 0, 0, 5, 0, 0, 0]] {
        let error = saying(0, data).device_info(Task::Com).unwrap_err();
        assert!(error.to_string().contains("device-info-reply: "), "{error}");
    }
    // A dry run sends nothing.
    let nobody = Target::local(SocketAddr::from(([127, 0, 0, 1], 1)), NET_ID);
    let mut session = Session::dry(nobody, Gate::queries(), |_| {}).unwrap();
    assert!(matches!(session.device_info(Task::Com), Err(ToolError::NotSent)));
}
