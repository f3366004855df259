//! AMS addresses of senders and receivers.

use core::fmt;
use core::str::FromStr;

use crate::error::{Error, ErrorKind};
use crate::layout::ams_net_id::{NUMBER, NUMBERS};

/// An AMS NetId: six bytes, written in decimal with dots between them.
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// ```
/// use ads_cnc::ads::AmsNetId;
///
/// let id: AmsNetId = "192.0.2.7.1.1".parse()?;
/// assert_eq!(id, AmsNetId([192, 0, 2, 7, 1, 1]));
/// assert_eq!(id.to_string(), "192.0.2.7.1.1");
/// for wrong in ["192.0.2.7.1", "192.0.2.7.1.1.1", "192.0.2.7.1.256", "+192.0.2.7.1.1", "1..3.4.5.6", "0001.2.3.4.5.6", ""] {
///     assert!(wrong.parse::<AmsNetId>().is_err());
/// }
/// assert_eq!(
///     "192.0.2.7.1.256".parse::<AmsNetId>().unwrap_err().to_string(),
///     "ams-net-id: number at offset 12: out of range, expected at most 255, found 256"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct AmsNetId(pub [u8; 6]);

impl fmt::Display for AmsNetId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b, c, d, e, g] = self.0;
        write!(f, "{a}.{b}.{c}.{d}.{e}.{g}")
    }
}

impl fmt::Debug for AmsNetId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl FromStr for AmsNetId {
    type Err = Error;

    /// Parses six numbers of one byte with dots between them.
    ///
    /// # Errors
    /// [`ErrorKind::NotDecimal`], [`ErrorKind::Digits`] and [`ErrorKind::OutOfRange`] for a wrong
    /// number, with its offset in the text in bytes; [`ErrorKind::Mismatch`] if there are not six
    /// numbers.
    fn from_str(text: &str) -> Result<Self, Error> {
        let mut id = [0; 6];
        let mut parts = parts(text);
        let mut at = 0_u32;
        for (count, byte) in (0_u32..).zip(&mut id) {
            let part = parts.next().ok_or(Error::new(ErrorKind::Mismatch, NUMBERS, 0, 6, count))?;
            let len = crate::bytes::to_u32(part.len());
            // Check the digits here, because `u32::parse` also accepts a plus sign and any number
            // of leading zeros.
            if let Some(odd) = part.chars().find(|character| !character.is_ascii_digit()) {
                return Err(Error::new(ErrorKind::NotDecimal, NUMBER, at, 0, odd.into()));
            }
            if !(1..=3).contains(&part.len()) {
                return Err(Error::new(ErrorKind::Digits, NUMBER, at, 3, len));
            }
            let number = part.parse::<u32>().unwrap_or(u32::MAX);
            let fits = u8::try_from(number);
            *byte = fits.map_err(|_| Error::new(ErrorKind::OutOfRange, NUMBER, at, 255, number))?;
            at = at.saturating_add(len).saturating_add(1);
        }
        match crate::bytes::to_u32(parts.count()) {
            0 => Ok(Self(id)),
            more => Err(Error::new(ErrorKind::Mismatch, NUMBERS, 0, 6, more.saturating_add(6))),
        }
    }
}

/// The parts of the text between its dots. `str::split` is not used, because it would add a panic
/// to the program.
fn parts(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    core::iter::from_fn(move || {
        let text = rest?;
        let dot = text.bytes().position(|byte| byte == b'.').unwrap_or(text.len());
        let (part, after) = text.split_at_checked(dot)?;
        rest = after.get(1..);
        Some(part)
    })
}

impl From<[u8; 6]> for AmsNetId {
    fn from(bytes: [u8; 6]) -> Self {
        Self(bytes)
    }
}

impl From<AmsNetId> for [u8; 6] {
    fn from(id: AmsNetId) -> Self {
        id.0
    }
}

/// An AMS port.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 1. The numbers of the ports have other sources
/// (GEN-4).
///
/// ```
/// use ads_cnc::ads::AmsPort;
///
/// assert_eq!([AmsPort::GEO, AmsPort::SDA, AmsPort::COM].map(|port| port.0), [551, 552, 553]);
/// assert_eq!(AmsPort(0x8001).to_string(), "32769");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct AmsPort(pub u16);

impl AmsPort {
    /// The port of the GEO task (GEN-4).
    pub const GEO: Self = Self(551);
    /// The port of the SDA task (GEN-4).
    pub const SDA: Self = Self(552);
    /// The port of the COM task (GEN-4).
    pub const COM: Self = Self(553);
}

impl fmt::Display for AmsPort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for AmsPort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A NetId and a port: the address of a sender or receiver.
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// ```
/// use ads_cnc::ads::{AmsAddr, AmsPort};
///
/// let com = AmsAddr { net_id: "192.0.2.7.1.1".parse()?, port: AmsPort::COM };
/// assert_eq!(com.to_string(), "192.0.2.7.1.1:553");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct AmsAddr {
    /// The NetId of the device.
    pub net_id: AmsNetId,
    /// The port on the device.
    pub port: AmsPort,
}

impl fmt::Display for AmsAddr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.net_id, self.port)
    }
}

impl fmt::Debug for AmsAddr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
