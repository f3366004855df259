//! The suite writes only values that the file for `--allow-write` names, whatever handles and addresses
//! the device returns. The log of the simulated CNC contains the writes that the CNC executes, after the
//! defect has changed them.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead as _, BufReader, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::process::{Command, Output};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

use crate::common::file::{HEAD, MemoryFile, TestFile};
use crate::common::harmless::number;
use crate::common::proxy::{frame, proxy_by};
use crate::common::{Serve, ads_cnc};
use ads_cnc_conformance::client::{Client, Target};
use ads_cnc_conformance::faults::{self, Faulty, SeededDefect};
use ads_cnc_conformance::gate::{Allowed, Gate};
use ads_cnc_conformance::judge::{Case, Selection};
use ads_cnc_conformance::profile::Profile;
use ads_cnc_conformance::simulator::{Cnc, LocalCnc, Model, NET_ID};
use ads_cnc_conformance::suite;
use tracing::Level;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::fmt;
use tracing_subscriber::layer::SubscriberExt as _;

/// A simulated CNC, and a thread that reads its log.
struct Logged {
    serve: Serve,
    log: JoinHandle<Vec<String>>,
}

impl Logged {
    fn start(options: &[&str]) -> Self {
        let log = ["--log", "ads_cnc_conformance::simulator=debug"];
        let mut serve = Serve::logging(&[&log[..], options].concat());
        let stderr = BufReader::new(serve.process.stderr.take().unwrap());
        let writes = |line: &String| line.contains("write to a ");
        let log =
            thread::spawn(move || stderr.lines().map_while(Result::ok).filter(writes).collect());
        Self { serve, log }
    }

    /// The value of V.E.Variable_1 as `get` prints it.
    fn value(&self) -> Vec<u8> {
        ads_cnc(&[
            "get",
            "V.E.Variable_1",
            "--target",
            &self.serve.addr,
            "--net-id",
            "127.0.0.1.1.1",
        ])
        .stdout
    }

    /// Ends the CNC; returns the number of writes to each variable, parameter and content.
    fn end(self) -> BTreeMap<String, usize> {
        drop(self.serve);
        let mut writes = BTreeMap::new();
        for line in self.log.join().unwrap() {
            let (_, what) = line.split_once("write to a ").unwrap();
            *writes.entry(what.to_owned()).or_default() += 1;
        }
        writes
    }
}

/// Runs these cases, which write, with this file for `--allow-write`.
fn run(addr: &str, file: &TestFile, cases: &[&str]) -> Output {
    let only: Vec<&str> = cases.iter().flat_map(|case| ["--only", case]).collect();
    let target = ["--target", addr, "--net-id", "127.0.0.1.1.1", "--timeout", "500"];
    let allow = ["--seed", "1", "--allow-write", file.path()];
    let mut command = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    command.arg("run").args(target).args(allow).args(only).output().unwrap()
}

/// A value that a file names: the entry of the file, the value as the log names it, and the cases that
/// write such values.
struct Named {
    table: &'static str,
    log: &'static str,
    cases: &'static [&'static str],
}

const VARIABLE: Named = Named {
    table: "[[variable]]\nchannel = 1\nname = \"V.E.Variable_1\"\n",
    log: "variable channel=1 name=V.E.Variable_1",
    cases: &["write-by-handle", "write-by-name"],
};
const ARRAY: Named = Named {
    table: "[[variable]]\nchannel = 1\nname = \"V.E.test\"\n",
    log: "variable channel=1 name=V.E.test",
    cases: &["write-by-handle", "write-elements-by-handle"],
};
const OBJECT: Named = Named {
    table: "[[object]]\nchannel = 1\nname = \"example_subroutine_w\"\n",
    log: "content name=example_subroutine_w owner=Channel(0)",
    cases: &["write-objects", "write-objects-by-index"],
};

impl Named {
    fn plan(&self) -> Vec<Case> {
        plan(self.cases)
    }
}

fn plan(cases: &[&str]) -> Vec<Case> {
    let only = cases.iter().map(|case| (*case).to_owned()).collect();
    Selection { only, ..Selection::default() }.plan(suite::cases(), 1).unwrap().cases
}

/// The writes in the log of a simulated CNC in this process with this defect.
fn written(
    model: Model,
    defect: Option<&SeededDefect>,
    table: &str,
    profile: Profile,
    cases: Vec<Case>,
) -> BTreeSet<String> {
    let lines = MemoryFile::default();
    let writer = lines.clone();
    // The writes are in the log of the simulated CNC; the log of the client would be most of the
    // work.
    let simulator = Targets::new().with_target("ads_cnc_conformance::simulator", Level::DEBUG);
    let lines_of_log = fmt::layer().with_ansi(false).with_writer(move || writer.clone());
    let log = tracing_subscriber::registry().with(lines_of_log).with(simulator);
    tracing::subscriber::with_default(log, || {
        let cnc = Cnc::new(model).with_stopped_clock();
        let cnc = Arc::new(Faulty::new(cnc, defect));
        let allowed = Allowed::from_toml(&format!("{HEAD}{table}")).unwrap();
        let gate = Gate::queries().with_allowed(Some(allowed));
        let target = Target::local(SocketAddr::from(([127, 0, 0, 1], 0)), NET_ID);
        let client = Client::in_process(target, gate, LocalCnc::new(cnc, NET_ID)).unwrap();
        let mut session = suite::TargetState::new(client, profile);
        suite::run(cases, Some(&mut session), None, 1);
    });
    let lines = String::from_utf8(lines.0.lock().unwrap().clone()).unwrap();
    lines.lines().filter_map(|line| Some(line.split_once("write to a ")?.1.to_owned())).collect()
}

/// The only defects that write values that the file does not name. With them, the CNC returns
/// correct handles and addresses, but decodes the handle, name or address of an allowed write as
/// another one.
const MISREAD: [&str; 3] = [
    "variable-handle-write.handle.flip",
    "write-request.data.flip",
    "write-request.index_offset.flip",
];

/// Tries every defect of a CNC with a simulated CNC in this process.
#[test]
fn defects_of_the_cnc_write_nothing_else() {
    let defects: Vec<_> = faults::all().iter().filter(|defect| defect.is_for_cnc()).collect();
    assert!(defects.len() > 900, "{}", defects.len());
    let model = Model::default_model().unwrap();
    let values = [VARIABLE, ARRAY, OBJECT].map(|named| (named.plan(), named));
    let queue = Mutex::new(defects.into_iter());
    let found = Mutex::new((BTreeMap::new(), 0));
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().next();
                    let Some(defect) = next else { break };
                    for (plan, named) in &values {
                        let (model, plan) = (model.clone(), plan.clone());
                        let mut writes =
                            written(model, Some(defect), named.table, Profile::DEVICE, plan);
                        let is_written = writes.remove(named.log);
                        let mut found = found.lock().unwrap();
                        found.1 += usize::from(is_written);
                        if !writes.is_empty() {
                            found.0.insert(defect.id.as_str(), writes);
                        }
                    }
                }
            });
        }
    });
    let (others, written) = found.into_inner().unwrap();
    assert_eq!(others.keys().copied().collect::<Vec<_>>(), MISREAD, "{others:#?}");
    assert!(written > 3000, "{written}");
}

/// The names of the variables that these cases write, if a file allows the variables below and the
/// profile excludes `unwritten`.
fn written_with(unwritten: &[&'static str], cases: &[&str]) -> BTreeSet<String> {
    let names =
        ["V.E.Variable_1", "V.E.texts", "V.E.test", "V.G.SERVICE.UUID", "V.G.SERVICE.REQUEST"];
    let entry = |name| format!("[[variable]]\nchannel = 1\nname = \"{name}\"\n");
    let mut table: String = names.into_iter().map(entry).collect();
    table += "[[variable]]\nchannel = 1\naxis = 1\nname = \"V.A.WCS\"\n[[service]]\nchannel = 1\n";
    let unwritten = unwritten.iter().map(|&name| Cow::Borrowed(name)).collect();
    let profile = Profile { unwritten: Cow::Owned(unwritten), ..Profile::DEVICE };
    let lines = written(Model::default_model().unwrap(), None, &table, profile, plan(cases));
    lines.iter().map(|line| line.split_once("name=").unwrap().1.to_owned()).collect()
}

/// The suite writes arrays of texts only element by element.
#[test]
fn arrays_of_texts_are_not_written_as_a_whole() {
    let whole = written_with(&[], &["write-by-handle", "write-by-name", "ads-write"]);
    assert_eq!(whole, ["V.E.Variable_1", "V.E.test"].map(str::to_owned).into());
    assert!(written_with(&[], &["write-elements-by-name"]).contains("V.E.texts"));
}

/// The suite writes no value that the profile excludes: elements, arrays with an excluded element,
/// variables of the axis interface and of the Service Interface.
#[test]
fn values_that_the_profile_excludes_are_not_written() {
    let cases = [
        "write-by-handle",
        "write-by-name",
        "ads-write",
        "write-axis-variable",
        "write-elements-by-name",
        "service-request",
        "service-response",
    ];
    let all = written_with(&[], &cases);
    for name in ["V.E.texts", "V.A.WCS.X", "V.G.SERVICE.REQUEST", "V.G.SERVICE.RESPONSE"] {
        assert!(all.contains(name), "{all:?}");
    }
    let unwritten =
        ["V.E.texts", "V.E.test[0]", "V.A.WCS.X", "V.G.SERVICE.REQUEST", "V.G.SERVICE.RESPONSE"];
    let only = ["V.E.Variable_1".to_owned()].into();
    assert_eq!(written_with(&unwritten, &cases[..4]), only);
    assert_eq!(written_with(&unwritten, &cases[5..]), BTreeSet::new());
    assert_eq!(written_with(&["V.E.texts", "V.E.test"], &cases[4..5]), BTreeSet::new());
}

/// Tries some of the defects with the command over TCP.
#[test]
fn the_command_writes_nothing_else() {
    for (defect, named) in [
        ("variable-handle.handle.flip", &VARIABLE),
        ("variable-handle.handle.invert", &ARRAY),
        ("object-descriptor.index_offset.flip", &OBJECT),
        ("object-descriptor.index_group.flip", &OBJECT),
        (MISREAD[0], &VARIABLE),
    ] {
        let cnc = Logged::start(&["--defect", defect]);
        let file = TestFile::allowing(named.table);
        let output = run(&cnc.serve.addr, &file, named.cases);
        // A CNC that executes writes wrongly may leave values changed: exit code 6.
        assert!(matches!(output.status.code(), Some(0..=4 | 6)), "{defect}: {output:?}");
        let mut writes = cnc.end();
        writes.remove(named.log);
        if defect == MISREAD[0] {
            let other = writes.remove("variable channel=1 name=V.E.Variable_2");
            assert!(other.is_some_and(|count| count < 3), "{other:?}");
        }
        assert_eq!(writes, BTreeMap::new(), "{defect}");
    }
}

/// Starts a proxy that serves one connection after the other. It forwards each reply of the CNC
/// after `change` has changed it, and closes the connection after a reply for which `change` returns
/// false. Returns its address.
fn lying(cnc: &str, mut change: impl FnMut(&[u8], &mut [u8]) -> bool + Send + 'static) -> String {
    let forward = move |mut client: &TcpStream, mut cnc: &TcpStream| loop {
        let request = frame(client)?;
        cnc.write_all(&request)?;
        let mut reply = frame(cnc)?;
        let continues = change(&request, &mut reply);
        client.write_all(&reply)?;
        if !continues {
            return Ok(());
        }
    };
    proxy_by(cnc.parse().unwrap(), forward).to_string()
}

/// The offset of the data in a reply frame, after the headers, the result and the length.
const DATA: usize = 46;

fn is_asked(request: &[u8], group: u32, offset: u32) -> bool {
    request.len() >= 46 && (number(request, 38), number(request, 42)) == (group, offset)
}

fn put(reply: &mut [u8], at: usize, value: u32) {
    if let Some(four) = reply.get_mut(at..at + 4) {
        four.copy_from_slice(&value.to_le_bytes());
    }
}

/// Changes the list of objects: example_subroutine_w has the address of mc_command_single_block_w.
fn shares_an_address(request: &[u8], reply: &mut [u8]) -> bool {
    if request.len() >= 42 && number(request, 38) & !0x10_0000 == 0x3_0101 {
        let objects = reply.get_mut(DATA..).unwrap_or_default().chunks_exact_mut(84);
        for object in objects.filter(|one| one[20..].starts_with(b"example_subroutine_w\0")) {
            put(object, 16, 1);
        }
    }
    true
}

/// The handle of V.E.Testvar in the simulated CNC.
fn handle_of_another(cnc: &str) -> u32 {
    let target = ["--target", cnc, "--net-id", "127.0.0.1.1.1"];
    let get = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
        .args(["get", "V.E.Testvar"])
        .args(target)
        .output()
        .unwrap();
    let shown = String::from_utf8(get.stdout).unwrap();
    let (_, handle) = shown.lines().next().unwrap().rsplit_once("handle 0x").unwrap();
    u32::from_str_radix(handle, 16).unwrap()
}

const OTHER: u32 = 0x4040_0003;

/// The device returns the handle of another variable: for all names, for one name, and for one name also
/// in its description by name. The gate rejects the write by handle.
#[test]
fn a_handle_of_another_variable_is_not_written() {
    for (offsets, name) in
        [(&[0x46][..], &b""[..]), (&[0x46], b"V.E.test\0"), (&[0x46, 0x4C], b"V.E.test\0")]
    {
        let change = move |request: &[u8], reply: &mut [u8]| {
            let by_name = offsets.iter().any(|&offset| is_asked(request, 0x12_2301, offset));
            if by_name && request.ends_with(name) {
                put(reply, DATA, OTHER);
            }
            true
        };
        let cnc = Logged::start(&[]);
        assert_eq!(handle_of_another(&cnc.serve.addr), OTHER);
        let addr = lying(&cnc.serve.addr, change);
        let file = TestFile::allowing(ARRAY.table);
        let output = run(&addr, &file, &["write-by-handle", "write-elements-by-handle"]);
        let shown = String::from_utf8(output.stdout).unwrap();
        // The gate rejects the write for safety; no requirement fails.
        assert_eq!(output.status.code(), Some(4), "{shown}");
        assert!(shown.contains("the device also uses it for "), "{shown}");
        assert!(!shown.contains("FAIL"), "{shown}");
        assert_eq!(cnc.end(), BTreeMap::new());

        // The file still allows the write by name.
        let cnc = Logged::start(&[]);
        let addr = lying(&cnc.serve.addr, change);
        run(&addr, &file, &["write-by-name"]);
        let mut writes = cnc.end();
        assert!(writes.remove(ARRAY.log).is_some_and(|count| count > 2), "{writes:?}");
        assert_eq!(writes, BTreeMap::new());
    }
}

/// After a lost connection, the run confirms the handle on the new connection before it restores the
/// value.
#[test]
fn a_lost_connection_leaves_nothing_changed() {
    let cnc = Logged::start(&[]);
    let mut writes = 0;
    let addr = lying(&cnc.serve.addr, move |request, _| {
        let is_write = is_asked(request, 0x12_2301, 0x49);
        writes += u32::from(is_write);
        // The second write writes another value.
        !(is_write && writes == 2)
    });
    let before = cnc.value();
    let file = TestFile::allowing(VARIABLE.table);
    let output = run(&addr, &file, &["write-by-handle"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(!before.is_empty() && cnc.value() == before);
    assert_eq!(cnc.end(), BTreeMap::from([(VARIABLE.log.to_owned(), 3)]));
}

/// After a lost connection, and after an error of a router, the handle belongs to another variable that has
/// the original value: the run restores the value by its name.
#[test]
fn a_reassigned_handle_is_not_used_to_restore() {
    for is_router in [false, true] {
        let cnc = Logged::start(&[]);
        let (mut writes, mut is_lost, mut original) = (0, false, None::<Vec<u8>>);
        let addr = lying(&cnc.serve.addr, move |request, reply| {
            if is_asked(request, 0x12_2301, 0x47) {
                let value = &mut reply[DATA..];
                match &original {
                    Some(original) if is_lost => value.copy_from_slice(original),
                    None => original = Some(value.to_vec()),
                    _ => {}
                }
            }
            if is_lost && [0x46, 0x4C].iter().any(|&at| is_asked(request, 0x12_2301, at)) {
                put(reply, DATA, OTHER);
            }
            let is_write = is_asked(request, 0x12_2301, 0x49);
            writes += u32::from(is_write);
            // The second write writes another value.
            if is_write && writes == 2 {
                is_lost = true;
                // The error of the AMS header.
                put(reply, 30, 7);
                return is_router;
            }
            true
        });
        let before = cnc.value();
        let file = TestFile::allowing(VARIABLE.table);
        let output = run(&addr, &file, &["write-by-handle"]);
        assert!(!before.is_empty() && cnc.value() == before, "{is_router}: {output:?}");
        assert_eq!(cnc.end(), BTreeMap::from([(VARIABLE.log.to_owned(), 3)]), "{is_router}");
    }
}

/// After a lost connection, the list gives the changed object the address of another one: the run
/// does not restore the value, and the last line of stderr contains the reason.
#[test]
fn a_value_that_is_not_restored_has_a_reason() {
    let cnc = Logged::start(&[]);
    let (mut writes, mut is_lost) = (0, false);
    let addr = lying(&cnc.serve.addr, move |request, reply| {
        if is_lost {
            return shares_an_address(request, reply);
        }
        writes += u32::from(number(request, 22) & 0xFFFF == 3);
        // The second write writes another value.
        is_lost = writes == 2;
        !is_lost
    });
    let file = TestFile::allowing(OBJECT.table);
    let output = run(&addr, &file, &["write-objects"]);
    assert_eq!(output.status.code(), Some(6), "{output:?}");
    let stderr_text = String::from_utf8(output.stderr).unwrap();
    let last = stderr_text.lines().last().unwrap();
    assert!(last.contains("LEFT CHANGED: "), "{stderr_text}");
    let why = "no entry in the file of --allow-write allows it)";
    assert!(last.contains("(not restored: ") && last.ends_with(why), "{stderr_text}");
}

/// A list contains two objects with the same address: a write of an object that the file names is
/// rejected.
#[test]
fn an_address_of_two_objects_is_not_written() {
    let cnc = Logged::start(&[]);
    let addr = lying(&cnc.serve.addr, shares_an_address);
    let file = TestFile::allowing(OBJECT.table);
    let output = run(&addr, &file, OBJECT.cases);
    let shown = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(4), "{shown}");
    assert!(shown.contains("the device also uses it for mc_command_single_block_w"), "{shown}");
    let set = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
        .args(["set", "example_subroutine_w", "TRUE", "--target", &addr])
        .args(["--net-id", "127.0.0.1.1.1", "--allow-write", file.path()])
        .output()
        .unwrap();
    let why = String::from_utf8(set.stderr).unwrap();
    assert_eq!(set.status.code(), Some(4), "{why}");
    assert!(why.contains("mc_command_single_block_w"), "{why}");
    assert_eq!(cnc.end(), BTreeMap::new());
}
