//! The values of the variables of the Service Interface.

use core::fmt;

use super::ServiceVariable;
use crate::bytes::{to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::limits::SERVICE_TEXT_MAX;
use crate::text::CncStr;

/// A text with its NUL, at the start of 128 bytes; the bytes after the NUL are 0.
#[derive(Clone, Copy)]
pub(super) struct ServiceText {
    bytes: [u8; SERVICE_TEXT_MAX],
    /// The length of the text in bytes, including its NUL.
    len: u8,
}

impl ServiceText {
    pub(super) const EMPTY: Self = Self { bytes: [0; SERVICE_TEXT_MAX], len: 1 };

    /// Copies a text; rejects a text that does not fit into 128 bytes with its NUL.
    pub(super) fn new(text: CncStr<'_>, variable: ServiceVariable) -> Result<Self, Error> {
        let len = text.len().saturating_add(1);
        let Some(len) =
            u8::try_from(len).ok().filter(|&len| to_usize(len.into()) <= SERVICE_TEXT_MAX)
        else {
            return Err(too_long(len, variable));
        };
        let mut bytes = [0; SERVICE_TEXT_MAX];
        bytes.iter_mut().zip(text.bytes()).for_each(|(byte, new)| *byte = new);
        Ok(Self { bytes, len })
    }

    /// Decodes a value: the text ends at the first NUL, or at the end of the value (VAR-22).
    pub(super) fn decode(value: &[u8], variable: ServiceVariable) -> Result<Self, Error> {
        Self::new(CncStr::until_nul(value), variable)
    }

    pub(super) fn text(&self) -> CncStr<'_> {
        CncStr::until_nul(&self.bytes)
    }

    /// The value to write: the text and one NUL.
    pub(super) fn value(&self) -> &[u8] {
        self.bytes.get(..to_usize(self.len.into())).unwrap_or(&self.bytes)
    }
}

impl PartialEq for ServiceText {
    fn eq(&self, other: &Self) -> bool {
        self.bytes == other.bytes
    }
}

impl Eq for ServiceText {}

impl fmt::Debug for ServiceText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.text(), f)
    }
}

impl ServiceVariable {
    /// Decodes the text in a value of this variable: the bytes before the first NUL, or all bytes of a
    /// value without a NUL (VAR-22).
    ///
    /// ```
    /// use ads_cnc::service::ServiceVariable;
    ///
    /// assert_eq!(ServiceVariable::Request.text(b"ping\0\0")?, "ping");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TooLong`](ErrorKind::TooLong) for a text of more than 128 bytes including its NUL.
    pub fn text(self, value: &[u8]) -> Result<CncStr<'_>, Error> {
        let text = CncStr::until_nul(value);
        match text.len().saturating_add(1) {
            len if len > SERVICE_TEXT_MAX => Err(too_long(len, self)),
            _ => Ok(text),
        }
    }

    /// Decodes the number in the value of a state, an UNS32.
    ///
    /// ```
    /// use ads_cnc::service::ServiceVariable;
    ///
    /// assert_eq!(ServiceVariable::ResponseState.state(&[99, 0, 0, 0])?, 99);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Truncated`](ErrorKind::Truncated) and [`Trailing`](ErrorKind::Trailing) for a value that
    /// does not have exactly four bytes.
    pub fn state(self, value: &[u8]) -> Result<u32, Error> {
        let found = to_u32(value.len());
        match value.split_first_chunk() {
            None => Err(Error::new(ErrorKind::Truncated, self.field(), 0, 4, found)),
            Some((le, [])) => Ok(u32::from_le_bytes(*le)),
            Some(_) => Err(Error::new(ErrorKind::Trailing, self.field(), 4, 4, found)),
        }
    }
}

/// The bytes of a state; rejects a state of 0.
pub(super) fn not_zero(state: u32, variable: ServiceVariable) -> Result<[u8; 4], Error> {
    match state {
        0 => Err(Error::new(ErrorKind::OutOfRange, variable.field(), 0, 1, 0)),
        _ => Ok(state.to_le_bytes()),
    }
}

#[cold]
fn too_long(len: usize, variable: ServiceVariable) -> Error {
    let max = to_u32(SERVICE_TEXT_MAX);
    Error::new(ErrorKind::TooLong, variable.field(), 0, max, to_u32(len))
}
