//! The number of requests that list the objects, elements and variables of the default model is
//! small, and limited even if a field of the replies is wrong.

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

/// A list ends after several consecutive rejections: the notes tell how many entries were requested.
#[test]
fn the_notes_of_a_list_with_a_gap_are_true() {
    let defect = FieldDefect::by_id("element-count.count.swap").unwrap();
    let cnc = Faulty::new(default_cnc(), Some(&defect.into()));
    let lists = Some(Pattern::whole("HLD channel 1"));
    let found = found(cnc, &Options { lists, ..Options::default() });
    let notes = [
        "HLD channel 1: the CNC rejects the requests for 8 of 10",
        "HLD channel 1: only the first 10 of 33554432 were requested",
    ];
    assert!(found.notes.iter().eq(notes), "{:?}", found.notes);
    // The limit of elements is smaller than the number that the CNC states.
    assert!(found.is_cut);
}

/// A list of objects that is longer than the limit makes the result incomplete.
#[test]
fn a_long_list_of_objects_is_cut() {
    let defect = FieldDefect::by_id("object-count.count.swap").unwrap();
    let cnc = Faulty::new(default_cnc(), Some(&defect.into()));
    let lists = Some(Pattern::whole("COM channel 1"));
    assert!(found(cnc, &Options { lists: lists.clone(), ..Options::default() }).is_cut);
    assert!(!found(default_cnc(), &Options { lists, ..Options::default() }).is_cut);
}

/// With each defect of a field in the streams below, a walk over all objects and elements, and a
/// walk over all variables, each need fewer than 4,000 requests.
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
