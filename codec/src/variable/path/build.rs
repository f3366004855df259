//! Building names of variables.

use super::super::{Kind, U32List};
use super::{PathPart, VariablePath, scan};
use crate::bytes::{Writer, to_u32};
use crate::error::{Error, ErrorKind};
use crate::layout::Subject;
use crate::layout::variable_path::{INDEX, KIND, PART};
use crate::text::CncStr;

/// Building names. [`VariablePath::from_text`] parses each result into the same parts. A buffer of
/// [`NAME_MAX`](crate::limits::NAME_MAX) bytes is always large enough.
impl<'a> VariablePath<'a> {
    /// Builds a name from its parts.
    ///
    /// ```
    /// use ads_cnc::{CncStr, Kind, U32List, PathPart, VariablePath};
    ///
    /// let np = PathPart { name: CncStr::new("NP")?, indices: U32List::from(&[0]) };
    /// let v = PathPart { name: CncStr::new("V")?, indices: U32List::EMPTY };
    /// let mut buf = [0; 32];
    /// let path = VariablePath::write(Kind::V_G, [np, v], &mut buf)?;
    /// assert_eq!(path.text(), "V.G.NP[0].V");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// A kind, name of a part, index or length that [`new`](Self::new) would reject, a name without
    /// parts, or a buffer that is too small. On error, nothing is written.
    pub fn write<'p, P>(kind: Kind<'_>, parts: P, buf: &'a mut [u8]) -> Result<Self, Error>
    where
        P: IntoIterator<Item = PathPart<'p>, IntoIter: Clone>,
    {
        let parts = parts.into_iter();
        scan::kind(kind.text())?;
        let kind_end = kind.text().len();
        let mut ends = (kind_end, kind_end);
        for part in parts.clone() {
            ends = check_part(part, ends.1)?;
        }
        let (variable_end, len) = ends;
        if len == kind_end {
            return Err(Error::new(ErrorKind::Truncated, PART, to_u32(len), 1, 0));
        }
        let bytes = Writer::fill(Subject::VariablePath, len, buf, |out| {
            kind.text().write(out);
            parts.for_each(|part| write_part(part, out));
        })?;
        Ok(Self { text: CncStr::without_nul(bytes), kind_end, variable_end })
    }

    /// Builds the name of an element of this array: the name of the array with these indices at its
    /// end.
    ///
    /// ```
    /// use ads_cnc::{U32List, VariablePath};
    ///
    /// let array = VariablePath::new("V.E.test")?;
    /// let mut buf = [0; 16];
    /// assert_eq!(array.write_element(U32List::from(&[4]), &mut buf)?.text(), "V.E.test[4]");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`write`](Self::write); [`ErrorKind::Unexpected`] for a name that already ends in
    /// indices: see [`variable`](Self::variable).
    pub fn write_element<'b>(
        &self,
        indices: U32List<'_>,
        buf: &'b mut [u8],
    ) -> Result<VariablePath<'b>, Error> {
        if !self.elements().is_empty() {
            let at = to_u32(self.variable().text.len());
            return Err(Error::new(ErrorKind::Unexpected, INDEX, at, 0, u32::from(b'[')));
        }
        let last = self.parts().count().saturating_sub(1);
        let parts = self
            .parts()
            .enumerate()
            .map(|(index, part)| if index == last { PathPart { indices, ..part } } else { part });
        VariablePath::write(self.kind(), parts, buf)
    }

    /// Converts a name for the axis interface to the name for the channel interface, by appending the
    /// instance identifier of the axis.
    ///
    /// Indices at the end of the name stay at the end, after the axis. This position is not documented.
    ///
    /// ```
    /// use ads_cnc::{CncStr, VariablePath};
    ///
    /// let on_axis = VariablePath::new("V.A.ACT_POS")?;
    /// let mut buf = [0; 16];
    /// let on_channel = on_axis.write_axis(CncStr::new("X")?, &mut buf)?;
    /// assert_eq!(on_channel.text(), "V.A.ACT_POS.X");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`write`](Self::write); [`ErrorKind::Unexpected`] for a kind other than V.A.
    pub fn write_axis<'b>(
        &self,
        axis: CncStr<'_>,
        buf: &'b mut [u8],
    ) -> Result<VariablePath<'b>, Error> {
        self.check_axis()?;
        let axis = PathPart { name: axis, indices: self.elements() };
        let parts = self.variable();
        VariablePath::write(self.kind(), parts.parts().chain([axis]), buf)
    }

    /// Converts a name for the channel interface to the name for the axis interface, by removing the
    /// part that [`axis`](Self::axis) returns. This reverses [`write_axis`](Self::write_axis).
    ///
    /// ```
    /// use ads_cnc::VariablePath;
    ///
    /// let on_channel = VariablePath::new("V.A.WCS.Y")?;
    /// let mut buf = [0; 16];
    /// assert_eq!(on_channel.write_without_axis(&mut buf)?.text(), "V.A.WCS");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::Unexpected`] for a kind other than V.A, [`ErrorKind::Missing`] for a name without
    /// an axis, or a buffer that is too small.
    pub fn write_without_axis<'b>(&self, buf: &'b mut [u8]) -> Result<VariablePath<'b>, Error> {
        self.check_axis()?;
        let axis = self.variable().text.raw();
        let dot = axis.iter().rposition(|&byte| byte == b'.').unwrap_or(0);
        if dot <= self.kind_end {
            let at = to_u32(self.variable().text.len());
            return Err(Error::new(ErrorKind::Missing, PART, at, 0, 0));
        }
        let before = self.text.split_at(dot).0;
        let elements = self.text.split_at(self.variable_end).1;
        let len = before.len().saturating_add(elements.len());
        let bytes = Writer::fill(Subject::VariablePath, len, buf, |out| {
            before.write(out);
            elements.write(out);
        })?;
        // This cannot fail, because the name without its last part is valid.
        VariablePath::from_text(CncStr::without_nul(bytes))
    }

    fn check_axis(&self) -> Result<(), Error> {
        let kind = self.kind().text();
        if kind == Kind::V_A.text() {
            return Ok(());
        }
        // Find the first character that differs; every kind has at least three characters.
        let mut wanted = Kind::V_A.text().chars();
        let other =
            (0_u32..).zip(kind.chars()).find(|&(_, character)| wanted.next() != Some(character));
        let (at, character) = other.map_or((0, 0), |(at, character)| (at, u32::from(character)));
        Err(Error::new(ErrorKind::Unexpected, KIND, at, 0, character))
    }
}

/// Checks a part whose dot follows `before` characters; returns the start and the end of its
/// indices.
fn check_part(part: PathPart<'_>, before: usize) -> Result<(usize, usize), Error> {
    let start = before.saturating_add(1);
    scan::part(part.name, start)?;
    let indices = start.saturating_add(part.name.len());
    let mut end = indices;
    for index in part.indices.iter() {
        let digits = end.saturating_add(1);
        scan::index(index, digits)?;
        end = digits.saturating_add(digit_count(index)).saturating_add(1);
    }
    scan::check_len(end)?;
    Ok((indices, end))
}

fn write_part(part: PathPart<'_>, out: &mut Writer<'_>) {
    out.put(b".");
    part.name.write(out);
    for index in part.indices.iter() {
        out.put(b"[");
        write_decimal(index, out);
        out.put(b"]");
    }
}

fn digit_count(number: u32) -> usize {
    let more = number.checked_ilog10().unwrap_or(0);
    crate::bytes::to_usize(more.saturating_add(1))
}

fn write_decimal(number: u32, out: &mut Writer<'_>) {
    let mut divisor = 10_u32.saturating_pow(number.checked_ilog10().unwrap_or(0));
    while let Some(digit) = number.checked_div(divisor) {
        let [digit, ..] = (digit % 10).to_le_bytes();
        out.put(&[b'0' | digit]);
        divisor /= 10;
    }
}

#[cfg(feature = "alloc")]
mod owned {
    use super::*;
    use crate::limits::NAME_MAX;
    use crate::text::CncString;

    /// Building names as owned strings.
    impl VariablePath<'_> {
        /// Like [`write_element`](Self::write_element), as an owned string.
        ///
        /// ```
        /// use ads_cnc::{U32List, VariablePath};
        ///
        /// let array = VariablePath::new("V.E.Testvar")?;
        /// assert_eq!(array.element(U32List::from(&[3]))?.to_string(), "V.E.Testvar[3]");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        ///
        /// # Errors
        /// Those of [`write_element`](Self::write_element).
        pub fn element(&self, indices: U32List<'_>) -> Result<CncString, Error> {
            Ok(self.write_element(indices, &mut [0; NAME_MAX])?.text().into())
        }

        /// Like [`write_axis`](Self::write_axis), as an owned string.
        ///
        /// ```
        /// use ads_cnc::{CncStr, VariablePath};
        ///
        /// let on_axis = VariablePath::new("V.A.ACT_POS")?;
        /// assert_eq!(on_axis.with_axis(CncStr::new("X")?)?.to_string(), "V.A.ACT_POS.X");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        ///
        /// # Errors
        /// Those of [`write_axis`](Self::write_axis).
        pub fn with_axis(&self, axis: CncStr<'_>) -> Result<CncString, Error> {
            Ok(self.write_axis(axis, &mut [0; NAME_MAX])?.text().into())
        }

        /// Like [`write_without_axis`](Self::write_without_axis), as an owned string.
        ///
        /// ```
        /// use ads_cnc::VariablePath;
        ///
        /// let on_channel = VariablePath::new("V.A.WCS.Y")?;
        /// assert_eq!(on_channel.without_axis()?.to_string(), "V.A.WCS");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        ///
        /// # Errors
        /// Those of [`write_without_axis`](Self::write_without_axis).
        pub fn without_axis(&self) -> Result<CncString, Error> {
            Ok(self.write_without_axis(&mut [0; NAME_MAX])?.text().into())
        }
    }
}
