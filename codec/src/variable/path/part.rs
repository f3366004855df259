//! The parts of a name.

use core::fmt;
use core::iter::FusedIterator;

use super::super::U32List;
use crate::text::CncStr;

/// A part of a name: a structure, the variable or the axis, with its indices.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.1 (VAR-20).
///
/// ```
/// use ads_cnc::{CncStr, U32List, PathPart};
///
/// let part = PathPart { name: CncStr::new("NP")?, indices: U32List::from(&[0]) };
/// assert_eq!(part.to_string(), "NP[0]");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathPart<'a> {
    /// The name of the part.
    pub name: CncStr<'a>,
    /// Index in each dimension, from 0. The indices of the last part select an element.
    pub indices: U32List<'a>,
}

impl fmt::Display for PathPart<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.name, f)?;
        self.indices.iter().try_for_each(|index| write!(f, "[{index}]"))
    }
}

/// An iterator over the parts of a name after its kind: see
/// [`VariablePath::parts`](super::VariablePath::parts).
///
/// ```
/// use ads_cnc::VariablePath;
///
/// let path = VariablePath::new("V.E.test[4]")?;
/// let mut parts = path.parts();
/// assert_eq!(parts.next().unwrap().to_string(), "test[4]");
/// assert!(parts.next().is_none());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PathParts<'a>(CncStr<'a>);

impl<'a> PathParts<'a> {
    /// Creates an iterator over the text after the kind of a checked name.
    pub(super) const fn new(rest: CncStr<'a>) -> Self {
        Self(rest)
    }
}

impl<'a> Iterator for PathParts<'a> {
    type Item = PathPart<'a>;

    fn next(&mut self) -> Option<PathPart<'a>> {
        let offset_of = |text: CncStr<'a>, wanted: u8| {
            let raw = text.raw();
            raw.iter().position(|&byte| byte == wanted).unwrap_or(raw.len())
        };
        // Skip the dot, which precedes every part.
        let (dot, rest) = self.0.split_at(1);
        if dot.is_empty() {
            return None;
        }
        let (part, rest) = rest.split_at(offset_of(rest, b'.'));
        let (name, indices) = part.split_at(offset_of(part, b'['));
        self.0 = rest;
        Some(PathPart { name, indices: U32List::from_name(indices.raw()) })
    }
}

impl FusedIterator for PathParts<'_> {}
