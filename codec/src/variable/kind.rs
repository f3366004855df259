//! Kinds of variables, the request and the reply for the number of variables of a kind, and the
//! request for a description or an extended description by index (VAR-1 … VAR-3).

use core::fmt;
use core::hash::{Hash, Hasher};

use crate::declare::stream;
use crate::error::Error;
use crate::text::{CncStr, TextRef};

/// A kind of variables, such as `V.E`: the text without a final dot.
///
/// Any CP1252 text without a NUL is accepted, because the CNC determines which kinds a function
/// supports. The editions differ:
///
/// | | `ads-en` 1.05 | `ads-de` 1.051 |
/// |---|---|---|
/// | on the channel interface | V.E, V.G, V.A, V.CYC | V.E, V.G, V.A, V.CYC; and V.P, V.L, V.S from V2.11.2077, V2.11.2847, V3.1.3081.07, V3.1.3115 and V4.18.0 on |
/// | by name only, without a handle (0x46, 0x47, 0x49) | V.CYC | V.CYC, V.P, V.L, V.S |
///
/// Requirements: VAR-18, VAR-19.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.1 and 4.3.1.
///
/// ```
/// use ads_cnc::Kind;
///
/// assert_eq!(Kind::new("V.E")?, Kind::V_E);
/// assert!(Kind::ALL.text().is_empty());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Kind<'a>(TextRef<'a>);

impl<'a> Kind<'a> {
    /// Global variables.
    pub const V_G: Kind<'static> = Kind::ascii(b"V.G");
    /// External variables.
    pub const V_E: Kind<'static> = Kind::ascii(b"V.E");
    /// Axis variables.
    pub const V_A: Kind<'static> = Kind::ascii(b"V.A");
    /// Cycle variables, by name only (VAR-18).
    pub const V_CYC: Kind<'static> = Kind::ascii(b"V.CYC");
    /// Variables of the kind V.P, on the channel interface by name only (VAR-18, VAR-19).
    pub const V_P: Kind<'static> = Kind::ascii(b"V.P");
    /// Variables of the kind V.L, on the channel interface by name only (VAR-18, VAR-19).
    pub const V_L: Kind<'static> = Kind::ascii(b"V.L");
    /// Variables of the kind V.S, on the channel interface by name only (VAR-18, VAR-19).
    pub const V_S: Kind<'static> = Kind::ascii(b"V.S");
    /// V.E, V.G and V.A together; valid only for counting variables.
    pub const ALL: Kind<'static> = Kind::ascii(b"");

    const fn ascii(text: &'static [u8]) -> Kind<'static> {
        Kind(TextRef::with_tail(CncStr::without_nul(text), Some(&[])))
    }

    /// The kind with this name.
    ///
    /// The syntax is not checked. [`VariablePath::new`](crate::VariablePath::new) checks the kind in
    /// the name of a variable.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(text: &'a str) -> Result<Self, Error> {
        TextRef::new(text).map(Self)
    }

    /// The kind in a text field.
    pub const fn from_field(field: TextRef<'a>) -> Self {
        Self(field)
    }

    /// The text.
    #[inline]
    pub const fn text(&self) -> CncStr<'a> {
        self.0.text()
    }

    /// The text field, including its end.
    pub const fn field(&self) -> TextRef<'a> {
        self.0
    }
}

/// Compares the texts; NULs after a text are not part of the kind (E-34).
impl PartialEq for Kind<'_> {
    fn eq(&self, other: &Kind<'_>) -> bool {
        self.text() == other.text()
    }
}

impl Eq for Kind<'_> {}

impl Hash for Kind<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.text().hash(state);
    }
}

/// Displays the text.
impl fmt::Display for Kind<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.text(), f)
    }
}

impl fmt::Debug for Kind<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

stream! {
    /// The request for the number of variables of a kind.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.1.
    ///
    /// `decode` can fail with [`MissingNul`](crate::ErrorKind::MissingNul),
    /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableKindRef};
    ///
    /// assert_eq!(VariableKindRef::decode(b"V.E\0")?.kind.text(), "V.E");
    /// // The empty kind requests the sum of V.E, V.G and V.A. `Kind::ALL` is encoded as one NUL,
    /// // but a request without any bytes is also accepted.
    /// assert!(VariableKindRef::decode(b"")?.kind.text().is_empty());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableKind "variable-kind", "Number of variable elements, request", "VAR-1", max 256;
    struct VariableKindRef<'a> / VariableKind {
        @0 kind: OPTIONAL_CSTRING(256) as Kind, "VAR-1", "V.G, V.E or V.A; empty for all";
    }
}

stream! {
    /// The number of variables of a kind.
    ///
    /// The indices of the variables are 0 to this number minus 1.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.1.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableCount};
    ///
    /// assert_eq!(VariableCount::decode(&[123, 0, 0, 0])?, VariableCount(123));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableCount "variable-count", "Number of variable elements, reply", "VAR-2", max 4;
    tuple VariableCount {
        @0 count: UNS32, "VAR-2", "variables of the kind; the largest index is one less";
    }
}

crate::number::shown!(VariableCount);

stream! {
    /// The request for the description, or the extended description, of a variable by its index.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.2 and 4.3.8.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`MissingNul`](crate::ErrorKind::MissingNul), [`Trailing`](crate::ErrorKind::Trailing) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Encode, Kind, VariableIndexKindRef};
    ///
    /// let mut buf = [0; 8];
    /// let request = VariableIndexKindRef { index: 2, kind: Kind::V_E };
    /// assert_eq!(request.encode(&mut buf)?, b"\x02\0\0\0V.E\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableIndexKind "variable-index-kind", "Variable description by index, request", "VAR-3", max 260;
    struct VariableIndexKindRef<'a> / VariableIndexKind {
        @0 index: UNS32,                "VAR-3", "index of the variable, from 0";
        @4 kind: CSTRING(256) as Kind, "VAR-3", "V.G, V.E or V.A";
    }
}
