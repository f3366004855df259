//! The published crate `ads`, a client that is independent of this project, sends requests to the
//! simulated CNC. No expected bytes are encoded by this project's codec; most are literals.

use std::io::Read as _;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::Serve;
use crate::common::task::{ask, ask_for, number, read};
use ads::{AmsAddr, AmsNetId, Client, Device, Source, Timeouts};

const GEO: u16 = 551;
const SDA: u16 = 552;
const COM: u16 = 553;

/// Index groups of variables: of channel 1; and of the channels 1, 2 and 6, by rank and by number,
/// each with the number of its channel.
const CHANNEL_1: u32 = 0x12_2301;
const BY_RANK: [(u32, u8); 3] = [(0x02_2301, 1), (0x02_2302, 2), (0x02_2303, 6)];
const BY_NUMBER: [(u32, u8); 3] = [(0x12_2301, 1), (0x12_2302, 2), (0x12_2306, 6)];

impl Serve {
    /// A client that uses the IP address of its socket as its NetId: 127.0.0.1.1.1.
    fn client(&self) -> Client {
        Client::new(&*self.addr, Timeouts::new(Duration::from_secs(5)), Source::Auto).unwrap()
    }

    fn net_id(&self) -> AmsNetId {
        self.net_id.parse().unwrap()
    }
}

/// Runs `body` with a client and the NetId of a new CNC.
fn with_cnc(options: &[&str], body: impl FnOnce(&Client, AmsNetId)) {
    let serve = Serve::start(options);
    let client = serve.client();
    body(&client, serve.net_id());
}

fn port(client: &Client, net_id: AmsNetId, port: u16) -> Device<'_> {
    client.device(AmsAddr::new(net_id, port))
}

#[test]
fn objects() {
    with_cnc(&[], |client, net_id| {
        let com = port(client, net_id, COM);
        assert_eq!(read(com, 0x13_0101, 0, 4), Ok(vec![30, 0, 0, 0]));
        // The list of channel 1 by rank, and the lists of another channel, of the platform and of a
        // platform axis.
        assert_eq!(read(com, 0x03_0101, 0, 4), Ok(vec![30, 0, 0, 0]));
        assert_eq!(read(com, 0x03_0103, 0, 4), read(com, 0x13_0106, 0, 4));
        assert_eq!(read(com, 0x13_0100, 0, 4), Ok(vec![2, 0, 0, 0]));
        assert_eq!(read(com, 0x13_0203, 0, 4), Ok(vec![3, 0, 0, 0]));

        let printed = b"\x52\0\0\0\x01\0\0\0\0\0\0\0\x01\x01\x12\0\x03\0\0\0\
            mc_active_single_block_r\0\0\0\0\0\0\0\0\
            BOOL\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
        let command = b"\x53\0\0\0\x01\0\0\0\x01\0\0\0\x01\x01\x12\0\x01\0\0\0\
            mc_command_single_block_w\0\0\0\0\0\0\0\
            BOOL\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
        assert_eq!(read(com, 0x13_0101, 0x10, 84), Ok(printed.to_vec()));
        assert_eq!(read(com, 0x13_0101, 0x10, 168), Ok([&printed[..], command].concat()));
        // A read length between one and two descriptors returns one; a read length longer than the
        // rest of the list returns the rest.
        assert_eq!(read(com, 0x13_0101, 0x10, 100), Ok(printed.to_vec()));
        assert_eq!(read(com, 0x13_0101, 29, 10 * 84).map(|bytes| bytes.len()), Ok(168));
        assert_eq!(read(com, 0x13_0101, 1, 30 * 84).map(|bytes| bytes.len()), Ok(30 * 84));
    });
}

#[test]
fn printed_variables() {
    with_cnc(&[], |client, net_id| {
        let sda = port(client, net_id, SDA);
        let ask = |offset, data: &[u8]| ask(sda, CHANNEL_1, offset, data).unwrap();
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
    });
}

#[test]
fn other_variables() {
    with_cnc(&[], |client, net_id| {
        let sda = port(client, net_id, SDA);
        let ask = |offset, data: &[u8]| ask(sda, CHANNEL_1, offset, data).unwrap();
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
    });
}

#[test]
fn a_rank_is_not_a_number() {
    with_cnc(&[], |client, net_id| {
        for (group, number) in BY_RANK.into_iter().chain(BY_NUMBER) {
            for task in [GEO, SDA] {
                let reply = ask(port(client, net_id, task), group, 0x48, b"V.E.channel\0");
                assert_eq!(reply, Ok(vec![number, 0, 0, 0]), "{group:#x} at {task}");
            }
        }
    });
}

#[test]
fn invalid_requests_return_error_numbers() {
    with_cnc(&[], |client, net_id| {
        let (sda, com) = (port(client, net_id, SDA), port(client, net_id, COM));
        let rejected = |group, offset, data: &[u8]| ask(sda, group, offset, data).unwrap_err();
        // A group without functions, and channels that do not exist, by number and by rank.
        for group in [0xF005, 0x12_2303, 0x12_2305, 0x02_2304] {
            assert_eq!(rejected(group, 0x44, b"V.E\0"), 0x702, "{group:#x}");
        }
        // The group of the names of elements supports only Read, so ReadWrite is rejected.
        assert_eq!(rejected(0x12_2401, 0x44, b"V.E\0"), 0x701);
        assert_eq!(rejected(CHANNEL_1, 0x7FFF, b"V.E\0"), 0x703);
        assert_eq!(rejected(CHANNEL_1, 0x46, b"V.E.nobody\0"), 0x710);
        assert_eq!(rejected(CHANNEL_1, 0x48, b"V.E.nobody\0"), 0x710);
        assert_eq!(rejected(CHANNEL_1, 0x44, b"V.X\0"), 0x710);
        assert_eq!(rejected(CHANNEL_1, 0x45, b"\x7B\0\0\0V.E\0"), 0x706);
        assert_eq!(rejected(CHANNEL_1, 0x47, b"\xFF\xFF\xFF\x7F\0\0\0\0"), 0x706);
        assert_eq!(rejected(CHANNEL_1, 0x47, b"\x34\x12\0\x02\x01\0\0\0\x05\0\0\0"), 0x706);
        assert_eq!(rejected(CHANNEL_1, 0x47, b"\x34\x12\0\x02\x02\0\0\0\0\0\0\0\0\0\0\0"), 0x706);
        assert_eq!(rejected(CHANNEL_1, 0x48, b"V.E.test[5]\0"), 0x706);
        // Requests and read lengths of the wrong size.
        assert_eq!(rejected(CHANNEL_1, 0x44, b"V.E"), 0x705);
        assert_eq!(rejected(CHANNEL_1, 0x45, b"\x02\0\0"), 0x705);
        assert_eq!(rejected(CHANNEL_1, 0x47, b"\x34\x12\0\x02"), 0x705);
        assert_eq!(rejected(CHANNEL_1, 0x47, b"\x34\x12\0\x02\xFF\xFF\xFF\xFF"), 0x705);
        assert_eq!(ask_for(sda, CHANNEL_1, 0x44, b"V.E\0", 3), Err(0x705));
        assert_eq!(ask_for(sda, CHANNEL_1, 0x48, b"V.E.test\0", 19), Err(0x705));
        // Requests to COM with a wrong size, or an object, channel or axis that does not exist.
        assert_eq!(read(com, 0x13_0101, 31, 84), Err(0x703));
        assert_eq!(read(com, 0x13_0101, 1, 83), Err(0x705));
        assert_eq!(read(com, 0x13_0105, 0, 4), Err(0x702));
        assert_eq!(read(com, 0x13_0206, 0, 4), Err(0x702));
        assert_eq!(read(com, 0x12_0101, 4, 1), Err(0x703));
        // Requests with another service, at another port, and to another AMS NetId.
        assert_eq!(read(sda, CHANNEL_1, 0x44, 4), Err(0x701));
        assert_eq!(number(sda.write(CHANNEL_1, 0x44, b"V.E\0")), Err(0x701));
        assert_eq!(number(sda.write_control(ads::AdsState::Stop, 0)), Err(0x701));
        let each = ads::notif::TransmissionMode::ServerCycle;
        let attributes = ads::notif::Attributes::new(4, each, Duration::ZERO, Duration::ZERO);
        let notified = com.add_notification(0x12_0101, 1, &attributes);
        assert_eq!(number(notified.map(|_| ())), Err(0x701));
        let plc = port(client, net_id, 851);
        assert_eq!(ask(plc, CHANNEL_1, 0x44, b"V.E\0"), Err(0x6));
        let other = port(client, AmsNetId::new(192, 0, 2, 1, 1, 1), SDA);
        assert_eq!(ask(other, CHANNEL_1, 0x44, b"V.E\0"), Err(0x7));
        // The CNC still replies after these requests.
        assert_eq!(ask(sda, CHANNEL_1, 0x44, b"V.E\0"), Ok(vec![123, 0, 0, 0]));
    });
}

#[test]
fn device_info_and_state_are_returned() {
    with_cnc(&[], |client, net_id| {
        for task in [GEO, SDA, COM] {
            let device = port(client, net_id, task);
            let info = device.get_info().unwrap();
            let minor = env!("CARGO_PKG_VERSION_MINOR").parse().unwrap();
            assert_eq!((&*info.name, info.major, info.minor), ("ads-cnc serve", 0, minor));
            assert_eq!(device.get_state().unwrap(), (ads::AdsState::Run, 0));
        }
        let plc = port(client, net_id, 851);
        assert_eq!(number(plc.get_state().map(|_| ())), Err(0x6));
    });
}

#[test]
fn two_clients_at_once() {
    let serve = Serve::start(&[]);
    let clients = [serve.client(), serve.client()];
    for _ in 0..3 {
        for client in &clients {
            let sda = port(client, serve.net_id(), SDA);
            assert_eq!(ask(sda, CHANNEL_1, 0x44, b"V.E\0"), Ok(vec![123, 0, 0, 0]));
        }
    }
}

#[test]
fn a_defect_changes_replies() {
    with_cnc(&["--defect", "variable-count.count.flip"], |client, net_id| {
        let sda = port(client, net_id, SDA);
        assert_eq!(ask(sda, CHANNEL_1, 0x44, b"V.E\0"), Ok(vec![122, 0, 0, 0]));
    });
}

/// The exit code and the error message.
fn fails(options: &[&str]) -> (Option<i32>, String) {
    let serve = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
        .arg("serve")
        .args(options)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert_eq!(String::from_utf8_lossy(&serve.stdout), "");
    (serve.status.code(), String::from_utf8(serve.stderr).unwrap())
}

#[test]
fn serve_rejects_invalid_options() {
    let (code, why) = fails(&["--listen", "0.0.0.0:0"]);
    assert_eq!(code, Some(2));
    assert!(why.contains("not a loopback address"), "{why}");
    let (code, why) = fails(&["--defect", "no.such.defect"]);
    assert_eq!(code, Some(2));
    assert!(why.contains("serve --list-defects"), "{why}");
    assert_eq!(fails(&["--listen", "nowhere"]).0, Some(2));

    let serve = Serve::start(&[]);
    let (code, why) = fails(&["--listen", &serve.addr]);
    assert_eq!(code, Some(2));
    assert!(why.contains("cannot listen on"), "{why}");
}

#[test]
fn serve_prints_one_line() {
    let mut serve = Serve::start(&[]);
    let mut out = serve.process.stdout.take().unwrap();
    assert_eq!(ask_twice(&serve), [123, 123]);
    serve.process.kill().unwrap();
    let mut rest = String::new();
    out.read_to_string(&mut rest).unwrap();
    assert_eq!(rest, "");
}

fn ask_twice(serve: &Serve) -> [u8; 2] {
    [0, 1].map(|_| {
        let client = serve.client();
        let sda = port(&client, serve.net_id(), SDA);
        ask(sda, CHANNEL_1, 0x44, b"V.E\0").unwrap()[0]
    })
}
