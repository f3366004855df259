//! The manuals do not state whether the task SDA or GEO has a class: if SDA does not have a class,
//! the tools query GEO.

use std::net::SocketAddr;
use std::process::Output;

use crate::common::fake::serving;
use crate::common::{ads_cnc, text};
use ads_cnc::Encode as _;
use ads_cnc::address::{Class, Group};
use ads_cnc::ads::{AdsError, AmsHeader, AmsPort, FrameRef, ReadWriteReplyRef};
use ads_cnc::operation::Call;
use ads_cnc_conformance::simulator::{Cnc, NET_ID};

/// The task that has the position controller.
#[derive(Clone, Copy, Debug)]
enum GeoSupport {
    /// Only GEO has the class; SDA rejects requests for the class.
    Geo,
    /// No task has the class, and the port of GEO does not exist.
    Nobody,
}

fn cnc(only: GeoSupport) -> SocketAddr {
    let cnc = Cnc::with_default_model().unwrap();
    serving(move |frame, out| {
        let call = Call::from_frame(frame).unwrap().unwrap();
        let of_class = match call.index_group.parts() {
            Some(Group::Class(group)) => group.class == Class::PositionController,
            _ => false,
        };
        let answer = match (only, call.port) {
            (GeoSupport::Nobody, AmsPort::GEO) => {
                to(frame.header(), AdsError::TARGET_PORT_NOT_FOUND, &[])
            }
            (_, AmsPort::SDA) if of_class => {
                let result = AdsError::INVALID_GROUP;
                let reply = ReadWriteReplyRef { result, data: None }.encode_to_vec().unwrap();
                to(frame.header(), AdsError::NO_ERROR, &reply)
            }
            _ => {
                let mut answer = Vec::new();
                cnc.respond(NET_ID, frame, &mut answer);
                answer
            }
        };
        out.write_all(&answer)
    })
}

/// The reply frame to a request with this header.
fn to(asked: AmsHeader, error: AdsError, data: &[u8]) -> Vec<u8> {
    let header = AmsHeader { error, ..asked.response() };
    FrameRef::new(header, data).unwrap().encode_to_vec().unwrap()
}

fn call(addr: SocketAddr, args: &[&str]) -> Output {
    ads_cnc(&[args, &["--target", &addr.to_string(), "--net-id", "127.0.0.1.1.1"]].concat())
}

#[test]
fn classes_missing_at_sda_are_found_at_geo() {
    let addr = cnc(GeoSupport::Geo);
    let found = call(addr, &["browse", "--content"]);
    assert_eq!(text(&found.stdout), text(&ads_cnc(&["browse", "--content"]).stdout));
    assert_eq!(text(&found.stderr), "ads-cnc: position controller: served by the GEO task\n");

    let place = ["example.gain", "--of", "position controller axis 2"];
    let value = call(addr, &[&["get", "--json"], &place[..]].concat());
    assert_eq!(value.status.code(), Some(0), "{}", text(&value.stderr));
    let value: serde_json::Value = serde_json::from_slice(&value.stdout).unwrap();
    let object = &value["objects"][0];
    assert_eq!((&object["port"], &object["value"]), (&551.into(), &33.5.into()));

    // No entry of a file of `--allow-write` can allow a write to GEO.
    let set = call(addr, &[&["set"], &place[..], &["1"]].concat());
    let why = text(&set.stderr);
    assert_eq!(set.status.code(), Some(4), "{why}");
    assert!(why.contains("\"write element content\" is not sent to port 551"), "{why}");
}

#[test]
fn geo_is_optional() {
    let found = call(cnc(GeoSupport::Nobody), &["browse", "--of", "*controller*"]);
    assert_eq!(found.status.code(), Some(3));
    let stderr_text = text(&found.stderr);
    assert!(
        stderr_text.contains("position controller: the SDA task has no instance\n"),
        "{stderr_text}"
    );
    assert!(
        stderr_text.contains("the GEO task could not be queried: AMS error 0x6. "),
        "{stderr_text}"
    );
}
