//! The five variables of the Service Interface of the simulated CNC.

use super::{CHANNEL_1, Cnc};

/// The names, types and declared sizes in bytes of the variables.
const VARIABLES: [(&str, u8, u8); 5] = [
    ("V.G.SERVICE.UUID", 9, 128),
    ("V.G.SERVICE.REQUEST", 9, 128),
    ("V.G.SERVICE.REQUEST_STATE", 7, 4),
    ("V.G.SERVICE.RESPONSE_STATE", 7, 4),
    ("V.G.SERVICE.RESPONSE", 9, 128),
];

#[test]
fn each_channel_has_the_variables() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    for (group, first) in [(CHANNEL_1, 5), (0x12_2302, 1), (0x12_2306, 1)] {
        for (index, (name, code, size)) in (first..).zip(VARIABLES) {
            let described = sda.ask(group, 0x45, &[&[index, 0, 0, 0][..], b"V.G\0"].concat());
            let described = described.unwrap();
            let wanted =
                [&[code, 0, 0, 0, 2, 0, 0, 0, size, 0, 0, 0, 0, 0, 0, 0], name.as_bytes(), b"\0"];
            assert_eq!(described[4..], wanted.concat());
            let name = format!("{name}\0");
            assert_eq!(sda.ask(group, 0x46, name.as_bytes()).unwrap(), described[..4]);
            assert_eq!(sda.ask(group, 0x48, name.as_bytes()), Ok(vec![0; size.into()]), "{name}");
        }
    }
}

/// SVC-3 and SVC-4: a write of REQUEST_STATE resets RESPONSE_STATE, and a write of RESPONSE_STATE resets
/// REQUEST_STATE.
#[test]
fn each_state_resets_the_other() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let write = |name: &str, value: &[u8]| {
        sda.write(CHANNEL_1, 0x4A, &[name.as_bytes(), b"\0", value].concat())
    };
    let read = |name: &str| sda.ask(CHANNEL_1, 0x48, format!("{name}\0").as_bytes()).unwrap();
    let [(uuid, ..), (request, ..), (request_state, ..), (response_state, ..), (response, ..)] =
        VARIABLES;
    assert_eq!(write(uuid, b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0"), Ok(()));
    assert_eq!(write(request, b"3\0"), Ok(()));
    assert_eq!(write(request_state, &[1, 0, 0, 0]), Ok(()));
    assert_eq!(read(request)[..4], *b"3\0\0\0");
    assert_eq!(read(request_state), [1, 0, 0, 0]);
    assert_eq!(write(response, b"1.732051\0"), Ok(()));
    assert_eq!(write(response_state, &[1, 0, 0, 0]), Ok(()));
    assert_eq!((read(request_state), read(response_state)), (vec![0; 4], vec![1, 0, 0, 0]));
    assert_eq!(read(response)[..10], *b"1.732051\0\0");
    // A write by handle has the same effect as a write by name.
    let handle = sda.ask(CHANNEL_1, 0x46, b"V.G.SERVICE.REQUEST_STATE\0").unwrap();
    let again = [&handle[..], &[0; 4], &[2, 0, 0, 0]].concat();
    assert_eq!(sda.write(CHANNEL_1, 0x49, &again), Ok(()));
    assert_eq!((read(request_state), read(response_state)), (vec![2, 0, 0, 0], vec![0; 4]));
    // Another channel has its own variables.
    assert_eq!(sda.ask(0x12_2302, 0x48, b"V.G.SERVICE.REQUEST_STATE\0"), Ok(vec![0; 4]));
    // A text has at most 127 characters and a NUL.
    assert_eq!(write(request, &[b'x'; 127]), Ok(()));
    assert_eq!(write(request, &[b'x'; 128]), Err(0x705));
    assert_eq!(write(request_state, &[1]), Err(0x705));
}

/// A CNC of an older version has none of these variables.
#[test]
fn the_variables_depend_on_the_version() {
    let cnc = Cnc::start(&["--cnc-version", "V2.11.2020"]);
    let sda = cnc.sda();
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.G.SERVICE.UUID\0"), Err(0x710));
    assert_eq!(sda.ask(CHANNEL_1, 0x44, b"V.G\0"), Ok(vec![5, 0, 0, 0]));
}
