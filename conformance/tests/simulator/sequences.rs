//! The golden sequences of data streaming and of the Service Interface.

use ads_cnc_vectors::{Given, Sequence, sequences};

use crate::player::play;
use crate::target::Target;

/// The golden sequences that consist of steps.
pub(crate) fn with_steps() -> impl Iterator<Item = &'static Sequence> {
    let all = sequences().iter();
    all.filter(|one| matches!(one.given, Given::Streaming(_) | Given::Service(_)))
}

#[test]
fn the_simulated_cnc_goes_through_each_golden_sequence() {
    for sequence in with_steps() {
        if let Err(why) = play(&Target::new(None), sequence) {
            panic!("{}: {why:?}", sequence.id);
        }
    }
    assert!(with_steps().count() >= 85);
}
