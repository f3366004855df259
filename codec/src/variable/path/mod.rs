//! Names of variables and their parts (VAR-20).

mod build;
mod part;
mod scan;

use core::fmt;
use core::hash::{Hash, Hasher};

pub use part::{PathPart, PathParts};

use super::{Kind, U32List};
use crate::error::Error;
use crate::text::CncStr;

/// The largest index: one less than the greatest number of elements that an UNS32 can contain
/// (VAR-2).
const INDEX_MAX: u32 = u32::MAX - 1;

// Checks that a name cannot have more indices than a request by handle.
const _: () = assert!((crate::limits::NAME_MAX - 5) / 3 <= crate::limits::INDICES_MAX);

/// The name of a variable: its kind, its parts with their indices, and the indices of an element.
///
/// | part of `V.G.NP[0].V[1]` | meaning | method |
/// |---|---|---|
/// | `V.G` | kind | [`kind`](Self::kind) |
/// | `NP[0]` | structure with its index; belongs to the path | [`parts`](Self::parts) |
/// | `V` | the variable in the structure, an array | [`parts`](Self::parts) |
/// | `[1]` | element of the array | [`elements`](Self::elements) |
/// | `V.G.NP[0].V` | name of the whole array, as in its description | [`variable`](Self::variable) |
///
/// Indices before a dot belong to the path; indices at the end select an element. This is derived from
/// the examples. The following is assumed:
/// - Several dimensions are written `[i][j]`.
/// - A kind is `V.` and one part, which need not be documented.
/// - A part is any CP1252 text of at least one character, without `.`, `[`, `]` and NUL.
/// - An index consists of one or more decimal digits.
///
/// Two names are equal if their characters are equal. A name does not show whether the variable exists
/// or is an array; its description does.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.1 (VAR-20); the axis: 4.1 and 4.2.2.
///
/// ```
/// use ads_cnc::{Handle, HandleReadRef, Kind, U32List, VariablePath};
///
/// let path = VariablePath::new("V.G.NP[0].V[1]")?;
/// assert_eq!(path.kind(), Kind::V_G);
/// assert_eq!(path.variable().text(), "V.G.NP[0].V");
/// assert_eq!(path.elements(), U32List::from(&[1]));
///
/// // Read the same element by the handle of the array.
/// let by_handle = HandleReadRef { handle: Handle(0x2001234), indices: path.elements() };
///
/// // Build a name from another name.
/// let mut buf = [0; 32];
/// let other = path.variable().write_element(U32List::from(&[4]), &mut buf)?;
/// assert_eq!(other.text(), "V.G.NP[0].V[4]");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
///
/// A range is not a valid name:
///
/// ```
/// # use ads_cnc::VariablePath;
/// assert_eq!(
///     VariablePath::new("V.G.array[0 .. 9]").unwrap_err().to_string(),
///     "variable-path: index at offset 11: unexpected U+0020"
/// );
/// ```
#[derive(Clone, Copy)]
pub struct VariablePath<'a> {
    text: CncStr<'a>,
    /// The offset of the dot after the kind, in the bytes of the text.
    kind_end: usize,
    /// The offset of the indices at the end, or of the end if there are no indices, in the bytes of
    /// the text.
    variable_end: usize,
}

impl<'a> VariablePath<'a> {
    /// Parses a name.
    ///
    /// # Errors
    /// Offsets count characters.
    /// - Those of [`CncStr::new`].
    /// - [`Unexpected`](crate::ErrorKind::Unexpected): a name that does not begin with `V.`, an
    ///   empty part before a dot or bracket, an index after the kind, an index that is empty or
    ///   contains a character other than a decimal digit, text after an index, or `]` outside an
    ///   index.
    /// - [`Truncated`](crate::ErrorKind::Truncated): the name ends in or after its kind, after a
    ///   dot or in an index.
    /// - [`OutOfRange`](crate::ErrorKind::OutOfRange): an index greater than 4 294 967 294; an
    ///   index that exceeds 32 bits is reported as 4 294 967 295.
    /// - [`TooLong`](crate::ErrorKind::TooLong): more than 255 characters (VAR-9).
    pub fn new(text: &'a str) -> Result<Self, Error> {
        Self::from_text(CncStr::new(text)?)
    }

    /// Like [`new`](Self::new), but from CP1252 text.
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableNameRef, VariablePath};
    ///
    /// let request = VariableNameRef::decode(b"V.E.Testvar[3]\0")?;
    /// let path = VariablePath::from_text(request.name.text())?;
    /// assert_eq!(path.variable().text(), "V.E.Testvar");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`new`](Self::new), except those of [`CncStr::new`].
    pub fn from_text(text: CncStr<'a>) -> Result<Self, Error> {
        let scan::Ends { kind, variable } = scan::name(text)?;
        Ok(Self { text, kind_end: kind, variable_end: variable })
    }

    /// The name.
    #[inline]
    pub const fn text(&self) -> CncStr<'a> {
        self.text
    }

    /// The kind: `V.E`, `V.G`, `V.A`, `V.CYC`, `V.P`, `V.L`, `V.S` or another.
    pub fn kind(&self) -> Kind<'a> {
        Kind::from_field(self.text.split_at(self.kind_end).0.into())
    }

    /// The parts after the kind: any structures, then the variable, then the axis in a V.A name for
    /// the channel interface. There is at least one part.
    ///
    /// ```
    /// use ads_cnc::{U32List, VariablePath};
    ///
    /// let path = VariablePath::new("V.E.struct1[5].struct2[8].array_sgn32")?;
    /// let parts: Vec<String> = path.parts().map(|part| part.to_string()).collect();
    /// assert_eq!(parts, ["struct1[5]", "struct2[8]", "array_sgn32"]);
    /// assert_eq!(path.parts().nth(1).unwrap().indices, U32List::from(&[8]));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    pub fn parts(&self) -> PathParts<'a> {
        PathParts::new(self.text.split_at(self.kind_end).1)
    }

    /// The indices at the end, which select an element of an array; empty for the whole array.
    pub fn elements(&self) -> U32List<'a> {
        U32List::from_name(self.text.split_at(self.variable_end).1.raw())
    }

    /// The name without the indices at its end: the name of the whole array, if the variable is an
    /// array.
    pub fn variable(&self) -> Self {
        Self { text: self.text.split_at(self.variable_end).0, ..*self }
    }

    /// The instance identifier of the axis in a V.A name for the channel interface: the last part, if
    /// the name has two or more parts.
    ///
    /// A name for the axis interface does not contain the axis: its last part is the variable. A name
    /// does not show which interface it is for.
    ///
    /// ```
    /// use ads_cnc::VariablePath;
    ///
    /// let on_channel = VariablePath::new("V.A.ACT_POS.X")?;
    /// assert_eq!(on_channel.axis().unwrap(), "X");
    /// let on_axis = VariablePath::new("V.A.ACT_POS")?;
    /// assert_eq!(on_axis.axis(), None);
    /// assert_eq!(VariablePath::new("V.E.trajectory.vector.x")?.axis(), None);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    pub fn axis(&self) -> Option<CncStr<'a>> {
        let axis = self.parts().skip(1).last()?;
        (self.kind() == Kind::V_A).then_some(axis.name)
    }
}

impl PartialEq for VariablePath<'_> {
    fn eq(&self, other: &VariablePath<'_>) -> bool {
        self.text == other.text
    }
}

impl Eq for VariablePath<'_> {}

impl Hash for VariablePath<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.text.hash(state);
    }
}

impl fmt::Display for VariablePath<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.text, f)
    }
}

impl fmt::Debug for VariablePath<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.text, f)
    }
}
