//! The features of editions and versions, and the format of versions.

use std::collections::BTreeSet;

use ads_cnc::operation::Function;
use ads_cnc::{Decode, Kind, VariableKindRef, VariablePath};
use ads_cnc_conformance::edition::{CncVersion, Edition, Feature, Support};
use proptest::prelude::*;

const BY_HANDLE: [Function; 3] =
    [Function::HandleByName, Function::ReadByHandle, Function::WriteByHandle];
const BY_NAME: [Function; 2] = [Function::ReadByName, Function::WriteByName];
const BY_INDEX: [Function; 3] =
    [Function::CountVariables, Function::DescribeByIndex, Function::DescribeExtended];
const ON_AXIS: [Function; 3] =
    [Function::AxisHandleByName, Function::AxisReadByName, Function::AxisWriteByName];

const YES: (bool, bool) = (true, false);
const NO: (bool, bool) = (false, false);
const YES_ASSUMED: (bool, bool) = (true, true);
const NO_ASSUMED: (bool, bool) = (false, true);

fn version(text: &str) -> CncVersion {
    CncVersion::new(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[track_caller]
fn assert_answer(support: Support, (available, assumed): (bool, bool), requirement: &str) {
    assert_eq!(support, Support { available, requirement: support.requirement, assumed });
    assert_eq!(support.requirement, requirement);
}

/// Versions as printed in `ads-de` 1.051, section 4.1, and in `service-en` and `service-de` 1.03,
/// section 1; the last two are from the vendors' public help pages.
#[test]
fn printed_versions_are_parsed_and_formatted() {
    let mut all = BTreeSet::new();
    for (printed, (major, minor, build, patch), shown) in [
        ("V.2.11.2077", (2, 11, 2077, 0), "V2.11.2077"),
        ("V2.11.2847", (2, 11, 2847, 0), "V2.11.2847"),
        ("V3.1.3081.07", (3, 1, 3081, 7), "V3.1.3081.07"),
        ("V3.1.3115", (3, 1, 3115, 0), "V3.1.3115"),
        ("V4.18.0", (4, 18, 0, 0), "V4.18.0"),
        ("V.2.11.2030.01", (2, 11, 2030, 1), "V2.11.2030.01"),
        ("V.3.1.3057.03", (3, 1, 3057, 3), "V3.1.3057.03"),
        ("V3.1.3132.0", (3, 1, 3132, 0), "V3.1.3132"),
        ("V4.29.0", (4, 29, 0, 0), "V4.29.0"),
    ] {
        let found = version(printed);
        assert_eq!(found, CncVersion::from_parts(major, minor, build, patch), "{printed}");
        assert_eq!(found.to_string(), shown);
        // The V is optional.
        assert_eq!(version(shown.trim_start_matches('V')), found);
        assert_eq!(shown.parse(), Ok(found));
        all.insert(found);
    }
    assert_eq!(all, Feature::ALL.iter().flat_map(|feature| feature.since()).copied().collect());
    assert!(Feature::ALL.iter().all(|feature| feature.since().is_sorted()));
}

#[test]
fn malformed_versions_are_rejected_with_the_offset() {
    let unexpected = |part: &str, offset: usize, found: char| {
        let found = match found {
            '!'..='~' => format!("'{found}'"),
            _ => format!("U+{:04X}", u32::from(found)),
        };
        format!("cnc-version: {part} at offset {offset}: unexpected {found}")
    };
    let cut = |part: &str, offset: usize| {
        format!("cnc-version: {part} at offset {offset}: expected a number, found the end")
    };
    let over = |part: &str, offset: usize, found: u32| {
        let range = format!("expected at most 65535, found {found}");
        format!("cnc-version: {part} at offset {offset}: {range}")
    };
    for (text, wanted) in [
        ("", cut("major", 0)),
        ("V", cut("major", 1)),
        ("V.", cut("major", 2)),
        ("V4", cut("minor", 2)),
        ("V4.", cut("minor", 3)),
        ("V4.18", cut("build", 5)),
        ("V4.18.", cut("build", 6)),
        ("V4.18.0.", cut("patch", 8)),
        ("v4.18.0", unexpected("major", 0, 'v')),
        (" V4.18.0", unexpected("major", 0, ' ')),
        (".4.18.0", unexpected("major", 0, '.')),
        ("V..4.18.0", unexpected("major", 2, '.')),
        ("VV4.18.0", unexpected("major", 1, 'V')),
        ("-4.18.0", unexpected("major", 0, '-')),
        ("V4..0", unexpected("minor", 3, '.')),
        ("V4,18.0", unexpected("minor", 2, ',')),
        ("V4.1\u{e4}.0", unexpected("build", 4, '\u{e4}')),
        ("V4.18.x", unexpected("build", 6, 'x')),
        ("V3-1.3115", unexpected("minor", 2, '-')),
        ("V3\u{a0}1.3115", unexpected("minor", 2, '\u{a0}')),
        ("V4.18.0 ", unexpected("patch", 7, ' ')),
        ("V4.18.0\0", unexpected("patch", 7, '\0')),
        ("V3.1.3081.07.1", unexpected("patch", 12, '.')),
        ("V3.1.3081.07\u{20ac}", unexpected("patch", 12, '\u{20ac}')),
        ("V65536.1.3081", over("major", 1, 65536)),
        ("V3.70000.3081", over("minor", 3, 70000)),
        ("V3.1.99999999999", over("build", 5, u32::MAX)),
        ("3.1.3081.65536", over("patch", 9, 65536)),
    ] {
        assert_eq!(CncVersion::new(text).unwrap_err().to_string(), wanted, "{text:?}");
    }
    assert_eq!(version("65535.65535.65535.65535"), CncVersion::from_parts(!0, !0, !0, !0));
    assert_eq!(version("V003.01.3081.7"), version("V3.1.3081.07"));
}

#[test]
fn versions_are_ordered_by_their_numbers() {
    let ascending = [
        "V2.11.2030.01",
        "V2.11.2077",
        "V2.11.2847",
        "V3.1.3057.03",
        "V3.1.3081",
        "V3.1.3081.07",
        "V3.1.3081.10",
        "V3.1.3115",
        "V4.4.0",
        "V4.18.0",
        "V4.29.0",
    ];
    assert!(ascending.map(version).is_sorted_by(|one, next| one < next));
}

/// The features for versions below, at and above each printed version, and for branches of versions
/// that are not printed (VAR-19, VAR-28, SVC-11).
#[test]
fn versions_have_their_printed_features() {
    let cases: [(Feature, &str, &[_]); 3] = [
        (
            Feature::DynamicVariables,
            "VAR-19",
            &[
                ("V2.11.2076.99", NO),
                ("V2.11.2077", YES),
                ("V2.11.2077.01", YES),
                // A later version is printed for this branch, so this version is only assumed not to
                // have the feature.
                ("V2.11.2078", NO_ASSUMED),
                ("V2.11.2846.99", NO_ASSUMED),
                ("V2.11.2847", YES),
                ("V2.11.2847.01", YES),
                ("V2.11.2848", YES),
                ("V3.1.3081.06", NO),
                ("V3.1.3081.07", YES),
                ("V3.1.3081.08", YES),
                ("V3.1.3082", NO_ASSUMED),
                ("V3.1.3114.99", NO_ASSUMED),
                ("V3.1.3115", YES),
                ("V3.1.3115.01", YES),
                ("V3.1.3116", YES),
                ("V4.17.99", NO),
                ("V4.18.0", YES),
                ("V4.18.0.01", YES),
                ("V4.18.1", YES),
                ("V4.19.0", YES),
                ("V1.0.0", NO_ASSUMED),
                ("V2.10.9999", NO_ASSUMED),
                ("V2.12.0", NO_ASSUMED),
                ("V3.2.0", NO_ASSUMED),
                ("V5.0.0", YES_ASSUMED),
            ],
        ),
        (
            Feature::DescriptionByName,
            "VAR-28",
            &[
                ("V3.1.3131.99", NO),
                ("V3.1.3132.0", YES),
                ("V3.1.3132.01", YES),
                ("V4.28.99", NO),
                ("V4.29.0", YES),
                ("V4.30.0", YES),
                ("V2.11.2847", NO_ASSUMED),
                ("V3.2.0", NO_ASSUMED),
                ("V5.0.0", YES_ASSUMED),
            ],
        ),
        (
            Feature::ServiceInterface,
            "SVC-11",
            &[
                ("V2.11.2030", NO),
                ("V2.11.2030.01", YES),
                ("V2.11.2030.02", YES),
                ("V2.11.2031", YES),
                ("V3.1.3057.02", NO),
                ("V3.1.3057.03", YES),
                ("V3.1.3057.04", YES),
                ("V3.1.3058", YES),
                ("V2.10.0", NO_ASSUMED),
                ("V2.12.0", NO_ASSUMED),
                ("V4.0.0", YES_ASSUMED),
                ("V5.0.0", YES_ASSUMED),
            ],
        ),
    ];
    for (feature, clause, cases) in cases {
        assert_eq!(feature.requirement(), clause);
        for &(text, wanted) in cases {
            let Support { available, assumed, requirement } = version(text).has(feature);
            assert_eq!(
                ((available, assumed), requirement),
                (wanted, clause),
                "{feature:?} of {text}"
            );
        }
    }
}

/// Section 4.2.1 of each edition: the kinds for which the functions by handle (0x46, 0x47 and 0x49) are
/// not available.
#[test]
fn handles_by_edition() {
    let newest = Some(version("V4.18.0"));
    for edition in Edition::ALL {
        for function in BY_HANDLE {
            let may = |kind| edition.permits(function, kind, newest);
            for kind in [Kind::V_E, Kind::V_G, Kind::V_A] {
                assert_answer(may(kind), YES, function.spec().clause);
            }
            assert_answer(may(Kind::V_CYC), NO, "VAR-18");
            for kind in [Kind::V_P, Kind::V_L, Kind::V_S] {
                match edition {
                    Edition::German => assert_answer(may(kind), NO, "VAR-18"),
                    _ => assert_answer(may(kind), NO_ASSUMED, "VAR-19"),
                }
            }
            let other = Kind::new("V.X").unwrap();
            assert_answer(may(other), YES_ASSUMED, function.spec().clause);
        }
    }
    assert_eq!(Edition::English.by_name_only(), [Kind::V_CYC]);
    let german = [Kind::V_CYC, Kind::V_P, Kind::V_L, Kind::V_S];
    assert_eq!(Edition::German.by_name_only(), german);
}

/// Section 4.1: V.CYC is accessible by name in both editions; V.P, V.L and V.S only in `ads-de`, from
/// certain CNC versions on.
#[test]
fn names_by_edition_and_version() {
    let with = [Some(version("V3.1.3115")), Some(version("V2.11.2077"))];
    let without = Some(version("V3.1.3081.06"));
    let between = Some(version("V3.1.3100"));
    for function in BY_NAME {
        for edition in Edition::ALL {
            for kind in [Kind::V_E, Kind::V_G, Kind::V_A, Kind::V_CYC] {
                for version in [without, between, None] {
                    let answer = edition.permits(function, kind, version);
                    assert_answer(answer, YES, function.spec().clause);
                }
            }
        }
        for kind in [Kind::V_P, Kind::V_L, Kind::V_S] {
            let german = |version| Edition::German.permits(function, kind, version);
            with.into_iter().for_each(|with| assert_answer(german(with), YES, "VAR-19"));
            assert_answer(german(without), NO, "VAR-19");
            assert_answer(german(between), NO_ASSUMED, "VAR-19");
            assert_answer(german(None), YES_ASSUMED, "VAR-19");
            let english = Edition::English.permits(function, kind, with[0]);
            assert_answer(english, NO_ASSUMED, "VAR-19");
        }
    }
}

/// Sections 4.3.1, 4.3.2 and 4.3.8: requests by index accept the kinds V.G, V.E and V.A (E-39).
#[test]
fn requests_by_index_accept_three_kinds() {
    for edition in Edition::ALL {
        for function in BY_INDEX {
            let may = |kind| edition.permits(function, kind, None);
            for kind in [Kind::V_E, Kind::V_G, Kind::V_A] {
                assert_answer(may(kind), YES, "VAR-1");
            }
            for kind in [Kind::V_CYC, Kind::V_P, Kind::V_L, Kind::V_S, Kind::new("V.E.").unwrap()] {
                assert_answer(may(kind), NO_ASSUMED, "VAR-1");
            }
            let all = if function == Function::CountVariables { YES } else { NO_ASSUMED };
            assert_answer(may(Kind::ALL), all, "VAR-1");
        }
    }
}

/// Section 4.1: the axis interface is only for V.A.
#[test]
fn the_axis_interface_has_only_axis_variables() {
    for edition in Edition::ALL {
        for function in ON_AXIS {
            assert_answer(edition.permits(function, Kind::V_A, None), YES, "VAR-26");
            for kind in [Kind::V_E, Kind::V_G, Kind::V_CYC, Kind::V_P] {
                assert_answer(edition.permits(function, kind, None), NO_ASSUMED, "VAR-26");
            }
        }
        let answer = edition.permits(Function::CountObjects, Kind::V_P, None);
        assert_answer(answer, YES, "COM-1");
    }
}

/// The kind is recognised in a request with several NULs after the kind, and in a whole name.
#[test]
fn the_nuls_of_a_kind_are_ignored() {
    let request = VariableKindRef::decode(b"V.CYC\0\0\0").unwrap();
    let answer = Edition::English.permits(Function::HandleByName, request.kind, None);
    assert_answer(answer, NO, "VAR-18");
    let name = VariablePath::new("V.S.a[3]").unwrap();
    let answer = Edition::German.permits(Function::ReadByHandle, name.kind(), None);
    assert_answer(answer, NO, "VAR-18");
}

#[test]
fn editions_versions_and_support_are_as_printed() {
    assert_eq!(Edition::English.to_string(), "ads-en 1.05");
    assert_eq!(Edition::German.to_string(), "ads-de 1.051");
    assert_eq!(format!("{:?}", version("V3.1.3081.07")), "CncVersion(V3.1.3081.07)");
    let available = Support { available: true, requirement: "VAR-1", assumed: false };
    assert_eq!(available.to_string(), "yes (VAR-1)");
    let not = Support { available: false, requirement: "VAR-1", assumed: true };
    assert_eq!(not.to_string(), "no (VAR-1, assumed)");
}

/// The document and the number of each edition are those of a document in the data of the vectors.
#[test]
fn editions_are_documents_of_the_vectors() {
    for edition in Edition::ALL {
        let known = ads_cnc_vectors::documents().iter().any(|document| {
            document.document == edition.document() && document.edition == edition.number()
        });
        assert!(known, "{edition}");
    }
}

proptest! {
    #![proptest_config(crate::kept::cases(256, file!()))]

    #[test]
    fn formatted_versions_are_parsed_again(
        numbers in any::<(u16, u16, u16, u16)>(),
        v in proptest::sample::select(vec!["", "V", "V."]),
    ) {
        let (major, minor, build, patch) = numbers;
        let one = CncVersion::from_parts(major, minor, build, patch);
        prop_assert_eq!(CncVersion::new(&one.to_string()), Ok(one));
        let text = format!("{v}{major}.{minor}.{build}.{patch}");
        prop_assert_eq!(CncVersion::new(&text), Ok(one));
    }

    #[test]
    fn any_versions_are_ordered_by_their_numbers(one in any::<[u16; 4]>(), other in any::<[u16; 4]>()) {
        let version = |[a, b, c, d]: [u16; 4]| CncVersion::from_parts(a, b, c, d);
        prop_assert_eq!(version(one).cmp(&version(other)), one.cmp(&other));
    }

    /// Texts that are accepted as a version have three or four numbers, and no text causes a panic.
    #[test]
    fn any_text_is_a_version_or_rejected(text in "[V.0-9\u{e4} ]{0,14}") {
        if let Ok(version) = CncVersion::new(&text) {
            let numbers = text.trim_start_matches('V').trim_start_matches('.');
            let numbers: Vec<u16> = numbers.split('.').map(|n| n.parse().unwrap()).collect();
            prop_assert!(matches!(numbers.len(), 3 | 4));
            let parts = [version.major, version.minor, version.build, version.patch];
            prop_assert_eq!(&parts[..numbers.len()], &numbers[..]);
        }
    }

    /// A later patch of a version has all features of the earlier patches.
    #[test]
    fn later_patches_keep_features(
        feature in proptest::sample::select(Feature::ALL.to_vec()),
        [major, build] in any::<[u16; 2]>(),
        minor in 0..40_u16,
        patches in any::<[u16; 2]>(),
    ) {
        let [patch, later] = [patches[0].min(patches[1]), patches[0].max(patches[1])];
        let major = major % 7;
        let build = 2000 + build % 1200;
        let has = |patch| CncVersion::from_parts(major, minor, build, patch).has(feature).available;
        prop_assert!(!has(patch) || has(later));
    }
}

/// The description by name (0x4C): the versions that have it, and the kinds for which it is available.
#[test]
fn descriptions_by_name() {
    let may =
        |edition: Edition, kind, version| edition.permits(Function::DescribeByName, kind, version);
    let (old, new) = (Some(version("V3.1.3131")), Some(version("V3.1.3132.0")));
    for edition in Edition::ALL {
        for kind in [Kind::V_E, Kind::V_G, Kind::V_A] {
            assert_answer(may(edition, kind, old), NO, "VAR-28");
            assert_answer(may(edition, kind, new), YES, "VAR-28");
            assert_answer(may(edition, kind, None), YES_ASSUMED, "VAR-28");
        }
        assert_answer(may(edition, Kind::V_CYC, new), YES_ASSUMED, "VAR-28");
    }
    assert_answer(may(Edition::German, Kind::V_P, new), YES_ASSUMED, "VAR-28");
    assert_answer(may(Edition::German, Kind::V_P, Some(version("V4.17.0"))), NO, "VAR-19");
    assert_answer(may(Edition::German, Kind::V_P, Some(version("V4.18.0"))), NO, "VAR-28");
    assert_answer(may(Edition::English, Kind::V_P, new), NO_ASSUMED, "VAR-19");
}

/// Functions that are not for variables are available in each edition, with any kind.
#[test]
fn other_functions_ignore_kinds() {
    let about_variables = |function: &&Function| function.spec().clause.starts_with("VAR");
    let others: Vec<_> = Function::ALL.iter().filter(|of| !about_variables(of)).collect();
    assert!(
        others.contains(&&Function::CountElements) && others.contains(&&Function::CountDynamic)
    );
    for &&function in &others {
        for kind in [Kind::ALL, Kind::V_E, Kind::V_CYC, Kind::V_S, Kind::new("V.X").unwrap()] {
            for edition in Edition::ALL {
                let answer = edition.permits(function, kind, Some(version("V1.0.0")));
                assert_answer(answer, YES, function.spec().clause);
            }
        }
    }
}

/// Exactly the functions that are documented only online have a feature, which states the versions
/// that have them.
#[test]
fn functions_documented_online_have_a_feature() {
    for &function in Function::ALL {
        let is_online = function.spec().section == "online";
        assert_eq!(Feature::of(function).is_some(), is_online, "{function:?}");
    }
}
