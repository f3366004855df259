//! Arguments of the constructors of operations: names and values.

use core::fmt;
use core::hash::{Hash, Hasher};

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use crate::content::ContentRef;
use crate::error::Error;
use crate::text::{CncStr, TextRef};
#[cfg(feature = "alloc")]
use crate::text::{CncString, Text};
use crate::value::Elements;
use crate::value::numbers;
use crate::variable::{ValueRef, VariablePath};

/// The name of a variable or parameter: a reference to any `AsRef<str>`, such as `&str` or `&String`;
/// [`CncStr`], [`TextRef`], [`VariablePath`] and, with `alloc`, `&CncString` and `&Text`. The text is
/// not copied.
///
/// Any CP1252 text without a NUL is accepted; the encoder of the request checks its length. To
/// check the syntax of the name of a variable, use [`VariablePath::new`].
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.1.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::ReadByName;
/// use ads_cnc::{CncStr, VariablePath};
///
/// let channel = Channel::new(1)?;
/// let op = ReadByName::new(channel, "V.E.Testvar")?;
/// assert_eq!(ReadByName::new(channel, CncStr::from_bytes(b"V.E.Testvar")?)?, op);
/// assert_eq!(ReadByName::new(channel, VariablePath::new("V.E.Testvar[3]")?.variable())?, op);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not the name of a variable or parameter",
    note = "pass a reference, such as `&str` or `&String`, or a `CncStr`, `TextRef` or `VariablePath`"
)]
pub trait IntoName<'a> {
    /// The name as CP1252 text.
    ///
    /// # Errors
    /// For a reference to a Rust string, those of [`CncStr::new`]. The conversion of a type that
    /// contains CP1252 text does not fail.
    fn into_name(self) -> Result<CncStr<'a>, Error>;
}

impl<'a, T: AsRef<str> + ?Sized> IntoName<'a> for &'a T {
    fn into_name(self) -> Result<CncStr<'a>, Error> {
        CncStr::new(self.as_ref())
    }
}

impl<'a> IntoName<'a> for CncStr<'a> {
    fn into_name(self) -> Result<CncStr<'a>, Error> {
        Ok(self)
    }
}

/// Converts the text without its end, because a new request ends the name with one NUL.
impl<'a> IntoName<'a> for TextRef<'a> {
    fn into_name(self) -> Result<CncStr<'a>, Error> {
        Ok(self.text())
    }
}

impl<'a> IntoName<'a> for VariablePath<'a> {
    fn into_name(self) -> Result<CncStr<'a>, Error> {
        Ok(self.text())
    }
}

#[cfg(feature = "alloc")]
impl<'a> IntoName<'a> for &'a CncString {
    fn into_name(self) -> Result<CncStr<'a>, Error> {
        Ok(self.as_cnc_str())
    }
}

#[cfg(feature = "alloc")]
impl<'a> IntoName<'a> for &'a Text {
    fn into_name(self) -> Result<CncStr<'a>, Error> {
        Ok(self.text.as_cnc_str())
    }
}

/// A value to write: a number, a `bool` or `Boolean`, or the bytes of a value.
///
/// **The Rust type determines the bytes.** The bytes do not contain the type, so neither an
/// operation nor the CNC can detect a wrong type of the right size: `7_f32` for an SGN32 writes
/// 1 088 421 888. To reject a value of another type or size, use [`Shape::encode`] with the
/// description of the variable.
///
/// Encode an array or a text into a buffer first, with [`EncodeValue`](crate::value::EncodeValue).
/// Pass bytes as a slice or, with `alloc`, as a reference to a vector. A reference to an array,
/// such as `&[1, 2]`, does not compile, because it would write two bytes whatever the type of the
/// variable.
///
/// ```compile_fail,E0277
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::WriteByName;
///
/// let _ = WriteByName::new(Channel::new(1)?, "V.E.test", &[1_u8, 2]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
///
/// [`Shape::encode`]: crate::value::Shape::encode
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.6 and 4.3.7.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{Operation, WriteByName};
/// use ads_cnc::value::EncodeValue;
///
/// let channel = Channel::new(1)?;
/// let on = WriteByName::new(channel, "V.E.on", true)?;
/// assert_eq!(on.encode(&mut [0; 16])?, b"V.E.on\0\x01");
///
/// let x = WriteByName::new(channel, "V.E.x", 1.5_f64)?;
/// assert_eq!(x.value.as_bytes(), 1.5_f64.to_le_bytes());
///
/// let mut room = [0; 20];
/// let array = [123, 234, 345, 456, 567].encode_value(&mut room)?;
/// assert_eq!(WriteByName::new(channel, "V.E.test", array)?.value.as_bytes().len(), 20);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct WriteValue<'a>(Source<'a>);

#[derive(Clone, Copy)]
enum Source<'a> {
    Bytes(&'a [u8]),
    /// The number in the first `len` bytes of `bytes`.
    Number {
        bytes: [u8; 8],
        len: usize,
    },
}

impl WriteValue<'_> {
    /// The bytes to write.
    pub fn as_bytes(&self) -> &[u8] {
        match &self.0 {
            Source::Bytes(bytes) => bytes,
            Source::Number { bytes, len } => bytes.get(..*len).unwrap_or_default(),
        }
    }

    fn number<const N: usize>(number: [u8; N]) -> Self {
        let mut bytes = [0; 8];
        bytes.iter_mut().zip(number).for_each(|(to, from)| *to = from);
        Self(Source::Number { bytes, len: N })
    }
}

macro_rules! from_numbers {
    ($( $data_type:ident: $number:ty; )+) => { $(
        impl From<$number> for WriteValue<'_> {
            fn from(number: $number) -> Self {
                Self::number(number.to_le_bytes())
            }
        }
    )+ };
}

numbers!(from_numbers!);

impl From<bool> for WriteValue<'_> {
    fn from(value: bool) -> Self {
        u8::from(value).into()
    }
}

impl<'a> From<&'a [u8]> for WriteValue<'a> {
    fn from(bytes: &'a [u8]) -> Self {
        Self(Source::Bytes(bytes))
    }
}

#[cfg(feature = "alloc")]
impl<'a> From<&'a Vec<u8>> for WriteValue<'a> {
    fn from(bytes: &'a Vec<u8>) -> Self {
        Self(Source::Bytes(bytes))
    }
}

/// Writes the bytes of the elements.
impl<'a> From<Elements<'a>> for WriteValue<'a> {
    fn from(elements: Elements<'a>) -> Self {
        Self(Source::Bytes(elements.as_bytes()))
    }
}

impl<'a> From<ValueRef<'a>> for WriteValue<'a> {
    fn from(value: ValueRef<'a>) -> Self {
        Self(Source::Bytes(value.bytes))
    }
}

impl<'a> From<ContentRef<'a>> for WriteValue<'a> {
    fn from(content: ContentRef<'a>) -> Self {
        Self(Source::Bytes(content.bytes))
    }
}

impl PartialEq for WriteValue<'_> {
    fn eq(&self, other: &WriteValue<'_>) -> bool {
        self.as_bytes() == other.as_bytes()
    }
}

impl Eq for WriteValue<'_> {}

impl Hash for WriteValue<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.as_bytes().hash(state);
    }
}

impl fmt::Debug for WriteValue<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_bytes(), f)
    }
}
