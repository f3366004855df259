//! Seeded defects.

use std::sync::OnceLock;

/// A seeded defect, which a target has to find, or [`NONE`](Self::NONE).
///
/// With a defect, the body of the target behaves as if the code under test had one fault. A law
/// that does not detect the defect is too weak. The numbers of a target's defects start at 1; 254
/// and 255 are those of [`PANIC`](Self::PANIC) and [`HANG`](Self::HANG), which every target has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Defect(u8);

impl Defect {
    /// No defect.
    pub const NONE: Self = Self(0);

    /// Any input of more than eight bytes causes a panic.
    pub const PANIC: Self = Self(254);

    /// Any input of more than eight bytes causes an endless loop.
    pub const HANG: Self = Self(255);

    /// The defect with this number.
    pub const fn new(number: u8) -> Self {
        Self(number)
    }

    /// The defect whose number is in the environment variable `ADS_CNC_SEEDED_DEFECT`, or `NONE`
    /// without this variable. The value may also be `panic` or `hang`.
    ///
    /// # Panics
    /// If the variable has another value.
    pub fn from_environment() -> Self {
        static CHOSEN: OnceLock<Defect> = OnceLock::new();
        *CHOSEN.get_or_init(|| match std::env::var("ADS_CNC_SEEDED_DEFECT") {
            Ok(word) if word == "panic" => Self::PANIC,
            Ok(word) if word == "hang" => Self::HANG,
            Ok(number) => Self(number.parse().expect("the number of a seeded defect")),
            Err(_) => Self::NONE,
        })
    }

    /// Whether `self` is the defect with this number.
    pub const fn is(self, number: u8) -> bool {
        self.0 == number
    }

    /// Panics for [`PANIC`](Self::PANIC), and never returns for [`HANG`](Self::HANG).
    pub(crate) fn panic_or_hang(self) {
        assert!(self != Self::PANIC, "the seeded panic");
        if self == Self::HANG {
            loop {
                std::hint::spin_loop();
            }
        }
    }
}
