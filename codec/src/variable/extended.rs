//! The extended description of a variable.

use super::{Synchronisation, Validity};
use crate::bytes::{Reader, Writer};
use crate::declare::stream;
use crate::error::Error;
use crate::layout::Stream;
use crate::stream::{Decode, Encode};

stream! {
    /// Further properties of a V.E variable.
    ///
    /// V.G and V.A variables have no extended description: the reply for them is empty. Decode any reply as
    /// [`ExtendedReply`].
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Encode, ExtendedDescription, Synchronisation, Validity};
    ///
    /// let extended = ExtendedDescription {
    ///     synchronisation: Synchronisation::NO_SYNC,
    ///     validity: Validity::CHANNEL,
    /// };
    /// assert_eq!(extended.encode(&mut [0; 8])?, [1, 0, 0, 0, 1, 0, 0, 0]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableExtendedDescription "variable-extended-description", "Extended variable description by index, reply", "VAR-15", max 8;
    struct ExtendedDescription {
        @0 synchronisation: OPTIONAL_UNS32 as Synchronisation, "VAR-15", "1 NO_SYNC, 2 SYNCHRONIZED";
        @4 validity: UNS32 as Validity,                          "VAR-15", "1 CHANNEL, 2 GLOBAL";
    }
}

/// The reply to a request for an extended description: an [`ExtendedDescription`], or no bytes for a V.G
/// or V.A variable.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Decode, ExtendedDescription, ExtendedReply, Synchronisation, Validity};
///
/// let reply = ExtendedReply::decode(&[2, 0, 0, 0, 2, 0, 0, 0])?;
/// let extended = ExtendedDescription {
///     synchronisation: Synchronisation::SYNCHRONIZED,
///     validity: Validity::GLOBAL,
/// };
/// assert_eq!(reply, ExtendedReply(Some(extended)));
/// assert_eq!(ExtendedReply::decode(&[])?, ExtendedReply(None));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ExtendedReply(pub Option<ExtendedDescription>);

impl<'a> Decode<'a> for ExtendedReply {
    const STREAM: Stream = Stream::VariableExtendedDescription;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        if Reader::new(Self::STREAM, bytes)?.is_empty() {
            Ok(Self(None))
        } else {
            ExtendedDescription::decode(bytes).map(|extended| Self(Some(extended)))
        }
    }
}

impl Encode for ExtendedReply {
    fn encoded_len(&self) -> usize {
        self.0.map_or(0, |extended| extended.encoded_len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        match self.0 {
            Some(extended) => extended.encode(buf),
            None => Writer::copy(Self::STREAM, &[], buf),
        }
    }
}
