//! What an input led to.

use std::hash::{DefaultHasher, Hash, Hasher as _};

/// What an input led to: the same for every build of the codec that reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Whether the input got behind the first checks.
    pub accepted: bool,
    /// Everything that came of it, errors with their numbers included.
    pub digest: u64,
}

impl Outcome {
    /// The input was taken, and this came of it.
    pub fn accepted(what: impl Hash) -> Self {
        Self { accepted: true, digest: digest(what) }
    }

    /// The input was refused for this.
    pub fn refused(why: impl Hash) -> Self {
        Self { accepted: false, digest: digest(why) }
    }

    /// The input is none of this target's.
    pub fn unread() -> Self {
        Self::refused("unread")
    }

    /// The one or the other.
    pub fn of<T: Hash, E: Hash>(result: Result<T, E>) -> Self {
        match result {
            Ok(what) => Self::accepted(what),
            Err(why) => Self::refused(why),
        }
    }
}

fn digest(what: impl Hash) -> u64 {
    // Without a random key: two programs of one toolchain agree.
    let mut hasher = DefaultHasher::new();
    what.hash(&mut hasher);
    hasher.finish()
}
