//! The golden sequences of data streaming and of the Service Interface.

use ads_cnc_vectors::{Sequence, SequenceInput, sequences};

use crate::player::play;
use crate::target::TestCnc;

/// The golden sequences that consist of steps.
pub(crate) fn with_steps() -> impl Iterator<Item = &'static Sequence> {
    let all = sequences().iter();
    all.filter(|one| matches!(one.given, SequenceInput::Streaming(_) | SequenceInput::Service(_)))
}

#[test]
fn the_simulated_cnc_goes_through_each_golden_sequence() {
    for sequence in with_steps() {
        if let Err(why) = play(&TestCnc::new(None), sequence) {
            panic!("{}: {why:?}", sequence.id);
        }
    }
    assert!(with_steps().count() >= 85);
}
