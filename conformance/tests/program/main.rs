//! The programs of the simulated CNC: streamed ones and those that ask services.

mod decoder;
mod golden_interface;
mod golden_service;
mod golden_streaming;
mod interfaces;
mod interleavings;
#[path = "../kept/mod.rs"]
mod kept;
mod machines;
mod script;
mod sender;
mod service;
mod world;

use ads_cnc_vectors::{Sequence, SequenceExpect, sequences};

/// The cases of a kind; there have to be so many at least.
fn cases(kind: &str, least: usize) -> Vec<&'static Sequence> {
    let found: Vec<_> = sequences().iter().filter(|case| case.kind() == kind).collect();
    assert!(found.len() >= least, "{} of {kind}", found.len());
    found
}

/// What is at fault according to the case: class and step.
fn stated_fault(case: &Sequence) -> Option<(&str, &str)> {
    match &case.expect {
        SequenceExpect::Accept(_) => None,
        SequenceExpect::Reject(reject) => Some((
            reject.class.as_str(),
            reject.step.as_deref().expect("steps have one that is at fault"),
        )),
    }
}
