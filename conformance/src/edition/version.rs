//! Versions of a CNC, and the features that depend on the version.

use std::fmt;
use std::str::FromStr;

use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::Support;

/// The version of a CNC, such as `V2.11.2077`, `V3.1.3081.07` or `V4.18.0`.
///
/// A version is parsed with or without the V, and with or without a dot after the V: `ads-de` and
/// `service-*` print versions in different forms. A missing fourth number is taken as 0. `Display`
/// omits a fourth number of 0 and writes any other fourth number with at least two digits.
///
/// Manual: `ads-de` 1.051, section 4.1; `service-en` and `service-de` 1.03, section 1.
///
/// ```
/// use ads_cnc_conformance::edition::CncVersion;
///
/// let version = CncVersion::new("V.3.1.3057.03")?;
/// assert_eq!(version, CncVersion::from_parts(3, 1, 3057, 3));
/// assert_eq!(version.to_string(), "V3.1.3057.03");
/// assert!(version < CncVersion::new("3.1.3115")?);
/// assert_eq!(
///     CncVersion::new("V4.18").unwrap_err().to_string(),
///     "cnc-version: build at offset 5: expected a number, found the end"
/// );
/// # Ok::<(), ads_cnc_conformance::edition::VersionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CncVersion {
    pub major: u16,
    pub minor: u16,
    pub build: u16,
    /// 0 if the version has only three numbers.
    pub patch: u16,
}

impl CncVersion {
    /// Parses a version.
    ///
    /// # Errors
    /// - After an optional `V` or `V.`, a character is neither a digit nor a dot between two
    ///   numbers, or follows the fourth number.
    /// - There are fewer than three numbers, or a number has no digits.
    /// - A number exceeds 65 535.
    pub fn new(text: &str) -> Result<Self, VersionError> {
        let mut scan = VersionScan { text, at: 0 };
        if scan.skip(b'V') {
            scan.skip(b'.');
        }
        let major = scan.number("major")?;
        scan.dot("minor")?;
        let minor = scan.number("minor")?;
        scan.dot("build")?;
        let build = scan.number("build")?;
        let mut patch = 0;
        if scan.next().is_some() {
            scan.dot("patch")?;
            patch = scan.number("patch")?;
        }
        if scan.next().is_some() {
            return Err(scan.error("patch"));
        }
        Ok(Self { major, minor, build, patch })
    }

    /// Creates a version from its numbers; `patch` is 0 if the version has only three numbers.
    pub const fn from_parts(major: u16, minor: u16, build: u16, patch: u16) -> Self {
        Self { major, minor, build, patch }
    }

    /// The branch: the major number, and up to V3 also the minor number, because V2.11 and V3.1
    /// count their builds separately. From V4 on, all minor numbers are assumed to be one branch,
    /// because the documents name only V4.18.0 and V4.29.0 of V4.
    const fn branch(self) -> (u16, u16) {
        match self.major {
            0..=3 => (self.major, self.minor),
            _ => (self.major, 0),
        }
    }

    /// Whether a CNC of this version has a feature.
    ///
    /// | this version, compared with the versions in [`Feature::since`] | available | |
    /// |---|---|---|
    /// | before the first listed version of its branch | no | |
    /// | the last listed version of its branch, or later | yes | |
    /// | between both: a listed version, or a later patch of the same build | yes | |
    /// | between both: any other build | no | assumed: otherwise, a later version would not be listed |
    /// | of a branch later than the branch of each listed version | yes | assumed |
    /// | of any other branch without a listed version | no | assumed |
    ///
    /// ```
    /// use ads_cnc_conformance::edition::{CncVersion, Feature};
    ///
    /// let has = |version| CncVersion::new(version).unwrap().has(Feature::DynamicVariables);
    /// assert_eq!(has("V3.1.3081.06").to_string(), "no (VAR-19)");
    /// assert_eq!(has("V3.1.3081.07").to_string(), "yes (VAR-19)");
    /// assert_eq!(has("V3.1.3100").to_string(), "no (VAR-19, assumed)");
    /// assert_eq!(has("V3.1.3115").to_string(), "yes (VAR-19)");
    /// assert_eq!(has("V5.0.0").to_string(), "yes (VAR-19, assumed)");
    /// ```
    pub fn has(self, feature: Feature) -> Support {
        let (since, requirement) = (feature.since(), feature.requirement());
        let of_branch = || since.iter().filter(|first| first.branch() == self.branch());
        let (Some(first), Some(last)) = (of_branch().min(), of_branch().max()) else {
            let newest = since.iter().max().map(|newest| newest.branch());
            return Support::assumed(newest < Some(self.branch()), requirement);
        };
        let patched = |first: &CncVersion| first.build == self.build && *first <= self;
        if self < *first {
            Support::documented(false, requirement)
        } else if *last <= self || of_branch().any(patched) {
            Support::documented(true, requirement)
        } else {
            Support::assumed(false, requirement)
        }
    }
}

impl FromStr for CncVersion {
    type Err = VersionError;

    fn from_str(text: &str) -> Result<Self, VersionError> {
        Self::new(text)
    }
}

impl fmt::Display for CncVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { major, minor, build, patch } = self;
        write!(f, "V{major}.{minor}.{build}")?;
        if *patch == 0 { Ok(()) } else { write!(f, ".{patch:02}") }
    }
}

impl fmt::Debug for CncVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CncVersion({self})")
    }
}

/// A feature that a CNC has from some version on; see [`CncVersion::has`].
///
/// ```
/// use ads_cnc_conformance::edition::{CncVersion, Feature};
///
/// let since = [CncVersion::new("V2.11.2030.01")?, CncVersion::new("V3.1.3057.03")?];
/// assert_eq!(Feature::ServiceInterface.since(), since);
/// # Ok::<(), ads_cnc_conformance::edition::VersionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Feature {
    /// V.P, V.L and V.S on the channel interface, "with restrictions": by name only (VAR-19;
    /// `ads-de` 1.051, section 4.1).
    DynamicVariables,
    /// The description by name, index offset 0x4C (VAR-28; documented in the vendors' public help
    /// pages only: section 4.2.1 of both editions marks it as reserved).
    DescriptionByName,
    /// The Service Interface (SVC-11; `service-en` and `service-de` 1.03, section 1).
    ServiceInterface,
}

impl Feature {
    /// All features.
    pub const ALL: &'static [Self] =
        &[Self::DynamicVariables, Self::DescriptionByName, Self::ServiceInterface];

    /// The feature that a function requires; `None` if every version has the function.
    pub const fn of(function: Function) -> Option<Self> {
        match function {
            Function::DescribeByName => Some(Self::DescriptionByName),
            _ => None,
        }
    }

    /// The versions that a manual, or the vendors' help page, names as the first versions with the
    /// feature, in ascending order.
    pub const fn since(self) -> &'static [CncVersion] {
        const fn v(major: u16, minor: u16, build: u16, patch: u16) -> CncVersion {
            CncVersion::from_parts(major, minor, build, patch)
        }
        match self {
            Self::DynamicVariables => {
                const {
                    &[
                        v(2, 11, 2077, 0),
                        v(2, 11, 2847, 0),
                        v(3, 1, 3081, 7),
                        v(3, 1, 3115, 0),
                        v(4, 18, 0, 0),
                    ]
                }
            }
            Self::DescriptionByName => const { &[v(3, 1, 3132, 0), v(4, 29, 0, 0)] },
            Self::ServiceInterface => const { &[v(2, 11, 2030, 1), v(3, 1, 3057, 3)] },
        }
    }

    /// The requirement that lists the versions.
    pub const fn requirement(self) -> &'static str {
        match self {
            Self::DynamicVariables => VAR_19.as_str(),
            Self::DescriptionByName => VAR_28.as_str(),
            Self::ServiceInterface => SVC_11.as_str(),
        }
    }
}

/// The reason why a text is not a version.
///
/// ```
/// use ads_cnc_conformance::edition::CncVersion;
///
/// let error = CncVersion::new("V4,18.0").unwrap_err();
/// assert_eq!(error.to_string(), "cnc-version: minor at offset 2: unexpected ','");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cnc-version: {part} at offset {offset}: {fault}")]
pub struct VersionError {
    part: &'static str,
    /// The byte offset of the fault. All characters before it are ASCII.
    offset: usize,
    fault: VersionFault,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
enum VersionFault {
    #[error("expected a number, found the end")]
    Truncated,
    #[error("unexpected '{0}'")]
    Unexpected(char),
    #[error("unexpected U+{0:04X}")]
    NotPrintable(u32),
    #[error("expected at most 65535, found {0}")]
    OutOfRange(u32),
}

struct VersionScan<'a> {
    text: &'a str,
    /// The byte offset of the next character. All characters before it are ASCII.
    at: usize,
}

impl VersionScan<'_> {
    fn next(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip(&mut self, byte: u8) -> bool {
        let skips = self.next() == Some(byte);
        self.at = self.at.saturating_add(skips.into());
        skips
    }

    /// Consumes the dot before a part.
    fn dot(&mut self, part: &'static str) -> Result<(), VersionError> {
        if self.skip(b'.') { Ok(()) } else { Err(self.error(part)) }
    }

    fn number(&mut self, part: &'static str) -> Result<u16, VersionError> {
        let (start, mut number) = (self.at, 0_u32);
        while let Some(digit) = self.next().filter(u8::is_ascii_digit) {
            number = number.saturating_mul(10).saturating_add(u32::from(digit & 0x0F));
            self.at = self.at.saturating_add(1);
        }
        if self.at == start {
            return Err(self.error(part));
        }
        let fault = VersionFault::OutOfRange(number);
        u16::try_from(number).map_err(|_| VersionError { part, offset: start, fault })
    }

    /// The error for a wrong or missing next character.
    fn error(&self, part: &'static str) -> VersionError {
        let fault = match self.text.get(self.at..).and_then(|rest| rest.chars().next()) {
            Some(character) if character.is_ascii_graphic() => VersionFault::Unexpected(character),
            Some(character) => VersionFault::NotPrintable(character.into()),
            None => VersionFault::Truncated,
        };
        VersionError { part, offset: self.at, fault }
    }
}
