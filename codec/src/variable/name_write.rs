//! Writing by name (VAR-13).

use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::variable_name_write::NAME;
use crate::limits::TEXT_MAX;
use crate::stream::{Decode, Encode};
use crate::text::{CncStr, TextRef};

#[doc = include_str!("../../doc/variable-name-write.md")]
///
/// The value begins behind the name's NUL, so that nothing can pad the name.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.7 and 4.3.11.
///
/// `decode` refuses with [`MissingNul`](crate::ErrorKind::MissingNul) or
/// [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{CncStr, Encode, NameWriteRef};
///
/// let name = CncStr::new("V.E.test[4]")?;
/// let mut buf = [0; 16];
/// let bytes = NameWriteRef { name, value: &123_i32.to_le_bytes() }.encode(&mut buf)?;
/// assert_eq!(bytes, b"V.E.test[4]\0\x7b\0\0\0");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NameWriteRef<'a> {
    /// Name of the variable.
    pub name: CncStr<'a>,
    /// The bytes of the value.
    pub value: &'a [u8],
}

impl<'a> Decode<'a> for NameWriteRef<'a> {
    const STREAM: Stream = Stream::VariableNameWrite;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let name = input.leading(NAME, to_u32(TEXT_MAX))?;
        let value = input.take_all();
        Ok(Self { name, value })
    }
}

impl Encode for NameWriteRef<'_> {
    fn encoded_len(&self) -> usize {
        self.name.len().saturating_add(1).saturating_add(self.value.len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let name = TextRef::from(self.name);
        let len = name.check_open(NAME, 0, 1, to_u32(TEXT_MAX))?;
        Writer::run_behind(Self::STREAM, len, self.value.len(), buf, |out| {
            name.write(out);
            out.put(self.value);
        })
    }
}

#[cfg(feature = "alloc")]
pub use owned::NameWrite;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::bridge;
    use crate::text::CncString;

    /// [`NameWriteRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Encode, NameWrite};
    ///
    /// let write = NameWrite { name: "V.E.test[4]".parse()?, value: 123_i32.to_le_bytes().to_vec() };
    /// assert_eq!(write.to_vec()?, b"V.E.test[4]\0\x7b\0\0\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct NameWrite {
        /// Name of the variable.
        pub name: CncString,
        /// The bytes of the value.
        pub value: Vec<u8>,
    }

    #[binrw::binread]
    #[br(little, import(name_len: usize))]
    struct Wire {
        #[br(parse_with = bridge::leading_text, args(name_len))]
        name: CncString,
        #[br(parse_with = bridge::rest)]
        value: Vec<u8>,
    }

    impl<'a> Decode<'a> for NameWrite {
        const STREAM: Stream = Stream::VariableNameWrite;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            let name_len = NameWriteRef::decode(bytes)?.name.len();
            let Wire { name, value } = bridge::read_with(Self::STREAM, bytes, (name_len,))?;
            Ok(Self { name, value })
        }
    }

    impl NameWrite {
        /// The request, borrowed.
        #[inline]
        pub fn as_ref(&self) -> NameWriteRef<'_> {
            NameWriteRef { name: self.name.as_cnc_str(), value: &self.value }
        }
    }

    crate::stream::encode_as_ref!(NameWrite);
}
