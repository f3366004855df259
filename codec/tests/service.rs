//! The Service Interface: the examples of the manuals, the order of what is written, the limits,
//! and what happens when something goes wrong.

mod common;

use std::time::Duration;

use ads_cnc::ErrorKind::{self, *};
use ads_cnc::layout::Stream;
use ads_cnc::service::ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
use ads_cnc::service::*;
use ads_cnc::{CncStr, VariablePath};
use common::Fault;

const ROOT: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";
const COMMAND: &str = "19719079-BA06-4740-BC02-DE5215211751";

fn id(text: &str) -> ServiceId {
    ServiceId::new(text).unwrap()
}

fn text(text: &str) -> CncStr<'_> {
    CncStr::new(text).unwrap()
}

fn millis(millis: u64) -> Duration {
    Duration::from_millis(millis)
}

fn fault(kind: ErrorKind, field: &'static str, offset: usize, numbers: (usize, usize)) -> Fault {
    Fault { kind, field, offset, expected: numbers.0, found: numbers.1 }
}

/// The example's service, which the manuals have in C.
fn square_root(request: &str) -> (String, u32) {
    let x: f64 = request.parse().unwrap_or(0.0);
    if x >= 0.0 {
        return (format!("{:.6}", x.sqrt()), 1);
    }
    (format!("ERROR: cannot calc square root of negative number {x:.6}"), 99)
}

/// The interface of a channel, with a record of what was written to it.
#[derive(Default)]
struct Channel {
    interface: Interface,
    written: Vec<(ServiceVariable, Vec<u8>)>,
}

impl Channel {
    fn with(clears: Clears) -> Self {
        Self { interface: Interface::with(clears), written: Vec::new() }
    }

    fn write(&mut self, variable: ServiceVariable, value: &[u8]) {
        self.interface.write(variable, value).unwrap();
        self.written.push((variable, value.to_vec()));
    }

    /// One request, as a program writes it.
    fn ask(&mut self, uuid: &str, request: &str) {
        self.write(Uuid, format!("{uuid}\0").as_bytes());
        self.write(Request, format!("{request}\0").as_bytes());
        self.write(RequestState, &[1, 0, 0, 0]);
        self.written.clear();
    }

    /// Does a step that is no service, and says what it was.
    fn step(&mut self, host: &mut Host<'_>) -> Did {
        match host.step() {
            HostStep::Read(variable) => {
                host.read(self.interface.read(variable)).unwrap();
                Did::Read(variable)
            }
            HostStep::Write(variable, value) => {
                self.write(variable, value);
                host.written();
                Did::Write(variable)
            }
            HostStep::Serve { .. } => Did::Serve,
            HostStep::Wait => {
                host.poll();
                Did::Wait
            }
        }
    }

    /// Steps until one is not a read.
    fn skip_reads(&mut self, host: &mut Host<'_>) -> Did {
        for _ in 0..50 {
            match host.step() {
                HostStep::Read(_) => self.step(host),
                HostStep::Write(variable, _) => return Did::Write(variable),
                HostStep::Serve { .. } => return Did::Serve,
                HostStep::Wait => return Did::Wait,
            };
        }
        panic!("reads and reads: {:?}", host.step());
    }

    /// Steps until this is to be written.
    fn reach(&mut self, host: &mut Host<'_>, variable: ServiceVariable) {
        let there = (0..50).any(|_| {
            let there = self.skip_reads(host) == Did::Write(variable);
            if !there {
                self.step(host);
            }
            there
        });
        assert!(there, "{variable} is not written: {:?}", host.step());
    }

    /// Steps until there is nothing to do.
    fn rest(&mut self, host: &mut Host<'_>) {
        assert!((0..50).any(|_| self.step(host) == Did::Wait), "{:?}", host.step());
    }

    /// Looks for a request, serves it, and goes on to the next wait; says whether there was one.
    fn serve(&mut self, host: &mut Host<'_>, service: impl Fn(&str) -> (String, u32)) -> bool {
        host.poll();
        if self.skip_reads(host) != Did::Serve {
            return false;
        }
        let HostStep::Serve { request, .. } = host.step() else { unreachable!() };
        let (response, state) = service(&request.to_string());
        host.answer(text(&response), state).unwrap();
        self.rest(host);
        true
    }

    /// Steps of the program that are no waits; says how it ended, if it did.
    fn run(&mut self, call: &mut Call, now: Duration) -> Option<Result<(u32, String), ()>> {
        call.poll();
        loop {
            match call.step() {
                CallStep::Read(variable) => call.read(self.interface.read(variable), now).unwrap(),
                CallStep::Write(variable, value) => {
                    self.write(variable, value);
                    call.written(now);
                }
                CallStep::Wait { .. } => return None,
                CallStep::Done { state, response } => {
                    return Some(Ok((state, response.to_string())));
                }
                CallStep::TimedOut => return Some(Err(())),
            }
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Did {
    Read(ServiceVariable),
    Write(ServiceVariable),
    Serve,
    Wait,
}

fn call(uuid: &str, request: &str, parameters: [Option<u32>; 3]) -> Call {
    let [p1, p2, p3] = parameters;
    let wait = SysServiceWait::from_parameters(p1, p2, p3).unwrap();
    Call::new(id(uuid), text(request), wait).unwrap()
}

/// SVC-1: the names, which are well-formed, and the types.
#[test]
fn the_five_variables() {
    let names = ServiceVariable::ALL.map(ServiceVariable::name);
    assert_eq!(
        names,
        [
            "V.G.SERVICE.UUID",
            "V.G.SERVICE.REQUEST",
            "V.G.SERVICE.REQUEST_STATE",
            "V.G.SERVICE.RESPONSE_STATE",
            "V.G.SERVICE.RESPONSE"
        ]
    );
    let interface = Interface::new();
    for variable in ServiceVariable::ALL {
        assert_eq!(ServiceVariable::by_name(variable.name()), Some(variable));
        assert_eq!(VariablePath::new(variable.name()).unwrap().parts().count(), 2);
        let size = variable.var_type().element_size();
        assert_eq!(interface.read(variable).len(), size.unwrap_or(1) as usize, "{variable}");
    }
    assert_eq!(ServiceVariable::by_name("V.G.SERVICE"), None);
}

/// SVC-9: the square root of 3, and of a negative number, whenever the interface clears
/// REQUEST_STATE; and the order of what is written (SVC-4, SVC-5).
#[test]
fn square_root_example() {
    for (request, response, state) in [
        ("3", "1.732051", 1),
        ("-3", "ERROR: cannot calc square root of negative number -3.000000", 99),
    ] {
        for clears in [Clears::OnResponseState, Clears::Never] {
            let mut channel = Channel::with(clears);
            let ids = [id(ROOT)];
            let mut host = Host::new(&ids);
            assert!(!channel.serve(&mut host, square_root));

            let mut program = call(ROOT, request, [None; 3]);
            assert_eq!(channel.run(&mut program, millis(0)), None);
            assert!(channel.serve(&mut host, square_root));
            assert_eq!(host.outcome(), Some(Outcome::Answered));
            let answer = Some(Ok((state, response.to_string())));
            assert_eq!(channel.run(&mut program, millis(10)), answer);

            let zero_ended = |text: &str| format!("{text}\0").into_bytes();
            assert_eq!(
                channel.written,
                [
                    (Uuid, zero_ended(ROOT)),
                    (Request, zero_ended(request)),
                    (RequestState, vec![1, 0, 0, 0]),
                    (Response, zero_ended(response)),
                    (RequestState, vec![0, 0, 0, 0]),
                    (ResponseState, state.to_le_bytes().to_vec()),
                ]
            );
            // It is answered once.
            assert!(!channel.serve(&mut host, square_root));
        }
    }
}

/// E-21: with a digit too few, as the NC program of the example has it, nobody is asked.
#[test]
fn the_uuid_of_the_example_with_a_digit_too_few() {
    const SHORT: &str = "560AACBF-6335-44a9-895A-B27F3ED5E47";
    assert_eq!(
        Fault::of(ServiceId::new(SHORT).unwrap_err()),
        fault(Truncated, "uuid", 0, (36, 35))
    );
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.ask(SHORT, "3");
    assert!(!channel.serve(&mut host, square_root));
    channel.ask(ROOT, "3");
    assert!(channel.serve(&mut host, square_root));
}

#[test]
fn uuids() {
    let refused = |text| {
        let error = ServiceId::new(text).unwrap_err();
        assert_eq!(error.field().stream(), Stream::Service);
        assert_eq!(ServiceId::from_text(CncStr::new(text).unwrap()), Err(error));
        Fault::of(error)
    };
    let unexpected =
        |at, character: char| fault(Unexpected, "uuid", at, (0, u32::from(character) as usize));
    assert_eq!(refused(""), fault(Truncated, "uuid", 0, (36, 0)));
    assert_eq!(refused("560AACBF-6335-44a9-895A-8B27F3ED5E470"), {
        fault(Trailing, "uuid", 36, (36, 37))
    });
    assert_eq!(refused("560AACBF-6335-44a9-895A-B27F3ED5SE47"), unexpected(32, 'S'));
    assert_eq!(refused("560AACBF06335-44a9-895A-8B27F3ED5E47"), unexpected(8, '0'));
    assert_eq!(refused("560AACBF-6335-44a9-895A--B27F3ED5E47"), unexpected(24, '-'));
    assert_eq!(refused("560AACBF-6335-44ä9-895A-8B27F3ED5E47"), unexpected(16, 'ä'));

    // SVC-7: no regard to case, and yet as it was written.
    let (upper, lower) = (ROOT.to_uppercase(), ROOT.to_lowercase());
    assert_eq!(id(&upper), id(&lower));
    assert_eq!(std::collections::HashSet::from([id(&upper), id(&lower)]).len(), 1);
    assert_eq!((id(ROOT).to_string(), id(ROOT).text()), (ROOT.to_string(), text(ROOT)));
    assert_ne!(id(ROOT), id(COMMAND));
    assert_eq!(ROOT.parse(), Ok(id(ROOT)));
    let mut channel = Channel::default();
    let ids = [id(&upper)];
    let mut host = Host::new(&ids);
    channel.ask(&lower, "3");
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    let HostStep::Serve { uuid, request, request_state } = host.step() else { unreachable!() };
    assert_eq!((uuid.to_string(), request, request_state), (upper, text("3"), 1));
}

/// SVC-8: the example of the cycle, which waits for 5 seconds at most.
#[test]
fn sys_service_wait_example() {
    let program = || call(COMMAND, "some-command", [None, Some(5000), Some(1)]);
    let ids = [id(COMMAND)];
    let service = |request: &str| (format!("did {request}"), 7);
    let answer = Some(Ok((7, "did some-command".to_string())));
    let start = millis(1_000_000);

    // In time, and with the last look.
    for (answered, looked) in [(1, 2), (4999, 5000), (5000, 5000), (5000, 9000)] {
        let (mut channel, mut program) = (Channel::default(), program());
        assert_eq!(channel.run(&mut program, start), None);
        assert_eq!(program.step(), CallStep::Wait { until: Some(start + millis(5000)) });
        assert_eq!(channel.run(&mut program, start + millis(answered - 1)), None);
        assert!(channel.serve(&mut Host::new(&ids), service));
        assert_eq!(channel.run(&mut program, start + millis(looked)), answer, "{looked}");
    }

    // Not in time.
    let (mut channel, mut program) = (Channel::default(), program());
    assert_eq!(channel.run(&mut program, start), None);
    assert_eq!(channel.run(&mut program, start + millis(4999)), None);
    assert_eq!(channel.run(&mut program, start + millis(5000)), Some(Err(())));
    assert!(channel.serve(&mut Host::new(&ids), service));
    assert_eq!(channel.run(&mut program, start + millis(5001)), Some(Err(())));
}

/// SVC-8: which parameters there are, and what they are without a value.
#[test]
fn parameters_of_the_cycle() {
    let wait = SysServiceWait::from_parameters;
    assert_eq!(wait(None, None, None), Ok(SysServiceWait::default()));
    assert_eq!(wait(Some(0), None, Some(3)), Ok(SysServiceWait::default()));
    assert_eq!(
        wait(Some(4), Some(5000), Some(1)),
        Ok(SysServiceWait {
            keep_waiting: 4,
            longest: Some(LongestWait { time: Duration::from_secs(5), timer: 1 })
        })
    );
    for p1 in [None, Some(1)] {
        let error = wait(p1, Some(0), None).unwrap_err();
        assert_eq!(error.field().stream(), Stream::SysServiceWait);
        assert_eq!(Fault::of(error), fault(Missing, "@P3", 8, (0, 0)));
    }

    // A longest wait of 0 looks once; one to the end of time ends.
    let mut channel = Channel::default();
    let mut program = call(COMMAND, "", [None, Some(0), Some(1)]);
    assert_eq!(channel.run(&mut program, millis(9)), Some(Err(())));
    let longest = wait(None, Some(u32::MAX), Some(1)).unwrap();
    let waiting = longest.start(Duration::MAX - millis(1));
    assert_eq!(waiting.step(), WaitStep::Read(ResponseState));
    let mut waiting = longest.start(Duration::MAX - millis(1));
    waiting.read(&[0; 4], millis(2)).unwrap();
    assert_eq!(waiting.step(), WaitStep::Wait { until: Some(Duration::MAX) });
}

/// SVC-8 and SVC-3: as a request sets RESPONSE_STATE to 0, another @P1 than 0 does not wait for the
/// service; it does if the service has set that state in the meantime.
#[test]
fn a_keep_waiting_code_other_than_0() {
    let mut channel = Channel::default();
    channel.interface.write(ResponseState, &[5, 0, 0, 0]).unwrap();
    let mut program = call(ROOT, "3", [Some(5), None, None]);
    assert_eq!(channel.run(&mut program, millis(0)), Some(Ok((0, String::new()))));

    let wait = SysServiceWait::from_parameters(Some(5), None, None).unwrap();
    let mut waiting = wait.start(millis(0));
    waiting.read(&[5, 0, 0, 0], millis(0)).unwrap();
    assert_eq!(waiting.step(), WaitStep::Wait { until: None });
    waiting.poll();
    waiting.read(&[6, 0, 0, 0], millis(0)).unwrap();
    assert_eq!(waiting.step(), WaitStep::Done { state: 6 });
}

/// SVC-6, E-20: the program waits for RESPONSE_STATE; a response without it ends no wait.
#[test]
fn a_response_alone_ends_no_wait() {
    let mut channel = Channel::default();
    let mut program = call(ROOT, "3", [None; 3]);
    assert_eq!(channel.run(&mut program, millis(0)), None);
    channel.write(Response, b"1.732051\0");
    assert_eq!(channel.run(&mut program, millis(1)), None);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    assert_eq!(channel.run(&mut program, millis(2)), Some(Ok((1, "1.732051".to_string()))));
}

/// SVC-2: without REQUEST_STATE nothing is served; any value but 0 is a request, and the service
/// is told which.
#[test]
fn only_a_request_state_starts_a_service() {
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.write(Uuid, format!("{ROOT}\0").as_bytes());
    channel.write(Request, b"3\0");
    assert!(!channel.serve(&mut host, square_root));
    for state in [1_u32, 0x100, u32::MAX] {
        channel.write(RequestState, &state.to_le_bytes());
        assert_eq!(channel.skip_reads(&mut host), Did::Wait);
        host.poll();
        assert_eq!(channel.skip_reads(&mut host), Did::Serve);
        let HostStep::Serve { request_state, .. } = host.step() else { unreachable!() };
        assert_eq!(request_state, state);
        host.answer(text("x"), 1).unwrap();
        channel.rest(&mut host);
        assert_eq!(channel.skip_reads(&mut host), Did::Wait);
    }
    let zero = Call::with_state(id(ROOT), text("3"), 0, SysServiceWait::default()).unwrap_err();
    assert_eq!(Fault::of(zero), fault(OutOfRange, "request_state", 0, (1, 0)));
}

/// SVC-2: several services on one channel, of one host or of two; each answers its own requests.
#[test]
fn two_services_on_one_channel() {
    let both = [id(ROOT), id(COMMAND)];
    let (root, command) = ([id(ROOT)], [id(COMMAND)]);
    let mut channel = Channel::default();
    let mut one = Host::new(&both);
    for (uuid, place) in [(COMMAND, 1), (ROOT, 0), (COMMAND, 1)] {
        channel.ask(uuid, "3");
        one.poll();
        assert_eq!(channel.skip_reads(&mut one), Did::Serve);
        let HostStep::Serve { uuid, .. } = one.step() else { unreachable!() };
        assert!(std::ptr::eq(uuid, &both[place]));
        one.answer(text("x"), 1).unwrap();
        channel.rest(&mut one);
    }

    let (mut first, mut second) = (Host::new(&root), Host::new(&command));
    for uuid in [COMMAND, ROOT, COMMAND] {
        channel.ask(uuid, "3");
        let served = (
            channel.serve(&mut first, square_root),
            channel.serve(&mut second, |_| ("done".to_string(), 2)),
        );
        assert_eq!(served, (uuid == ROOT, uuid == COMMAND));
    }

    // Nobody's service; none at all.
    channel.ask("00000000-0000-0000-0000-000000000000", "3");
    assert!(!channel.serve(&mut first, square_root));
    channel.ask(ROOT, "3");
    assert!(!channel.serve(&mut Host::new(&[]), square_root));
    assert!(channel.serve(&mut first, square_root));
}

/// SVC-1: 128 bytes with the NUL, of each text and on each side; what is longer is refused before
/// anything is written.
#[test]
fn texts_have_128_bytes() {
    let wait = SysServiceWait::default();
    for letter in ["a", "ä"] {
        let (fits, over) = (letter.repeat(127), letter.repeat(128));
        let too_long = |field| fault(TooLong, field, 0, (128, 129));

        // The program's request, and a text that is 127 bytes with its NUL.
        let shorter = &letter.repeat(126);
        assert!(Call::new(id(ROOT), text(shorter), wait).is_ok());
        let mut program = Call::new(id(ROOT), text(&fits), wait).unwrap();
        let error = Call::new(id(ROOT), text(&over), wait).unwrap_err();
        assert_eq!(Fault::of(error), too_long("request"));

        // It reaches the service, and the longest response the program.
        let mut channel = Channel::default();
        assert_eq!(channel.run(&mut program, millis(0)), None);
        let ids = [id(ROOT)];
        let mut host = Host::new(&ids);
        assert_eq!(channel.skip_reads(&mut host), Did::Serve);
        let before = channel.interface.clone();
        let error = host.answer(text(&over), 1).unwrap_err();
        assert_eq!(Fault::of(error), too_long("response"));
        let HostStep::Serve { request, .. } = host.step() else { panic!("{:?}", host.step()) };
        assert_eq!((request, &channel.interface), (text(&fits), &before));
        host.answer(text(&fits), 1).unwrap();
        channel.rest(&mut host);
        assert_eq!(channel.run(&mut program, millis(0)), Some(Ok((1, fits.clone()))));
        assert_eq!(channel.interface.read(Response).len(), 128);

        // The interface.
        let (fits, over) = (vec![b'x'; 127], vec![b'x'; 128]);
        for (variable, field) in [(Uuid, "uuid"), (Request, "request"), (Response, "response")] {
            let mut interface = Interface::new();
            interface.write(variable, &[&fits[..], b"\0behind"].concat()).unwrap();
            assert_eq!(interface.read(variable), [&fits[..], b"\0"].concat());
            let before = interface.clone();
            for long in [over.clone(), [&over[..], b"\0"].concat()] {
                let error = interface.write(variable, &long).unwrap_err();
                assert_eq!(Fault::of(error), too_long(field));
            }
            assert_eq!(interface, before);
        }
    }
}

/// A request that is longer than its field is none; the next one is.
#[test]
fn a_request_longer_than_its_field_is_refused() {
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
    assert_eq!(Fault::of(error), fault(TooLong, "request", 0, (128, 129)));
    assert_eq!(host.step(), HostStep::Wait);
    host.poll();
    reach(&mut channel, &mut host);
    // Padding is no text.
    host.read(&[&b"3\0"[..], &[0; 300]].concat()).unwrap();
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    let HostStep::Serve { request, .. } = host.step() else { unreachable!() };
    assert_eq!(request, "3");
    // And when the answer is there, it is another request.
    host.answer(text("x"), 1).unwrap();
    reach(&mut channel, &mut host);
    host.read(&[b'3'; 128]).unwrap();
    assert_eq!((host.step(), host.outcome()), (HostStep::Wait, Some(Outcome::Dropped)));
}

/// SVC-5, E-35: a response state of 0 is refused; another answer to the same request is not.
#[test]
fn a_response_state_of_0_is_refused() {
    let mut channel = Channel::default();
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    channel.ask(ROOT, "3");
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    let error = host.answer(text("x"), 0).unwrap_err();
    assert_eq!(Fault::of(error), fault(OutOfRange, "response_state", 0, (1, 0)));
    assert!(matches!(host.step(), HostStep::Serve { .. }));
    assert_eq!((host.outcome(), channel.written.len()), (None, 0));
    host.answer(text("x"), u32::MAX).unwrap();
    channel.rest(&mut host);
    assert_eq!(channel.interface.read(ResponseState), [0xFF; 4]);
}

/// A state of not just four bytes is an error, and no state.
#[test]
fn states_have_four_bytes() {
    let cut = |field| fault(Truncated, field, 0, (4, 3));
    let long = |field| fault(Trailing, field, 4, (4, 5));
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    assert_eq!(Fault::of(host.read(&[1; 3]).unwrap_err()), cut("request_state"));
    assert_eq!(host.step(), HostStep::Wait);
    host.poll();
    assert_eq!(Fault::of(host.read(&[0; 5]).unwrap_err()), long("request_state"));

    // With an answer at hand it is read again.
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    host.poll();
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    host.answer(text("x"), 1).unwrap();
    assert_eq!(Fault::of(host.read(&[]).unwrap_err()).kind, Truncated);
    assert_eq!(host.step(), HostStep::Read(RequestState));
    channel.rest(&mut host);
    assert_eq!(host.outcome(), Some(Outcome::Answered));

    let mut waiting = SysServiceWait::default().start(millis(0));
    assert_eq!(Fault::of(waiting.read(&[1; 3], millis(0)).unwrap_err()), cut("response_state"));
    assert_eq!(waiting.step(), WaitStep::Read(ResponseState));

    let mut interface = Interface::new();
    interface.write(RequestState, &[2, 0, 0, 0]).unwrap();
    let before = interface.clone();
    for (variable, field) in [(RequestState, "request_state"), (ResponseState, "response_state")] {
        let refused = interface.write(variable, &[0; 3]).unwrap_err();
        assert_eq!(Fault::of(refused), cut(field));
        let refused = interface.write(variable, &[0; 5]).unwrap_err();
        assert_eq!(Fault::of(refused), long(field));
    }
    assert_eq!(interface, before);
}

/// SVC-3: any write of REQUEST_STATE resets RESPONSE_STATE, and nothing else does.
#[test]
fn a_request_state_resets_the_response_state() {
    for clears in [Clears::OnResponseState, Clears::Never] {
        for state in [0, 1, 7_u32] {
            let mut interface = Interface::with(clears);
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
            assert_eq!(interface, Interface::with(clears));
        }
    }
}

/// SVC-4: whether writing RESPONSE_STATE sets REQUEST_STATE to 0 is the interface's choice.
#[test]
fn a_response_state_clears_the_request_state_or_does_not() {
    for (clears, left) in [(Clears::OnResponseState, 0), (Clears::Never, 3)] {
        let mut interface = Interface::with(clears);
        interface.write(RequestState, &[3, 0, 0, 0]).unwrap();
        interface.write(Response, b"r\0").unwrap();
        assert_eq!(interface.read(RequestState), [3, 0, 0, 0]);
        interface.write(ResponseState, &[1, 0, 0, 0]).unwrap();
        assert_eq!(interface.read(RequestState), [left, 0, 0, 0]);
        assert_eq!(interface.read(ResponseState), [1, 0, 0, 0]);
    }
}

/// A response that is longer than its field is an error, and read again.
#[test]
fn a_response_longer_than_its_field_is_refused() {
    let mut program = call(ROOT, "3", [None; 3]);
    (0..3).for_each(|_| program.written(millis(0)));
    program.read(&[1, 0, 0, 0], millis(0)).unwrap();
    let error = program.read(&[b'x'; 128], millis(0)).unwrap_err();
    assert_eq!(Fault::of(error), fault(TooLong, "response", 0, (128, 129)));
    assert_eq!(program.step(), CallStep::Read(Response));
    program.read(b"x", millis(0)).unwrap();
    assert_eq!(program.step(), CallStep::Done { state: 1, response: text("x") });
}

/// A write that failed may have arrived: the host looks, and writes what is missing, no more.
#[test]
fn writes_that_fail() {
    let ids = [id(ROOT)];
    for variable in [Response, RequestState, ResponseState] {
        for arrives in [false, true] {
            let mut channel = Channel::default();
            let mut program = call(ROOT, "3", [None; 3]);
            assert_eq!(channel.run(&mut program, millis(0)), None);
            channel.written.clear();
            let mut host = Host::new(&ids);
            assert_eq!(channel.skip_reads(&mut host), Did::Serve);
            host.answer(text("x"), 1).unwrap();
            channel.reach(&mut host, variable);
            let HostStep::Write(_, value) = host.step() else { unreachable!() };
            if arrives {
                channel.write(variable, value);
            }
            host.failed();
            assert!(matches!(host.step(), HostStep::Read(_)), "{variable}: looks first");
            channel.rest(&mut host);
            assert_eq!(host.outcome(), Some(Outcome::Answered), "{variable}");
            let answer = Some(Ok((1, "x".to_string())));
            assert_eq!(channel.run(&mut program, millis(1)), answer);
            // Only a response that arrived is written again: that does no harm.
            let times = channel.written.iter().filter(|(one, _)| *one == variable).count();
            assert_eq!(times, if arrives && variable == Response { 2 } else { 1 }, "{variable}");
        }
    }
}

/// RESPONSE_STATE arrived though its write failed, and the program has asked again: that request is
/// served like any, and not answered with what was the answer before.
#[test]
fn a_write_that_failed_does_not_answer_the_next_request() {
    let ids = [id(ROOT)];
    let mut channel = Channel::default();
    let mut program = call(ROOT, "3", [None; 3]);
    channel.run(&mut program, millis(0));
    let mut host = Host::new(&ids);
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    host.answer(text("first"), 1).unwrap();
    channel.reach(&mut host, ResponseState);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    assert_eq!(channel.run(&mut program, millis(1)), Some(Ok((1, "first".to_string()))));
    let mut program = call(ROOT, "3", [None; 3]);
    channel.run(&mut program, millis(2));
    host.failed();
    assert_eq!(channel.skip_reads(&mut host), Did::Wait);
    assert_eq!(channel.run(&mut program, millis(3)), None);
    assert!(channel.serve(&mut host, |_| ("second".to_string(), 1)));
    assert_eq!(channel.run(&mut program, millis(4)), Some(Ok((1, "second".to_string()))));
}

/// The write of RESPONSE_STATE failed, and what stands there now is another's: nothing is written.
#[test]
fn a_write_that_failed_is_not_repeated_over_what_is_anothers() {
    let ids = [id(ROOT)];
    // Another service has answered; another is asked and has not answered yet.
    for (response_state, uuid) in [(2, ROOT), (0, COMMAND)] {
        let mut channel = Channel::default();
        channel.ask(ROOT, "3");
        let mut host = Host::new(&ids);
        assert_eq!(channel.skip_reads(&mut host), Did::Serve);
        host.answer(text("x"), 1).unwrap();
        channel.reach(&mut host, ResponseState);
        host.failed();
        channel.interface.write(Uuid, uuid.as_bytes()).unwrap();
        channel.interface.write(ResponseState, &[response_state, 0, 0, 0]).unwrap();
        assert_eq!(channel.skip_reads(&mut host), Did::Wait);
        assert_eq!(host.outcome(), Some(Outcome::Dropped));
        assert_eq!(channel.interface.read(ResponseState), [response_state, 0, 0, 0]);
    }
}

/// A failed step that is no write, and calls out of turn, change nothing.
#[test]
fn calls_out_of_turn_do_nothing() {
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    host.failed();
    host.written();
    host.poll();
    host.answer(text("x"), 1).unwrap();
    assert_eq!((host.step(), host.outcome()), (HostStep::Read(RequestState), None));
    host.read(&[0; 4]).unwrap();
    host.failed();
    host.read(b"no state").unwrap();
    host.answer(text("x"), 1).unwrap();
    assert_eq!(host.step(), HostStep::Wait);

    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    host.poll();
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    host.failed();
    host.written();
    host.poll();
    host.read(&[0; 4]).unwrap();
    assert!(matches!(host.step(), HostStep::Serve { .. }));

    let mut program = call(ROOT, "3", [None; 3]);
    program.poll();
    program.read(b"", millis(0)).unwrap();
    assert!(matches!(program.step(), CallStep::Write(Uuid, _)));
    assert_eq!(channel.run(&mut program, millis(0)), None);
    program.written(millis(0));
    program.read(&[9, 0, 0, 0], millis(0)).unwrap();
    assert_eq!(program.step(), CallStep::Wait { until: None });
    program.poll();
    program.poll();
    assert_eq!(program.step(), CallStep::Read(ResponseState));
}

/// The program has given up and asks something else, of the same service or of another: the answer
/// that comes late is dropped, and nothing of it written.
#[test]
fn a_late_answer_is_dropped() {
    let ids = [id(ROOT)];
    for (uuid, request, ours) in [(ROOT, "4", true), (COMMAND, "3", false)] {
        let mut channel = Channel::default();
        channel.ask(ROOT, "3");
        let mut host = Host::new(&ids);
        assert_eq!(channel.skip_reads(&mut host), Did::Serve);
        channel.ask(uuid, request);
        host.answer(text("late"), 1).unwrap();
        assert_eq!(host.outcome(), None);
        assert_eq!(channel.skip_reads(&mut host), Did::Wait);
        assert_eq!(host.outcome(), Some(Outcome::Dropped));
        assert_eq!((channel.written.len(), channel.interface.read(Response)), (0, &b"\0"[..]));
        assert_eq!(channel.serve(&mut host, |_| ("x".to_string(), 1)), ours);
        let last = if ours { Outcome::Answered } else { Outcome::Dropped };
        assert_eq!(host.outcome(), Some(last));
        // While the next answer is on its way, the last one's end is no more.
        channel.ask(ROOT, "5");
        host.poll();
        assert_eq!(channel.skip_reads(&mut host), Did::Serve);
        host.answer(text("x"), 1).unwrap();
        assert_eq!(host.outcome(), None);
    }
    // The same text with another state is another request too.
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    let mut host = Host::new(&ids);
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    channel.interface.write(RequestState, &[2, 0, 0, 0]).unwrap();
    host.answer(text("late"), 1).unwrap();
    assert_eq!(channel.skip_reads(&mut host), Did::Wait);
    assert_eq!((host.outcome(), channel.written.len()), (Some(Outcome::Dropped), 0));
}

/// SVC-2: the program goes on to another service between two reads of a host; that host does not
/// take the request of before for its own.
#[test]
fn a_request_is_read_twice() {
    let ids = [id(COMMAND)];
    let mut host = Host::new(&ids);
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    assert_eq!(channel.step(&mut host), Did::Read(RequestState));
    channel.write(RequestState, &[0; 4]);
    channel.write(ResponseState, &[1, 0, 0, 0]);
    channel.write(Uuid, format!("{COMMAND}\0").as_bytes());
    assert_eq!(channel.step(&mut host), Did::Read(Uuid));
    assert_eq!(channel.step(&mut host), Did::Read(Request));
    channel.write(Request, b"some-command\0");
    channel.write(RequestState, &[1, 0, 0, 0]);
    assert_eq!(channel.skip_reads(&mut host), Did::Wait);
    assert_eq!(host.outcome(), None);
    host.poll();
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    let HostStep::Serve { request, .. } = host.step() else { unreachable!() };
    assert_eq!(request, "some-command");
}

/// The CNC is reset at any step of an answer: the host goes on, and the next program gets its own.
#[test]
fn a_reset_in_the_middle() {
    let ids = [id(ROOT)];
    for steps in 0..24 {
        for told in [false, true] {
            let mut channel = Channel::default();
            channel.ask(ROOT, "3");
            let mut host = Host::new(&ids);
            for _ in 0..steps {
                if channel.step(&mut host) == Did::Serve {
                    host.answer(text("old"), 99).unwrap();
                }
            }
            channel.interface.reset();
            if told {
                host.restart();
                assert_eq!(host.step(), HostStep::Read(RequestState));
            }
            // To its next wait, with what it had in hand when it was not told.
            while channel.skip_reads(&mut host) != Did::Wait {
                if channel.step(&mut host) == Did::Serve {
                    host.answer(text("old"), 99).unwrap();
                }
            }
            let mut program = call(ROOT, "3", [None; 3]);
            assert_eq!(channel.run(&mut program, millis(0)), None);
            assert!(channel.serve(&mut host, square_root), "{steps}");
            let answer = Some(Ok((1, "1.732051".to_string())));
            assert_eq!(channel.run(&mut program, millis(1)), answer, "{steps}");
        }
    }
}

/// What was served and not answered is served again after a restart.
#[test]
fn a_restart_serves_again() {
    let ids = [id(ROOT)];
    let mut channel = Channel::default();
    channel.ask(ROOT, "3");
    let mut host = Host::new(&ids);
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    host.answer(text("x"), 1).unwrap();
    host.restart();
    assert_eq!(channel.skip_reads(&mut host), Did::Serve);
    assert_eq!((host.outcome(), channel.written.len()), (None, 0));
}
