//! The ID of a service.

use core::fmt;
use core::hash::{Hash, Hasher};

use super::ServiceVariable;
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::text::{Chars, CncStr};

/// The offsets of the hyphens in a UUID.
const HYPHENS: [usize; 4] = [8, 13, 18, 23];

/// The UUID of a service, with its original case.
///
/// A UUID has 8, 4, 4, 4 and 12 hexadecimal digits with hyphens between them; other forms are
/// rejected (assumed). UUIDs are compared without regard to case (assumed, SVC-7); the case is
/// kept.
///
/// Manual: `service-en` and `service-de` 1.03, section 2. In the NC program of the manuals, the
/// UUID lacks a digit (E-21):
///
/// ```
/// use ads_cnc::service::ServiceId;
///
/// let id = ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?;
/// assert_eq!(id, ServiceId::new("560aacbf-6335-44A9-895a-8b27f3ed5e47")?);
/// assert_eq!(id.to_string(), "560AACBF-6335-44a9-895A-8B27F3ED5E47");
/// assert_eq!(
///     ServiceId::new("560AACBF-6335-44a9-895A-B27F3ED5E47").unwrap_err().to_string(),
///     "service: uuid at offset 0: truncated, expected 36 bytes, found 35"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct ServiceId([u8; ServiceId::LEN]);

impl ServiceId {
    /// Number of characters of a UUID.
    pub const LEN: usize = 36;

    /// Parses a UUID.
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`], [`ErrorKind::Trailing`]: not 36 characters;
    /// [`ErrorKind::Unexpected`]: a character other than the hexadecimal digit or the hyphen that its
    /// position requires.
    pub fn new(text: &str) -> Result<Self, Error> {
        Self::from_chars(Chars::of_str(text))
    }

    /// Like [`new`](Self::new), but from CP1252 text.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn from_text(text: CncStr<'_>) -> Result<Self, Error> {
        Self::from_chars(text.chars())
    }

    fn from_chars(chars: Chars<'_>) -> Result<Self, Error> {
        let field = ServiceVariable::Uuid.field();
        let (len, found) = (to_u32(Self::LEN), to_u32(chars.clone().count()));
        if found < len {
            return Err(Error::new(ErrorKind::Truncated, field, 0, len, found));
        }
        if found > len {
            return Err(Error::new(ErrorKind::Trailing, field, len, len, found));
        }
        let mut id = [0; Self::LEN];
        for ((at, byte), character) in id.iter_mut().enumerate().zip(chars) {
            let fits = if HYPHENS.contains(&at) {
                character == '-'
            } else {
                character.is_ascii_hexdigit()
            };
            let Some(ascii) = u8::try_from(character).ok().filter(|_| fits) else {
                let (at, character) = (to_u32(at), u32::from(character));
                return Err(Error::new(ErrorKind::Unexpected, field, at, 0, character));
            };
            *byte = ascii;
        }
        Ok(Self(id))
    }

    /// The UUID with its original case.
    pub const fn text(&self) -> CncStr<'_> {
        CncStr::without_nul(&self.0)
    }
}

impl core::str::FromStr for ServiceId {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::new(text)
    }
}

impl PartialEq for ServiceId {
    fn eq(&self, other: &Self) -> bool {
        self.0.eq_ignore_ascii_case(&other.0)
    }
}

impl Eq for ServiceId {}

impl Hash for ServiceId {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.map(|byte| byte.to_ascii_lowercase()).hash(state);
    }
}

impl fmt::Display for ServiceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.text(), f)
    }
}

impl fmt::Debug for ServiceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ServiceId({self})")
    }
}
