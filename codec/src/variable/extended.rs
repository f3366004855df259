//! The extended description of a variable (VAR-15, VAR-16).

use zerocopy::IntoBytes as _;
use zerocopy::little_endian::U32;

use super::{Synchronisation, Validity};
use crate::bytes::{Reader, Writer};
use crate::error::Error;
use crate::layout::Stream;
use crate::stream::{Decode, Encode};

#[doc = include_str!("../../doc/variable-extended-description.md")]
///
/// V.G and V.A have none: their reply is empty.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
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
pub struct ExtendedReply(pub Option<ExtendedDescription>);

/// What a V.E variable has beyond its description.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
///
/// ```
/// use ads_cnc::{Encode, ExtendedDescription, ExtendedReply, Synchronisation, Validity};
///
/// let extended = ExtendedDescription {
///     synchronisation: Synchronisation::NO_SYNC,
///     validity: Validity::CHANNEL,
/// };
/// assert_eq!(ExtendedReply(Some(extended)).encode(&mut [0; 8])?, [1, 0, 0, 0, 1, 0, 0, 0]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct ExtendedDescription {
    /// Whether access is synchronised.
    pub synchronisation: Synchronisation,
    /// Where the variable is valid.
    pub validity: Validity,
}

impl<'a> Decode<'a> for ExtendedReply {
    const STREAM: Stream = Stream::VariableExtendedDescription;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        if input.is_empty() {
            return Ok(Self(None));
        }
        let [synchronisation, validity]: &[U32; 2] = input.fixed()?;
        input.finish()?;
        Ok(Self(Some(ExtendedDescription {
            synchronisation: Synchronisation(synchronisation.get()),
            validity: Validity(validity.get()),
        })))
    }
}

impl Encode for ExtendedReply {
    fn encoded_len(&self) -> usize {
        self.0.map_or(0, |_| 8)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::run(Self::STREAM, self.encoded_len(), buf, |out| {
            if let Some(extended) = self.0 {
                let numbers = [extended.synchronisation.0, extended.validity.0];
                out.put(numbers.map(U32::new).as_bytes());
            }
        })
    }
}
