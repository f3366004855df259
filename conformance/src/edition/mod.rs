//! Differences between the editions of the manual and between versions of the CNC.
//!
//! - The editions differ in the kinds of variables of the channel interface, and in the kinds that
//!   are accessible by name only (VAR-18, E-15): [`Edition::permits`].
//! - The versions differ in three features: V.P, V.L and V.S on the channel interface (VAR-19), the
//!   description by name, and the Service Interface (SVC-11): [`CncVersion::has`].
//!
//! A client can call these functions before it sends a request, and a server before it answers a
//! request, as the simulated CNC does. The codec itself accepts the kinds of both editions.
//!
//! ```
//! use ads_cnc::VariablePath;
//! use ads_cnc::operation::Function;
//! use ads_cnc_conformance::edition::{CncVersion, Edition};
//!
//! let name = VariablePath::new("V.P.count")?;
//! let version = Some(CncVersion::new("V3.1.3115")?);
//! let may = |edition: Edition, function| edition.permits(function, name.kind(), version);
//!
//! // A variable of this kind has no handle, but can be read by its name.
//! assert_eq!(may(Edition::German, Function::HandleByName).to_string(), "no (VAR-18)");
//! assert_eq!(may(Edition::German, Function::ReadByName).to_string(), "yes (VAR-19)");
//! // In the English edition, the channel interface does not have the kind V.P.
//! assert!(!may(Edition::English, Function::ReadByName).available);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod support;
mod version;

use std::fmt;

use ads_cnc::Kind;
use ads_cnc::layout::Stream;
use ads_cnc::operation::{Function, OffsetRule};
use ads_cnc_vectors::ids::*;

pub use support::Support;
pub use version::{CncVersion, Feature, VersionError};

/// An edition of the manual on ADS access.
///
/// | | `ads-en` 1.05 | `ads-de` 1.051 |
/// |---|---|---|
/// | on the channel interface | V.E, V.G, V.A, V.CYC | the same, and from certain [versions](Feature::DynamicVariables) on V.P, V.L, V.S |
/// | by name only: without the index offsets 0x46, 0x47, 0x49 | V.CYC | V.CYC, V.P, V.L, V.S |
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4, 4.1 and 4.2.1 (VAR-18, VAR-19, E-15).
///
/// ```
/// use ads_cnc::Kind;
/// use ads_cnc_conformance::edition::Edition;
///
/// assert_eq!(Edition::English.by_name_only(), [Kind::V_CYC]);
/// assert_eq!(Edition::German.to_string(), "ads-de 1.051");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Edition {
    /// `ads-en` 1.05.
    English,
    /// `ads-de` 1.051.
    German,
}

/// The kinds whose variables have indices.
const INDEXED: &[Kind<'static>] = &[Kind::V_E, Kind::V_G, Kind::V_A];
const KIND_REQUIREMENT: &str = VAR_1.as_str();

/// The kinds that are accessible by name only in at least one edition.
const BY_NAME_ONLY: &[Kind<'static>] = &[Kind::V_CYC, Kind::V_P, Kind::V_L, Kind::V_S];
const BY_NAME_ONLY_REQUIREMENT: &str = VAR_18.as_str();

impl Edition {
    /// Both editions.
    pub const ALL: [Self; 2] = [Self::English, Self::German];

    /// The document: `ads-en` or `ads-de`.
    pub const fn document(self) -> &'static str {
        match self {
            Self::English => "ads-en",
            Self::German => "ads-de",
        }
    }

    /// The edition number: `1.05` or `1.051`.
    pub const fn number(self) -> &'static str {
        match self {
            Self::English => "1.05",
            Self::German => "1.051",
        }
    }

    /// The name: `en-1.05` or `de-1.051`.
    pub fn name(self) -> String {
        let document = self.document();
        let language = document.strip_prefix("ads-").unwrap_or(document);
        format!("{language}-{}", self.number())
    }

    /// The edition with this [`name`](Self::name).
    ///
    /// # Errors
    /// If no edition has this name; the error lists the valid names.
    pub fn by_name(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|edition| edition.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(" and ");
            format!("{name:?} is not an edition; editions: {names}")
        })
    }

    /// The kinds that are accessible by name only: the functions at the index offsets 0x46 (handle
    /// by name), 0x47 and 0x49 (read and write by handle) are not available for these kinds.
    ///
    /// VAR-18
    pub const fn by_name_only(self) -> &'static [Kind<'static>] {
        match self {
            Self::English => &[Kind::V_CYC],
            Self::German => BY_NAME_ONLY,
        }
    }

    /// Whether a function of the channel or axis interface may be called for variables of a kind.
    /// `kind` is the kind in the request or in the name, or the kind of the variable with the
    /// handle.
    ///
    /// Without a version, the newest CNC is assumed. A function that has no kinds is always
    /// available. The requirement in the result is VAR-1 for the number of variables and for the
    /// descriptions by index, otherwise the requirement of the function, except in these cases:
    ///
    /// | case | available | requirement |
    /// |---|---|---|
    /// | a handle of a kind that is accessible by name only | no | VAR-18 |
    /// | V.P, V.L, V.S in `ads-de`, by name | by [version](CncVersion::has) | VAR-19 |
    /// | V.P, V.L, V.S in `ads-en`, where only section 3 describes these kinds | no, assumed | VAR-19 |
    /// | number or description by index of another kind than V.E, V.G, V.A | no, assumed (E-39) | VAR-1 |
    /// | the number of variables of all kinds: [`Kind::ALL`] | yes | VAR-1 |
    /// | description by name, 0x4C | by [version](CncVersion::has); that it has V.CYC, V.P, V.L, V.S is assumed | VAR-28 |
    /// | another kind than V.A on the axis interface | no, assumed | |
    /// | a kind that no manual has, by name or handle | yes, assumed | |
    ///
    /// ```
    /// use ads_cnc::Kind;
    /// use ads_cnc::operation::Function;
    /// use ads_cnc_conformance::edition::Edition;
    ///
    /// let may = |function, kind| Edition::English.permits(function, kind, None);
    /// assert_eq!(may(Function::HandleByName, Kind::V_CYC).to_string(), "no (VAR-18)");
    /// assert_eq!(may(Function::ReadByName, Kind::V_CYC).to_string(), "yes (VAR-14)");
    /// assert_eq!(may(Function::CountVariables, Kind::V_CYC).to_string(), "no (VAR-1, assumed)");
    /// ```
    pub fn permits(
        self,
        function: Function,
        kind: Kind<'_>,
        version: Option<CncVersion>,
    ) -> Support {
        let requirement = function.spec().clause;
        let has = |feature: Feature| match version {
            Some(version) => version.has(feature),
            None => Support::assumed(true, feature.requirement()),
        };
        let (kind, all) = (kind.text(), kind.text().is_empty());
        let is_in = |kinds: &[Kind<'_>]| kinds.iter().any(|known| known.text() == kind);
        let by_name = || {
            if is_in(INDEXED) || is_in(&[Kind::V_CYC]) {
                Support::documented(true, requirement)
            } else if is_in(self.by_name_only()) {
                has(Feature::DynamicVariables)
            } else if is_in(BY_NAME_ONLY) {
                Support::assumed(false, Feature::DynamicVariables.requirement())
            } else {
                Support::assumed(true, requirement)
            }
        };
        match AddressedBy::of(function) {
            AddressedBy::Other => Support::documented(true, requirement),
            AddressedBy::Index if is_in(INDEXED) => Support::documented(true, KIND_REQUIREMENT),
            AddressedBy::Index if all && function == Function::CountVariables => {
                Support::documented(true, KIND_REQUIREMENT)
            }
            AddressedBy::Index => Support::assumed(false, KIND_REQUIREMENT),
            AddressedBy::Handle if is_in(self.by_name_only()) => {
                Support::documented(false, BY_NAME_ONLY_REQUIREMENT)
            }
            AddressedBy::Handle | AddressedBy::Name => {
                match (by_name(), Feature::of(function).map(has)) {
                    (kind, Some(version)) if kind.available => {
                        let assumed = version.assumed || (version.available && !is_in(INDEXED));
                        Support { assumed, ..version }
                    }
                    (kind, _) => kind,
                }
            }
            AddressedBy::Axis if is_in(&[Kind::V_A]) => Support::documented(true, requirement),
            AddressedBy::Axis => Support::assumed(false, requirement),
        }
    }
}

impl fmt::Display for Edition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.document(), self.number())
    }
}

/// How a function addresses a variable.
enum AddressedBy {
    /// By kind and index; or by kind only, for the number of variables.
    Index,
    Handle,
    Name,
    /// By name, on the axis interface.
    Axis,
    /// A function without kinds.
    Other,
}

impl AddressedBy {
    fn of(function: Function) -> Self {
        let spec = function.spec();
        match (spec.offset, spec.request, spec.reply) {
            (OffsetRule::OfAxis(_), ..) => Self::Axis,
            (_, Some(Stream::VariableKind | Stream::VariableIndexKind), _) => Self::Index,
            (_, Some(Stream::VariableHandleRead | Stream::VariableHandleWrite), _)
            | (_, _, Some(Stream::VariableHandle)) => Self::Handle,
            (_, Some(Stream::VariableName | Stream::VariableNameWrite), _) => Self::Name,
            _ => Self::Other,
        }
    }
}
