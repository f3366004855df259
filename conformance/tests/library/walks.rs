//! The number of requests that list the objects, elements and variables of a CNC is small, and limited
//! whatever the CNC replies.

use ads_cnc_conformance::faults::{Faulty, FieldDefect};
use ads_cnc_conformance::gate::Gate;
use ads_cnc_conformance::objects::{Options, Pattern, WalkResult, walk};
use ads_cnc_conformance::session::Session;
use ads_cnc_conformance::simulator::{Cnc, Responder};

fn found(cnc: impl Responder + 'static, options: &Options) -> WalkResult {
    let mut session = Session::simulated(cnc, Gate::queries()).unwrap();
    walk(&mut session, options, &mut |_| {}).unwrap()
}

fn default_cnc() -> Cnc {
    Cnc::with_default_model().unwrap()
}

/// The numbers of requests for the default model.
#[test]
fn few_requests_find_everything() {
    let all = found(default_cnc(), &Options::default());
    // Requests: COM 29, position controller 38, interpolator 74, decoder 95, HLD 49, path
    // preparation 47, spindles 17.
    assert_eq!((all.objects.len(), all.lists, all.requests), (179, 60, 350));
    let exact = found(default_cnc(), &Options { exact: true, ..Options::default() });
    assert_eq!((exact.objects.len(), exact.requests), (179, 694));
    // Eleven requests for the channels, seven counts for each channel, and one request for each
    // variable.
    let variables = found(default_cnc(), &Options { variables: true, ..Options::default() });
    assert_eq!((variables.objects.len(), variables.requests), (168, 200));
    assert!(all.notes.is_empty() && exact.notes.is_empty() && variables.notes.is_empty());

    let one = Options { lists: Some(Pattern::whole("COM channel 1")), ..Options::default() };
    let one = found(default_cnc(), &one);
    assert_eq!((one.objects.len(), one.lists), (28, 1));
}

/// With any defect of a field in replies, a walk over all items needs only few additional requests.
#[test]
fn walks_with_wrong_replies_end() {
    let streams = [
        "object-count",
        "object-descriptor",
        "object-address",
        "element-",
        "variable-count",
        "variable-description",
        "dynamic-",
    ];
    let mut tried = 0;
    for defect in FieldDefect::all() {
        let stream = defect.stream.layout().name;
        if !streams.iter().any(|part| stream.starts_with(part)) {
            continue;
        }
        tried += 1;
        for variables in [false, true] {
            let cnc = Faulty::new(default_cnc(), Some(&defect.clone().into()));
            let found = found(cnc, &Options { variables, ..Options::default() });
            assert!(found.requests < 4000, "{}: {} requests", defect.id, found.requests);
        }
    }
    assert!(tried > 40, "{tried} defects");
}
