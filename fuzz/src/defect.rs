//! Seeded defects.

use std::sync::OnceLock;

/// Which seeded defect a target has to find, if any.
///
/// A body that is given one works on a codec that is wrong in one thing, so a law that cannot fail
/// is found out. The first is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Defect(u8);

impl Defect {
    /// The code as it is.
    pub const NONE: Self = Self(0);

    /// The defect of that number.
    pub const fn new(number: u8) -> Self {
        Self(number)
    }

    /// The one that the environment names in `ADS_CNC_SEEDED_DEFECT`.
    ///
    /// # Panics
    /// If that is no number.
    pub fn from_environment() -> Self {
        static CHOSEN: OnceLock<Defect> = OnceLock::new();
        *CHOSEN.get_or_init(|| match std::env::var("ADS_CNC_SEEDED_DEFECT") {
            Ok(number) => Self(number.parse().expect("the number of a seeded defect")),
            Err(_) => Self::NONE,
        })
    }

    /// Whether it is the defect of that number.
    pub const fn is(self, number: u8) -> bool {
        self.0 == number
    }
}
