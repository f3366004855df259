//! Tests of the Service Interface: its variables, UUIDs, and a host with any input.

use ads_cnc::ErrorKind::*;
use ads_cnc::layout::Subject;
use ads_cnc::service::ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
use ads_cnc::service::*;
use ads_cnc::{CncStr, VariablePath, VariableType};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::machines::{CheckedHost, HostMutation, service_ids};
use super::common::{Fault, fault};
use super::kept;

const ROOT: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";
const COMMAND: &str = "19719079-BA06-4740-BC02-DE5215211751";

fn id(text: &str) -> ServiceId {
    ServiceId::new(text).unwrap()
}

fn text(text: &str) -> CncStr<'_> {
    CncStr::new(text).unwrap()
}

/// The value of a variable while a request for the square root of 3 is pending.
fn asked(variable: ServiceVariable) -> &'static [u8] {
    match variable {
        Uuid => ROOT.as_bytes(),
        Request => b"3\0",
        RequestState => &[1, 0, 0, 0],
        Response => b"\0",
        ResponseState => &[0; 4],
    }
}

/// Passes the values of the request to the host until its next step is not a read.
fn read(host: &mut Host<'_>) {
    while let HostStep::Read(variable) = host.step() {
        host.read(asked(variable)).unwrap();
    }
}

/// The five variables have the documented names and types; the names are valid names of variables
/// (SVC-1).
#[test]
fn the_five_variables_have_their_names_and_types() {
    let variables =
        ServiceVariable::ALL.map(|variable| (variable, variable.name(), variable.var_type()));
    let expected = [
        (Uuid, "V.G.SERVICE.UUID", VariableType::STRING),
        (Request, "V.G.SERVICE.REQUEST", VariableType::STRING),
        (RequestState, "V.G.SERVICE.REQUEST_STATE", VariableType::UNS32),
        (ResponseState, "V.G.SERVICE.RESPONSE_STATE", VariableType::UNS32),
        (Response, "V.G.SERVICE.RESPONSE", VariableType::STRING),
    ];
    assert_eq!(variables, expected);
    for variable in ServiceVariable::ALL {
        assert_eq!(ServiceVariable::by_name(variable.name()), Some(variable));
        assert_eq!(VariablePath::new(variable.name()).unwrap().parts().count(), 2);
        let size = if variable.to_string().ends_with("STATE") { Some(4) } else { None };
        assert_eq!(variable.var_type().element_size(), size, "{variable}");
    }
    assert_eq!(ServiceVariable::by_name("V.G.SERVICE"), None);
}

#[test]
fn uuids_are_checked_and_keep_their_case() {
    let rejected = |text| {
        let error = ServiceId::new(text).unwrap_err();
        assert_eq!(error.field().subject(), Subject::Service);
        assert_eq!(ServiceId::from_text(CncStr::new(text).unwrap()), Err(error));
        Fault::of(error)
    };
    let unexpected =
        |at, character: char| fault(Unexpected, "uuid", at, (0, u32::from(character) as usize));
    assert_eq!(rejected(""), fault(Truncated, "uuid", 0, (36, 0)));
    assert_eq!(rejected("560AACBF-6335-44a9-895A-8B27F3ED5E470"), {
        fault(Trailing, "uuid", 36, (36, 37))
    });
    assert_eq!(rejected("560AACBF-6335-44a9-895A-B27F3ED5SE47"), unexpected(32, 'S'));
    assert_eq!(rejected("560AACBF06335-44a9-895A-8B27F3ED5E47"), unexpected(8, '0'));
    assert_eq!(rejected("560AACBF-6335-44a9-895A--B27F3ED5E47"), unexpected(24, '-'));
    assert_eq!(rejected("560AACBF-6335-44ä9-895A-8B27F3ED5E47"), unexpected(16, 'ä'));

    // UUIDs are compared without regard to case, and their text keeps its case (SVC-7).
    let (upper, lower) = (ROOT.to_uppercase(), ROOT.to_lowercase());
    assert_eq!(id(&upper), id(&lower));
    assert_eq!(std::collections::HashSet::from([id(&upper), id(&lower)]).len(), 1);
    assert_eq!((id(ROOT).to_string(), id(ROOT).text()), (ROOT.to_string(), text(ROOT)));
    assert_ne!(id(ROOT), id(COMMAND));
    assert_eq!(ROOT.parse(), Ok(id(ROOT)));
    let ids = [id(&upper)];
    let mut host = Host::new(&ids);
    while let HostStep::Read(variable) = host.step() {
        host.read(if variable == Uuid { lower.as_bytes() } else { asked(variable) }).unwrap();
    }
    let HostStep::Serve { uuid, request, request_state } = host.step() else { unreachable!() };
    assert_eq!((uuid.to_string(), request, request_state), (upper, text("3"), 1));
}

/// A text has at most 128 bytes including the NUL, and a state has four bytes (SVC-1).
#[test]
fn values_have_their_sizes() {
    for (variable, field) in [(Uuid, "uuid"), (Request, "request"), (Response, "response")] {
        let longest = [b'x'; 127];
        let value = [&longest[..], b"\0behind"].concat();
        assert_eq!(variable.text(&value), Ok(CncStr::from_bytes(&longest).unwrap()));
        let error = variable.text(&[b'x'; 128]).unwrap_err();
        assert_eq!(Fault::of(error), fault(TooLong, field, 0, (128, 129)));
    }
    for (variable, field) in [(RequestState, "request_state"), (ResponseState, "response_state")] {
        assert_eq!(variable.state(&[1, 2, 3, 4]), Ok(0x0403_0201));
        let error = variable.state(&[0; 3]).unwrap_err();
        assert_eq!(Fault::of(error), fault(Truncated, field, 0, (4, 3)));
        let error = variable.state(&[0; 5]).unwrap_err();
        assert_eq!(Fault::of(error), fault(Trailing, field, 4, (4, 5)));
    }
}

/// RESPONSE, REQUEST_STATE and RESPONSE_STATE are written in this order (SVC-4, SVC-5).
#[test]
fn an_answer_is_written_in_order() {
    let ids = [id(COMMAND), id(ROOT)];
    let mut host = Host::new(&ids);
    read(&mut host);
    let HostStep::Serve { uuid, request, request_state } = host.step() else { unreachable!() };
    assert!(std::ptr::eq(uuid, &ids[1]));
    assert_eq!((request, request_state, host.outcome()), (text("3"), 1, None));
    host.answer(text("1.732051"), 7).unwrap();
    read(&mut host);
    for (variable, value) in
        [(Response, &b"1.732051\0"[..]), (RequestState, &[0; 4]), (ResponseState, &[7, 0, 0, 0])]
    {
        assert_eq!(host.step(), HostStep::Write(variable, value));
        host.written();
    }
    assert_eq!((host.step(), host.outcome()), (HostStep::Wait, Some(Outcome::Answered)));
}

/// A response state of 0 and a response of more than 127 characters are rejected; the host then
/// accepts another answer to the same request (SVC-5, E-35).
#[test]
fn answers_that_are_rejected() {
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    read(&mut host);
    let error = host.answer(text("x"), 0).unwrap_err();
    assert_eq!(Fault::of(error), fault(OutOfRange, "response_state", 0, (1, 0)));
    for letter in ["a", "ä"] {
        let error = host.answer(text(&letter.repeat(128)), 1).unwrap_err();
        assert_eq!(Fault::of(error), fault(TooLong, "response", 0, (128, 129)));
    }
    assert!(matches!(host.step(), HostStep::Serve { .. }));
    let longest = "ä".repeat(127);
    host.answer(text(&longest), u32::MAX).unwrap();
    read(&mut host);
    let HostStep::Write(Response, value) = host.step() else { panic!("{:?}", host.step()) };
    assert_eq!((value.len(), &value[125..]), (128, &b"\xE4\xE4\0"[..]));
}

/// When a host reads REQUEST_STATE and REQUEST for the first time, a malformed value is an error,
/// after which the host waits. When it reads them again, for example to verify the request before
/// it answers, it repeats the read of a malformed state, and takes a malformed REQUEST for a
/// different request.
#[test]
fn malformed_values_are_rejected() {
    let ids = [id(ROOT)];
    let mut host = Host::new(&ids);
    assert_eq!(Fault::of(host.read(&[1; 3]).unwrap_err()).field, "request_state");
    assert_eq!(host.step(), HostStep::Wait);
    host.poll();
    while host.step() != HostStep::Read(Request) {
        let HostStep::Read(variable) = host.step() else { unreachable!() };
        host.read(asked(variable)).unwrap();
    }
    let error = host.read(&[b'3'; 128]).unwrap_err();
    assert_eq!(Fault::of(error), fault(TooLong, "request", 0, (128, 129)));
    assert_eq!(host.step(), HostStep::Wait);

    host.poll();
    read(&mut host);
    host.answer(text("x"), 1).unwrap();
    assert_eq!(Fault::of(host.read(&[]).unwrap_err()).kind, Truncated);
    assert_eq!(host.step(), HostStep::Read(RequestState));
    host.read(asked(RequestState)).unwrap();
    host.read(asked(Uuid)).unwrap();
    // The value is not the answered request, so the host drops the answer.
    host.read(&[b'3'; 128]).unwrap();
    assert_eq!((host.step(), host.outcome()), (HostStep::Wait, Some(Outcome::Abandoned)));
}

/// After a failed write, the host reads the variables again, and repeats the write if necessary.
#[test]
fn failed_writes_are_checked_and_repeated() {
    for (failing, arrives) in [Response, RequestState, ResponseState]
        .into_iter()
        .flat_map(|one| [(one, false), (one, true)])
    {
        let ids = [id(ROOT)];
        let mut host = Host::new(&ids);
        let mut values = ServiceVariable::ALL.map(|variable| asked(variable).to_vec());
        let at = |of| ServiceVariable::ALL.iter().position(|variable| *variable == of).unwrap();
        let (mut failed, mut writes) = (false, Vec::new());
        while host.outcome().is_none() {
            match host.step() {
                HostStep::Read(variable) => host.read(&values[at(variable)]).unwrap(),
                HostStep::Write(variable, value) => {
                    let fails = variable == failing && !failed;
                    if !fails || arrives {
                        values[at(variable)] = value.to_vec();
                        writes.push(variable);
                    }
                    if fails {
                        failed = true;
                        host.failed();
                        assert!(matches!(host.step(), HostStep::Read(_)), "{variable}");
                    } else {
                        host.written();
                    }
                }
                HostStep::Serve { .. } => host.answer(text("x"), 1).unwrap(),
                HostStep::Wait => host.poll(),
            }
        }
        assert_eq!(host.outcome(), Some(Outcome::Answered), "{failing}");
        // If a failed write took effect, only that of RESPONSE is repeated; the repetition changes
        // nothing.
        let times = writes.iter().filter(|variable| **variable == failing).count();
        assert_eq!(times, if arrives && failing == Response { 2 } else { 1 }, "{failing}");
    }
}

/// A random value of a variable, valid or invalid.
fn value() -> impl Strategy<Value = Vec<u8>> {
    let [one, other] = service_ids().map(|id| id.to_string());
    prop_oneof![
        2 => (0..3_u8).prop_map(|state| vec![state, 0, 0, 0]),
        4 => prop::sample::select(vec![
            one.to_lowercase().into_bytes(),
            format!("{one}\0").into_bytes(),
            format!("{other}\0").into_bytes(),
        ]),
        2 => (b'0'..b'3').prop_map(|digit| vec![digit, 0]),
        1 => (112..140_usize).prop_map(|len| vec![b'x'; len]),
        1 => vec(any::<u8>(), 0..8),
    ]
}

/// The values of a request, as a program writes them.
fn request() -> impl Strategy<Value = [Vec<u8>; 3]> {
    (1..3_u8, 0..3_usize, b'0'..b'3').prop_map(|(state, id, digit)| {
        let ids = service_ids().map(|id| id.to_string().into_bytes());
        let uuid = ids.get(id).cloned().unwrap_or(vec![b'0'; 36]);
        [vec![state, 0, 0, 0], uuid, vec![digit, 0]]
    })
}

proptest! {
    #![proptest_config(kept::cases(600, file!()))]

    /// With any input, a host only serves requests that it has read twice, reads them again before
    /// it answers, and writes the variables in order.
    #[test]
    fn a_host_obeys_the_laws_with_any_input(
        events in vec((0..24_u8, value(), request(), 0..4_u32), 0..150),
    ) {
        let ids = service_ids();
        let mut host = CheckedHost::new(&ids, HostMutation::NONE);
        for (event, value, request, state) in events {
            match event {
                0..6 => host.read(&value),
                // Pass the same request twice in sequence: a host that begins to look for a request
                // then serves it, or waits if the UUID is not that of one of its services.
                6..12 => request.iter().cycle().take(6).for_each(|value| host.read(value)),
                12..14 => request.iter().for_each(|value| host.read(value)),
                14..17 => host.written(),
                17 => host.failed(),
                18..20 => host.poll(),
                20..23 => host.answer(&value, state),
                _ => host.restart(),
            }
        }
    }
}
