//! Asking for a handle or a value by name (VAR-9).

use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::variable_name::NAME;
use crate::limits::TEXT_MAX;
use crate::stream::{Decode, Encode};
use crate::text::TextRef;

#[doc = include_str!("../../doc/variable-name.md")]
///
/// NULs may pad the name up to 256 bytes (E-34).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.3 and 4.3.5.
///
/// ```
/// use ads_cnc::{Decode, VariableNameRef};
///
/// assert_eq!(VariableNameRef::decode(b"V.E.vartest\0")?.name.text(), "V.E.vartest");
/// assert_eq!(
///     VariableNameRef::decode(b"V.E.vartest").unwrap_err().to_string(),
///     "variable-name: name at offset 0: no NUL, one expected within 256 bytes, 11 there without"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VariableNameRef<'a> {
    /// Name of the variable.
    pub name: TextRef<'a>,
}

impl<'a> Decode<'a> for VariableNameRef<'a> {
    const STREAM: Stream = Stream::VariableName;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let field = input.terminated(NAME, to_u32(TEXT_MAX))?;
        Ok(Self { name: TextRef::split(field) })
    }
}

impl Encode for VariableNameRef<'_> {
    fn encoded_len(&self) -> usize {
        self.name.field_len()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        self.name.check_terminated(NAME, 0, to_u32(TEXT_MAX))?;
        Writer::run(Self::STREAM, self.encoded_len(), buf, |out| self.name.write(out))
    }
}

#[cfg(feature = "alloc")]
pub use owned::VariableName;

#[cfg(feature = "alloc")]
mod owned {
    use super::*;
    use crate::bridge;
    use crate::text::Text;

    /// [`VariableNameRef`], owned.
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct VariableName {
        /// Name of the variable.
        pub name: Text,
    }

    #[binrw::binread]
    #[br(little)]
    struct Wire {
        #[br(parse_with = bridge::text)]
        name: Text,
    }

    impl<'a> Decode<'a> for VariableName {
        const STREAM: Stream = Stream::VariableName;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            VariableNameRef::decode(bytes)?;
            let Wire { name } = bridge::read(Self::STREAM, bytes)?;
            Ok(Self { name })
        }
    }

    impl VariableName {
        /// The request, borrowed.
        pub fn as_ref(&self) -> VariableNameRef<'_> {
            VariableNameRef { name: self.name.as_ref() }
        }
    }

    crate::stream::encode_as_ref!(VariableName);
}
