//! The result of an input.

use std::hash::{DefaultHasher, Hash, Hasher};

/// The result of an input, which is the same in every build of the codec that has the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Whether the input passed the first checks.
    pub accepted: bool,
    /// A digest of the result, including errors with their numbers.
    pub digest: u64,
}

impl Outcome {
    /// An input that passed the first checks, and its result.
    pub fn accepted(what: impl Hash) -> Self {
        Self { accepted: true, digest: digest(what) }
    }

    /// An input that was rejected, and the reason.
    pub fn rejected(why: impl Hash) -> Self {
        Self { accepted: false, digest: digest(why) }
    }

    /// An input without a meaning for this target.
    pub fn unread() -> Self {
        Self::rejected("unread")
    }

    /// [`Outcome::accepted`] for `Ok`, [`Outcome::rejected`] for `Err`.
    pub fn of<T: Hash, E: Hash>(result: Result<T, E>) -> Self {
        match result {
            Ok(what) => Self::accepted(what),
            Err(why) => Self::rejected(why),
        }
    }
}

fn digest(what: impl Hash) -> u64 {
    let mut digest = Digest::default();
    what.hash(&mut digest);
    digest.finish()
}

/// A hash that does not depend on the byte order and word size of the machine, except for slices of
/// numbers, which are hashed as they are in memory.
///
/// It has no random key, so two programs that the same toolchain has built compute the same hash.
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

    /// Hashes a length as 64 bits.
    fn write_usize(&mut self, number: usize) {
        self.write_u64(number as u64);
    }

    /// Hashes the discriminant of an enum as 64 bits.
    fn write_isize(&mut self, number: isize) {
        self.write_u64(number as u64);
    }

    fn finish(&self) -> u64 {
        self.0.finish()
    }
}
