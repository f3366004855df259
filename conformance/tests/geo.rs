//! Which of the tasks SDA and GEO has a class no manual says: what one of them does not have, the
//! tools find at the other.

use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::process::{Command, Output};
use std::thread;

use ads_cnc::Encode as _;
use ads_cnc::address::{Class, Group};
use ads_cnc::ads::{AdsError, AmsHeader, AmsPort, FrameRef, ReadWriteReplyRef};
use ads_cnc::operation::Call;
use ads_cnc_conformance::cnc::{Cnc, NET_ID};
use ads_cnc_conformance::net;

/// Who has the position controller.
#[derive(Clone, Copy, Debug)]
enum Only {
    /// GEO; SDA refuses.
    Geo,
    /// Nobody; there is no GEO at all.
    Nobody,
}

fn cnc(only: Only) -> SocketAddr {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let addr = listener.local_addr().unwrap();
    thread::spawn(move || {
        let cnc = Cnc::with_default_model().unwrap();
        for stream in listener.incoming() {
            // The tool may be gone at any time.
            let _gone = serve(&stream.unwrap(), &cnc, only);
        }
    });
    addr
}

fn serve(mut stream: &TcpStream, cnc: &Cnc, only: Only) -> io::Result<()> {
    let (mut received, mut chunk) = (Vec::new(), [0; 4096]);
    loop {
        match stream.read(&mut chunk)? {
            0 => return Ok(()),
            len => received.extend_from_slice(&chunk[..len]),
        }
        while let Some((frame, len)) = FrameRef::split(&received, 0x1_0000).unwrap() {
            let call = Call::of_frame(&frame).unwrap().unwrap();
            let of_class = match call.index_group.parts() {
                Some(Group::Class(group)) => group.class == Class::PositionController,
                _ => false,
            };
            let mut answer = Vec::new();
            match (only, call.port) {
                (Only::Nobody, AmsPort::GEO) => {
                    let error = AdsError::TARGET_PORT_NOT_FOUND;
                    answer = to(frame.header(), error, &[]);
                }
                (_, AmsPort::SDA) if of_class => {
                    let result = AdsError::INVALID_GROUP;
                    let reply = ReadWriteReplyRef { result, data: None }.to_vec().unwrap();
                    answer = to(frame.header(), AdsError::NONE, &reply);
                }
                _ => cnc.respond(NET_ID, &frame, &mut answer),
            }
            stream.write_all(&answer)?;
            received.drain(..len);
        }
    }
}

/// The answer to a request.
fn to(asked: AmsHeader, error: AdsError, data: &[u8]) -> Vec<u8> {
    let header = AmsHeader { error, ..asked.response() };
    FrameRef::new(header, data).unwrap().to_vec().unwrap()
}

fn ads_cnc(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ads-cnc")).args(args).output().unwrap()
}

fn call(addr: SocketAddr, args: &[&str]) -> Output {
    ads_cnc(&[args, &["--target", &addr.to_string(), "--net-id", "127.0.0.1.1.1"]].concat())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn what_sda_has_not_is_found_at_geo() {
    let addr = cnc(Only::Geo);
    let found = call(addr, &["browse", "--content"]);
    assert_eq!(text(&found.stdout), text(&ads_cnc(&["browse", "--content"]).stdout));
    assert_eq!(text(&found.stderr), "ads-cnc: position controller: of the GEO task\n");

    let place = ["example.gain", "--of", "position controller axis 2"];
    let value = call(addr, &[&["get", "--json"], &place[..]].concat());
    assert_eq!(value.status.code(), Some(0), "{}", text(&value.stderr));
    let value: serde_json::Value = serde_json::from_slice(&value.stdout).unwrap();
    let object = &value["objects"][0];
    assert_eq!((&object["port"], &object["value"]), (&551.into(), &33.5.into()));

    // No entry is about GEO.
    let set = call(addr, &[&["set"], &place[..], &["1"]].concat());
    let why = text(&set.stderr);
    assert_eq!(set.status.code(), Some(4), "{why}");
    assert!(why.contains("\"write element content\" is not sent to port 551"), "{why}");
}

#[test]
fn a_cnc_need_not_have_geo() {
    let found = call(cnc(Only::Nobody), &["browse", "--of", "*controller*"]);
    assert_eq!(found.status.code(), Some(3));
    let said = text(&found.stderr);
    assert!(said.contains("position controller: none is there, as the SDA task says\n"), "{said}");
    assert!(said.contains("the GEO task cannot be asked: AMS error 0x6. "), "{said}");
}
