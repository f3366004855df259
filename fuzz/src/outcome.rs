//! What an input led to.

use std::hash::{DefaultHasher, Hash, Hasher};

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
    let mut digest = Digest::default();
    what.hash(&mut digest);
    digest.finish()
}

/// A hash that is the same on every machine, whatever its byte order and the size of its words; but
/// for slices of numbers, which are hashed as they lie in memory.
///
/// It has no random key, so two programs of one toolchain agree.
#[derive(Clone, Debug, Default)]
pub struct Digest(DefaultHasher);

impl Hasher for Digest {
    fn write(&mut self, bytes: &[u8]) {
        self.0.write(bytes);
    }

    fn write_u16(&mut self, number: u16) {
        self.0.write(&number.to_le_bytes());
    }

    fn write_u32(&mut self, number: u32) {
        self.0.write(&number.to_le_bytes());
    }

    fn write_u64(&mut self, number: u64) {
        self.0.write(&number.to_le_bytes());
    }

    /// Lengths.
    fn write_usize(&mut self, number: usize) {
        self.write_u64(number as u64);
    }

    /// Which variant of an enum it is.
    fn write_isize(&mut self, number: isize) {
        self.write_u64(number as u64);
    }

    fn finish(&self) -> u64 {
        self.0.finish()
    }
}
