//! The published crate `ads`, a client that is independent of this project, sends requests to the
//! simulated CNC. No expected bytes are encoded by this project's codec; most are literals.

use std::io::Read as _;
use std::time::Duration;

use crate::common::Serve;
use crate::common::task::{Cnc, Task, client, number};
use ads::{AmsAddr, AmsNetId, Client};

/// Index groups of variables: of channel 1; and of the channels 1, 2 and 6, by rank and by number,
/// each with the number of its channel.
const CHANNEL_1: u32 = 0x12_2301;
const BY_RANK: [(u32, u8); 3] = [(0x02_2301, 1), (0x02_2302, 2), (0x02_2303, 6)];
const BY_NUMBER: [(u32, u8); 3] = [(0x12_2301, 1), (0x12_2302, 2), (0x12_2306, 6)];

#[test]
fn objects() {
    let cnc = Cnc::start(&[]);
    let com = cnc.com();
    assert_eq!(com.read(0x13_0101, 0, 4), Ok(vec![30, 0, 0, 0]));
    // The list of channel 1 by rank, and the lists of another channel, of the platform and of a
    // platform axis.
    assert_eq!(com.read(0x03_0101, 0, 4), Ok(vec![30, 0, 0, 0]));
    assert_eq!(com.read(0x03_0103, 0, 4), com.read(0x13_0106, 0, 4));
    assert_eq!(com.read(0x13_0100, 0, 4), Ok(vec![2, 0, 0, 0]));
    assert_eq!(com.read(0x13_0203, 0, 4), Ok(vec![3, 0, 0, 0]));

    let printed = b"\x52\0\0\0\x01\0\0\0\0\0\0\0\x01\x01\x12\0\x03\0\0\0\
        mc_active_single_block_r\0\0\0\0\0\0\0\0\
        BOOL\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
    let command = b"\x53\0\0\0\x01\0\0\0\x01\0\0\0\x01\x01\x12\0\x01\0\0\0\
        mc_command_single_block_w\0\0\0\0\0\0\0\
        BOOL\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
    assert_eq!(com.read(0x13_0101, 0x10, 84), Ok(printed.to_vec()));
    assert_eq!(com.read(0x13_0101, 0x10, 168), Ok([&printed[..], command].concat()));
    // A read length between one and two descriptors returns one; a read length longer than the
    // rest of the list returns the rest.
    assert_eq!(com.read(0x13_0101, 0x10, 100), Ok(printed.to_vec()));
    assert_eq!(com.read(0x13_0101, 29, 10 * 84).map(|bytes| bytes.len()), Ok(168));
    assert_eq!(com.read(0x13_0101, 1, 30 * 84).map(|bytes| bytes.len()), Ok(30 * 84));
}

#[test]
fn printed_variables() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let ask = |offset, data: &[u8]| sda.ask(CHANNEL_1, offset, data).unwrap();
    assert_eq!(ask(0x44, b"V.E\0"), [123, 0, 0, 0]);
    assert_eq!(
        ask(0x45, b"\x02\0\0\0V.E\0"),
        b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0"
    );
    assert_eq!(ask(0x46, b"V.E.vartest\0"), [0x04, 0, 0, 0x02]);
    // The printed values: an element 333, and an array 123 234 345 456 567.
    let array = [123, 0, 0, 0, 234, 0, 0, 0, 89, 1, 0, 0, 200, 1, 0, 0, 55, 2, 0, 0];
    assert_eq!(ask(0x47, b"\x41\x23\x01\x20\x01\0\0\0\x04\0\0\0"), [77, 1, 0, 0]);
    assert_eq!(ask(0x47, b"\x34\x12\x00\x02\0\0\0\0"), array);
    assert_eq!(ask(0x48, b"V.E.Testvar\0"), array);
    // This CNC returns the element of the array above. Another printed example, which
    // contradicts the array, has 333 here (E-27).
    assert_eq!(ask(0x48, b"V.E.Testvar[3]\0"), [200, 1, 0, 0]);
    assert_eq!(ask(0x48, b"V.E.test[4]\0"), [55, 2, 0, 0]);
}

#[test]
fn other_variables() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let ask = |offset, data: &[u8]| sda.ask(CHANNEL_1, offset, data).unwrap();
    assert_eq!(ask(0x44, b"V.G\0"), [10, 0, 0, 0]);
    assert_eq!(ask(0x44, b"V.A\0"), [6, 0, 0, 0]);
    // The empty kind returns the number of V.E, V.G and V.A variables together.
    assert_eq!(ask(0x44, b"\0"), [139, 0, 0, 0]);
    // V.A.ACT_POS.Z is 0.0, which is eight NULs; another value, read by handle, is 1234.2.
    assert_eq!(ask(0x48, b"V.A.ACT_POS.Z\0"), [0; 8]);
    let real = [0xCD, 0xCC, 0xCC, 0xCC, 0xCC, 0x48, 0x93, 0x40];
    assert_eq!(ask(0x47, b"\x1B\0\x02\x01\0\0\0\0"), real);
    // A name with a character in CP1252, and a text in CP1252 with bytes after its NUL.
    let value = [0x00, 0x00, 0x00, 0x00, 0x00, 0x4A, 0x93, 0x40];
    assert_eq!(ask(0x48, b"V.E.L\xE4nge\0"), value);
    assert_eq!(ask(0x48, b"V.E.text\0"), b"L\xE4nge 5\x80\0rest\0\0\0\0\0\0\0\0");
    // Elements of arrays with two and three dimensions.
    assert_eq!(ask(0x48, b"V.E.matrix[1][0]\0"), [21, 0]);
    assert_eq!(ask(0x48, b"V.E.cube[1][2][3]\0"), [23]);
    // An index before a dot is part of the name.
    assert_eq!(ask(0x48, b"V.G.NP[0].V[1]\0"), [0, 0, 0, 0, 0, 0, 0, 0x40]);
    assert_eq!(ask(0x48, b"V.E.largest\0").len(), 2048);
}

#[test]
fn a_rank_is_not_a_number() {
    let cnc = Cnc::start(&[]);
    for (group, number) in BY_RANK.into_iter().chain(BY_NUMBER) {
        for (task, name) in [(cnc.geo(), "GEO"), (cnc.sda(), "SDA")] {
            let reply = task.ask(group, 0x48, b"V.E.channel\0");
            assert_eq!(reply, Ok(vec![number, 0, 0, 0]), "{group:#x} at {name}");
        }
    }
}

#[test]
fn invalid_requests_return_error_numbers() {
    let cnc = Cnc::start(&[]);
    let (sda, com) = (cnc.sda(), cnc.com());
    let rejected = |group, offset, data: &[u8]| sda.ask(group, offset, data).unwrap_err();
    // A group without functions, and channels that do not exist, by number and by rank.
    for group in [0xF005, 0x12_2303, 0x12_2305, 0x02_2304] {
        assert_eq!(rejected(group, 0x44, b"V.E\0"), 0x702, "{group:#x}");
    }
    // The group of the names of elements supports only Read, so ReadWrite is rejected.
    assert_eq!(rejected(0x12_2401, 0x44, b"V.E\0"), 0x701);
    // Unknown offsets, names and kinds; indices and handles that do not exist; wrong sizes.
    for (offset, data, error) in [
        (0x7FFF, &b"V.E\0"[..], 0x703),
        (0x46, b"V.E.nobody\0", 0x710),
        (0x48, b"V.E.nobody\0", 0x710),
        (0x44, b"V.X\0", 0x710),
        (0x45, b"\x7B\0\0\0V.E\0", 0x706),
        (0x47, b"\xFF\xFF\xFF\x7F\0\0\0\0", 0x706),
        (0x47, b"\x34\x12\0\x02\x01\0\0\0\x05\0\0\0", 0x706),
        (0x47, b"\x34\x12\0\x02\x02\0\0\0\0\0\0\0\0\0\0\0", 0x706),
        (0x48, b"V.E.test[5]\0", 0x706),
        (0x44, b"V.E", 0x705),
        (0x45, b"\x02\0\0", 0x705),
        (0x47, b"\x34\x12\0\x02", 0x705),
        (0x47, b"\x34\x12\0\x02\xFF\xFF\xFF\xFF", 0x705),
    ] {
        assert_eq!(rejected(CHANNEL_1, offset, data), error, "{offset:#x} {data:x?}");
    }
    // Read lengths of the wrong size.
    assert_eq!(sda.ask_for(CHANNEL_1, 0x44, b"V.E\0", 3), Err(0x705));
    assert_eq!(sda.ask_for(CHANNEL_1, 0x48, b"V.E.test\0", 19), Err(0x705));
    // Requests to COM with a wrong size, or an object, channel or axis that does not exist.
    assert_eq!(com.read(0x13_0101, 31, 84), Err(0x703));
    assert_eq!(com.read(0x13_0101, 1, 83), Err(0x705));
    assert_eq!(com.read(0x13_0105, 0, 4), Err(0x702));
    assert_eq!(com.read(0x13_0206, 0, 4), Err(0x702));
    assert_eq!(com.read(0x12_0101, 4, 1), Err(0x703));
    // Requests with another service, at another port, and to another AMS NetId.
    assert_eq!(sda.read(CHANNEL_1, 0x44, 4), Err(0x701));
    assert_eq!(sda.write(CHANNEL_1, 0x44, b"V.E\0"), Err(0x701));
    assert_eq!(number(sda.0.write_control(ads::AdsState::Stop, 0)), Err(0x701));
    let each = ads::notif::TransmissionMode::ServerCycle;
    let attributes = ads::notif::Attributes::new(4, each, Duration::ZERO, Duration::ZERO);
    let notified = com.0.add_notification(0x12_0101, 1, &attributes);
    assert_eq!(number(notified.map(|_| ())), Err(0x701));
    assert_eq!(cnc.at(851).ask(CHANNEL_1, 0x44, b"V.E\0"), Err(0x6));
    let other = cnc.at_net_id(AmsNetId::new(192, 0, 2, 1, 1, 1), 552);
    assert_eq!(other.ask(CHANNEL_1, 0x44, b"V.E\0"), Err(0x7));
    // The CNC still replies after these requests.
    assert_eq!(sda.ask(CHANNEL_1, 0x44, b"V.E\0"), Ok(vec![123, 0, 0, 0]));
}

#[test]
fn device_info_and_state_are_returned() {
    let cnc = Cnc::start(&[]);
    for Task(device) in [cnc.geo(), cnc.sda(), cnc.com()] {
        let info = device.get_info().unwrap();
        let minor = env!("CARGO_PKG_VERSION_MINOR").parse().unwrap();
        assert_eq!((&*info.name, info.major, info.minor), ("ads-cnc serve", 0, minor));
        assert_eq!(device.get_state().unwrap(), (ads::AdsState::Run, 0));
    }
    assert_eq!(number(cnc.at(851).0.get_state().map(|_| ())), Err(0x6));
}

#[test]
fn two_clients_at_once() {
    let serve = Serve::start(&[]);
    let clients = [client(&serve), client(&serve)];
    for _ in 0..3 {
        for client in &clients {
            assert_eq!(count(client, &serve), Ok(vec![123, 0, 0, 0]));
        }
    }
}

#[test]
fn a_defect_changes_replies() {
    let cnc = Cnc::start(&["--defect", "variable-count.count.flip"]);
    assert_eq!(cnc.sda().ask(CHANNEL_1, 0x44, b"V.E\0"), Ok(vec![122, 0, 0, 0]));
}

#[test]
fn serve_prints_one_line() {
    let mut serve = Serve::start(&[]);
    let mut out = serve.process.stdout.take().unwrap();
    for _ in 0..2 {
        assert_eq!(count(&client(&serve), &serve), Ok(vec![123, 0, 0, 0]));
    }
    serve.process.kill().unwrap();
    let mut rest = String::new();
    out.read_to_string(&mut rest).unwrap();
    assert_eq!(rest, "");
}

/// Requests the number of V.E variables.
fn count(client: &Client, serve: &Serve) -> Result<Vec<u8>, u32> {
    let sda = AmsAddr::new(serve.net_id.parse().unwrap(), 552);
    Task(client.device(sda)).ask(CHANNEL_1, 0x44, b"V.E\0")
}
