//! The examples of the codec run against the simulated CNC.

mod common;

use std::io::Read as _;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use std::{env, thread};

use ads::{AmsAddr, Client, Device, Source, Timeouts};
use common::Serve;
use common::file::TestFile;

/// Time limit for an example to end, and for a response of its service, without the time of the
/// build.
const TIME: Duration = Duration::from_secs(60);

/// Builds the examples; cargo does nothing if they are up to date.
fn built() -> &'static [PathBuf] {
    static BUILT: OnceLock<Vec<PathBuf>> = OnceLock::new();
    BUILT.get_or_init(|| {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        // This program is in the folder target/debug/deps or target/release/deps.
        let program = env::current_exe().unwrap();
        let is_debug = program.ancestors().nth(2).is_some_and(|folder| folder.ends_with("debug"));
        let profile = if is_debug { "dev" } else { "release" };
        let build = Command::new(cargo)
            .args(["build", "--workspace", "--examples", "--message-format=json"])
            .args(["--profile", profile])
            .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(build.status.success(), "{}", String::from_utf8_lossy(&build.stderr));
        let messages = String::from_utf8(build.stdout).unwrap();
        let executable = |line: &str| {
            let message: serde_json::Value = serde_json::from_str(line).ok()?;
            let example = message["target"]["kind"][0] == "example";
            example.then(|| Some(PathBuf::from(message["executable"].as_str()?))).flatten()
        };
        messages.lines().filter_map(executable).collect()
    })
}

/// A running example that is ended when this value is dropped.
struct Example(Child);

impl Example {
    fn start(name: &str, serve: &Serve, arguments: &[&str]) -> Self {
        let named = |path: &&PathBuf| path.file_stem().is_some_and(|stem| stem == name);
        let example = Command::new(built().iter().find(named).unwrap())
            .args([&serve.addr, &serve.net_id])
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        Self(example.unwrap())
    }

    /// Waits until the example ends successfully, and returns its stdout.
    fn output(self) -> String {
        let (is_success, out, errors) = self.ended();
        assert!(is_success, "{errors}");
        out
    }

    /// Waits until the example ends with a failure, and returns its stderr.
    fn failure(self) -> String {
        let (is_success, out, errors) = self.ended();
        assert!(!is_success, "{out}");
        errors
    }

    fn ended(mut self) -> (bool, String, String) {
        // Reads stdout while the example runs, because a full pipe would block the example.
        let mut out = self.0.stdout.take().unwrap();
        let reader = thread::spawn(move || {
            let mut text = String::new();
            out.read_to_string(&mut text).map(|_| text)
        });
        let end = Instant::now() + TIME;
        let status = loop {
            match self.0.try_wait().unwrap() {
                Some(status) => break status,
                None if Instant::now() > end => panic!("it runs for {TIME:?}"),
                None => thread::sleep(Duration::from_millis(10)),
            }
        };
        let mut errors = String::new();
        self.0.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
        (status.success(), reader.join().unwrap().unwrap(), errors)
    }
}

impl Drop for Example {
    fn drop(&mut self) {
        // `kill` fails if the process has already ended.
        let _ended = self.0.kill().and_then(|()| self.0.wait());
    }
}

#[test]
fn list_objects() {
    let serve = Serve::start(&[]);
    let list = Example::start("list_objects", &serve, &[]).output();
    for object in [
        "0x120101 0x3 mc_active_single_block_r BOOL 1",
        "0x120101 0x1 mc_command_single_block_w BOOL 1",
        "0x120100 0x251 example_platform_cycle_time_r DWORD 4",
        "0x120200 0x50001 example_position_r LREAL 8",
        "0x123301 0x1 feedhold.enable BOOLEAN 1 -",
        "0x123300 0x5002 example.temperature SGN08 1 \u{b0}C",
        "0x122306 0x30001 example.programmed REAL64 8 mm",
        "0x25301 0x1 example.speed REAL64 8 1/min",
    ] {
        let listed = |line: &str| line.split_whitespace().eq(object.split(' '));
        assert!(list.lines().any(listed), "{object}\n{list}");
    }
}

/// VAR-5: the example formats each element with the type from the description.
#[test]
fn read_variable() {
    let serve = Serve::start(&[]);
    for (name, printed) in [
        ("V.E.Testvar", "SGN32[5]\n  123\n  234\n  345\n  456\n  567\n"),
        ("V.E.matrix[1][2]", "SGN16\n  23\n"),
        ("V.A.WCS.Y", "REAL64\n  1234.2\n"),
    ] {
        let read = Example::start("read_variable", &serve, &["1", name]).output();
        assert_eq!(read, format!("{name}: {printed}"));
    }
    // This CNC has no description by name, so the example searches the variables of the kind.
    let older = Serve::start(&["--cnc-version", "V4.20.0"]);
    let read = Example::start("read_variable", &older, &["1", "V.G.NP[1].V[2]"]).output();
    assert_eq!(read, "V.G.NP[1].V[2]: REAL64\n  6\n");
}

/// STM-3, STM-6: the program does not fit into the streaming interface, so the example must wait and
/// send packets again.
#[test]
fn stream_program() {
    let serve = Serve::start(&["--pace", "200"]);
    let lines = (1..300).map(|line| format!("N{line}0 G1 X{line} Y-{line}\n"));
    let program =
        TestFile::new(".nc", lines.chain(["M30\n".to_owned()]).collect::<String>().as_bytes());
    let sent = Example::start("stream_program", &serve, &["1", program.path()]).output();
    assert!(sent.starts_with("300 lines sent in "), "{sent}");
    let loops = TestFile::new(".nc", b"N10 $FOR P1=0,10,1\nN20 $ENDFOR\n");
    let errors = Example::start("stream_program", &serve, &["1", loops.path()]).failure();
    assert!(errors.starts_with("line 1, column 5: $FOR in a stream (STM-8)\n"), "{errors}");
}

/// SVC-9: the response for 3 is 1.732051; for a number without a square root, it is an error.
#[test]
fn square_root_service() {
    let serve = Serve::start(&[]);
    let service = Example::start("square_root_service", &serve, &["1", "2"]);
    let timeouts = Timeouts::new(Duration::from_secs(5));
    let client = Client::new(&*serve.addr, timeouts, Source::Auto).unwrap();
    let sda = client.device(AmsAddr::new(serve.net_id.parse().unwrap(), 552));
    for (request, response, state) in [
        ("3", "1.732051", 1),
        ("-4", "ERROR: cannot calc square root of negative number -4.000000", 99),
    ] {
        write(sda, "UUID", b"560aacbf-6335-44a9-895a-8b27f3ed5e47\0");
        write(sda, "REQUEST", format!("{request}\0").as_bytes());
        write(sda, "REQUEST_STATE", &[1, 0, 0, 0]);
        let end = Instant::now() + TIME;
        while read(sda, "RESPONSE_STATE") == [0; 4] {
            assert!(Instant::now() < end, "no response");
            thread::sleep(Duration::from_millis(10));
        }
        assert_eq!(read(sda, "RESPONSE_STATE"), [state, 0, 0, 0]);
        assert_eq!(read(sda, "REQUEST_STATE"), [0; 4]);
        let text = read(sda, "RESPONSE");
        let end = text.iter().position(|&byte| byte == 0).unwrap();
        assert_eq!(String::from_utf8_lossy(&text[..end]), response);
    }
    let shown = service.output();
    assert!(shown.starts_with("3 -> 1.732051, state 1\n"), "{shown}");
}

fn write(sda: Device<'_>, name: &str, value: &[u8]) {
    let request = [b"V.G.SERVICE.", name.as_bytes(), b"\0", value].concat();
    sda.write(0x12_2301, 0x4A, &request).unwrap();
}

fn read(sda: Device<'_>, name: &str) -> Vec<u8> {
    let mut reply = vec![0; 2048];
    let name = format!("V.G.SERVICE.{name}\0");
    let length = sda.write_read(0x12_2301, 0x48, name.as_bytes(), &mut reply).unwrap();
    reply.truncate(length);
    reply
}
