//! Tests of names of variables: parsing, building and errors.

use ads_cnc::ErrorKind::*;
use ads_cnc::layout::Subject;
use ads_cnc::limits::NAME_MAX;
use ads_cnc::*;
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::names::*;
use super::common::{Fault, fault};
use super::kept;

fn path(name: &str) -> VariablePath<'_> {
    VariablePath::new(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Names that section 4.1 of the manuals `ads-en` 1.05 and `ads-de` 1.051 prints are parsed and
/// built, and so are names with an index or an axis from the examples in section 4.3 (VAR-20).
#[test]
fn printed_names_are_parsed() {
    let s = "struct1";
    for (name, kind, parts, axis) in [
        ("V.A.ACT_POS", Kind::V_A, &[("ACT_POS", &[][..])][..], None),
        ("V.A.ACT_POS.X", Kind::V_A, &[("ACT_POS", &[]), ("X", &[])], Some("X")),
        ("V.E.array_sgn32", Kind::V_E, &[("array_sgn32", &[])], None),
        ("V.E.struct.array_uns32", Kind::V_E, &[("struct", &[]), ("array_uns32", &[])], None),
        ("V.G.NP[0].V", Kind::V_G, &[("NP", &[0]), ("V", &[])], None),
        ("V.G.NP[1].V", Kind::V_G, &[("NP", &[1]), ("V", &[])], None),
        ("V.G.NP[0].V[0]", Kind::V_G, &[("NP", &[0]), ("V", &[0])], None),
        ("V.G.NP[0].V[1]", Kind::V_G, &[("NP", &[0]), ("V", &[1])], None),
        ("V.G.WZ_AKT.SPDL_AX_NR", Kind::V_G, &[("WZ_AKT", &[]), ("SPDL_AX_NR", &[])], None),
        // Only `ads-en` prints this name.
        (
            "V.E.trajectory.vector.x",
            Kind::V_E,
            &[("trajectory", &[]), ("vector", &[]), ("x", &[])],
            None,
        ),
        // Only `ads-de` prints this name.
        (
            "V.E.Trajektorie.Vektor.x",
            Kind::V_E,
            &[("Trajektorie", &[]), ("Vektor", &[]), ("x", &[])],
            None,
        ),
        (
            "V.E.struct1[0].struct2[0].array_sgn32",
            Kind::V_E,
            &[(s, &[0]), ("struct2", &[0]), ("array_sgn32", &[])],
            None,
        ),
        ("V.E.Testvar[3]", Kind::V_E, &[("Testvar", &[3])], None),
        ("V.E.test[4]", Kind::V_E, &[("test", &[4])], None),
        ("V.G.array[4]", Kind::V_G, &[("array", &[4])], None),
        ("V.A.WCS.Y", Kind::V_A, &[("WCS", &[]), ("Y", &[])], Some("Y")),
    ] {
        let found = path(name);
        let pieces = Pieces::new(&kind.text().to_string(), parts);
        assert_eq!(found.kind(), kind, "{name}");
        assert_eq!(Pieces::of(found), pieces, "{name}");
        assert_eq!(found.axis().map(|axis| axis.to_string()).as_deref(), axis, "{name}");
        let (_, indices) = *parts.last().unwrap();
        assert_eq!(found.elements(), U32List::from(indices), "{name}");
        let brackets: String = indices.iter().map(|index| format!("[{index}]")).collect();
        assert_eq!(format!("{}{brackets}", found.variable()), name);
        assert_eq!(pieces.write(&mut [0; 64]).unwrap().text(), name);
    }
}

/// One printed name contains a structure that the names printed next to it do not contain. The name
/// is valid with and without the structure, but refers to different variables (E-38).
#[test]
fn the_misprint_is_another_variable() {
    let printed = path("V.E.struct1.struct1[5].struct2[8].array_sgn32");
    let ruled = path("V.E.struct1[5].struct2[8].array_sgn32");
    let rest = [("struct1", &[5][..]), ("struct2", &[8]), ("array_sgn32", &[])];
    let [one, two, three] = rest;
    assert_eq!(Pieces::of(printed), Pieces::new("V.E", &[("struct1", &[]), one, two, three]));
    assert_eq!(Pieces::of(ruled), Pieces::new("V.E", &rest));
    assert_ne!(printed, ruled);
}

/// Three notations in the manuals that are not names are rejected. The empty index is from E-10.
#[test]
fn notations_of_the_manuals_are_rejected() {
    for (prose, wanted) in [
        ("V.G.array[0 .. 9]", fault(Unexpected, "index", 11, (0, 0x20))),
        ("V.G.NP[0].V[n]", fault(Unexpected, "index", 12, (0, 0x6E))),
        ("V.E.test4[]", fault(Unexpected, "index", 10, (0, 0x5D))),
    ] {
        assert_eq!(Fault::of(VariablePath::new(prose).unwrap_err()), wanted, "{prose}");
    }
}

#[test]
fn malformed_names_are_rejected_at_the_fault() {
    let unexpected = |field, at, character: char| {
        fault(Unexpected, field, at, (0, u32::from(character) as usize))
    };
    let cut = |field, at| fault(Truncated, field, at, (1, 0));
    for (name, wanted) in [
        // These names have no kind, or an invalid kind.
        ("", cut("kind", 0)),
        ("V", cut("kind", 1)),
        ("V.", cut("kind", 2)),
        ("ACT_POS", unexpected("kind", 0, 'A')),
        ("VE.test", unexpected("kind", 1, 'E')),
        ("v.E.test", unexpected("kind", 0, 'v')),
        (".E.test", unexpected("kind", 0, '.')),
        ("V..test", unexpected("kind", 2, '.')),
        ("V[0].E.test", unexpected("kind", 1, '[')),
        // These names have no part after the kind, or an index at the kind.
        ("V.E", cut("part", 3)),
        ("V.E[0].test", unexpected("part", 3, '[')),
        // These names have an empty part.
        ("V.E.", cut("part", 4)),
        ("V.E..test", unexpected("part", 4, '.')),
        ("V.E.test.", cut("part", 9)),
        ("V.E.a[0]..b", unexpected("part", 9, '.')),
        ("V.E.[0]", unexpected("part", 4, '[')),
        ("V.E.a.[0]", unexpected("part", 6, '[')),
        // These names have wrong brackets, or a wrong text in brackets or after them.
        ("V.E.a[", cut("index", 6)),
        ("V.E.a[3", cut("index", 7)),
        ("V.E.a[3.b", unexpected("index", 7, '.')),
        ("V.E.a[[3]]", unexpected("index", 6, '[')),
        ("V.E.a]", unexpected("part", 5, ']')),
        ("V.E.a[3]]", unexpected("part", 8, ']')),
        ("V.E.a[3]b", unexpected("part", 8, 'b')),
        ("V.E.a[3] ", unexpected("part", 8, ' ')),
        ("V.E.a[-1]", unexpected("index", 6, '-')),
        ("V.E.a[+1]", unexpected("index", 6, '+')),
        ("V.E.a[ 1]", unexpected("index", 6, ' ')),
        ("V.E.a[1,2]", unexpected("index", 7, ',')),
        ("V.E.a[0x1]", unexpected("index", 7, 'x')),
        // Offsets in errors count characters, not bytes.
        ("V.E.Länge[€]", unexpected("index", 10, '€')),
        // These indices exceed the greatest valid index, 4 294 967 294.
        ("V.E.a[4294967295]", fault(OutOfRange, "index", 6, (4_294_967_294, 4_294_967_295))),
        ("V.E.ä[0][4294967296]", fault(OutOfRange, "index", 9, (4_294_967_294, 4_294_967_295))),
        ("V.E.a[99999999999999999999]", {
            fault(OutOfRange, "index", 6, (4_294_967_294, 4_294_967_295))
        }),
    ] {
        let error = VariablePath::new(name).unwrap_err();
        assert_eq!(Fault::of(error), wanted, "{name}");
        let field = error.field();
        assert_eq!((field.subject(), field.stream()), (Subject::VariablePath, None), "{name}");
    }
    let greek = VariablePath::new("V.E.Ω").unwrap_err();
    assert_eq!(greek.kind(), NotCp1252);
}

/// A name has at most 255 characters, even if it has more bytes in UTF-8 (VAR-9).
#[test]
fn names_have_at_most_255_characters() {
    for letter in ["a", "ä"] {
        let longest = format!("V.E.{}", letter.repeat(251));
        assert_eq!(path(&longest).text().len(), NAME_MAX);
        let pieces = Pieces::of(path(&longest));
        let mut buf = [0; NAME_MAX];
        assert_eq!(pieces.write(&mut buf).unwrap().text(), longest.as_str());

        let wanted = fault(TooLong, "stream", 255, (255, 256));
        let longer = longest + letter;
        assert_eq!(Fault::of(VariablePath::new(&longer).unwrap_err()), wanted);
        let longer = Pieces::new("V.E", &[(&letter.repeat(252), &[])]);
        assert_eq!(Fault::of(longer.write(&mut [0; 512]).unwrap_err()), wanted);
    }
    // A name has room for at most 83 indices.
    let full = format!("V.E.ab{}", "[0]".repeat(83));
    assert_eq!((full.len(), path(&full).elements().len()), (NAME_MAX, 83));
    let endless =
        std::iter::repeat(PathPart { name: CncStr::new("a").unwrap(), indices: U32List::EMPTY });
    assert_eq!(VariablePath::write(Kind::V_E, endless, &mut []).unwrap_err().kind(), TooLong);
}

/// The greatest index, several indices and leading zeros are parsed.
#[test]
fn indices_go_to_the_largest_of_any_dimension() {
    let largest = path("V.E.a[4294967294][0][10]");
    assert_eq!(largest.elements(), U32List::from(&[u32::MAX - 1, 0, 10]));
    let elements = largest.elements();
    assert_eq!((elements.len(), elements.get(2), elements.get(3)), (3, Some(10), None));
    assert_eq!(
        path("V.E.a").write_element(elements, &mut [0; 64]).unwrap().text(),
        "V.E.a[4294967294][0][10]"
    );
    // Leading zeros are permitted. Names are compared by their text, so these two differ.
    assert_eq!(path("V.E.a[007]").elements(), U32List::from(&[7]));
    assert_ne!(path("V.E.a[007]"), path("V.E.a[7]"));
    // The indices of a name can be used in a request by handle.
    let by_handle = HandleReadRef { handle: Handle(1), indices: path("V.E.a[3][258]").elements() };
    let mut buf = [0; 16];
    let wire = [1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 2, 1, 0, 0];
    assert_eq!(by_handle.encode(&mut buf).unwrap(), wire);
    assert_eq!(HandleReadRef::decode(&wire).unwrap(), by_handle);
}

/// Undocumented kinds are accepted, and so are parts with any CP1252 characters except `.`, `[`,
/// `]` and NUL.
#[test]
fn kinds_and_parts_are_open() {
    for (name, kind) in [
        ("V.CYC.a", Kind::V_CYC),
        ("V.P.a", Kind::V_P),
        ("V.L.a", Kind::V_L),
        ("V.S.a", Kind::V_S),
        ("V.NEW.a", Kind::new("V.NEW").unwrap()),
        ("V.é.a", Kind::new("V.é").unwrap()),
    ] {
        assert_eq!(path(name).kind(), kind);
        assert_eq!(path(name).axis(), None);
        assert_eq!(path(&format!("{name}.b[1]")).axis(), None);
    }
    let odd = path("V.E.a b-c\u{7f}.Länge[1]");
    assert_eq!(
        odd.parts().map(|part| part.to_string()).collect::<Vec<_>>(),
        ["a b-c\u{7f}", "Länge[1]"]
    );
}

/// A name from UTF-8 equals the same name from CP1252.
#[test]
fn names_from_both_encodings_are_equal() {
    let (utf8, wire) = ("V.G.Größe[2].€[3]", b"V.G.Gr\xF6\xDFe[2].\x80[3]");
    let wire = VariablePath::from_text(CncStr::from_bytes(wire).unwrap()).unwrap();
    assert_eq!((path(utf8), Pieces::of(path(utf8))), (wire, Pieces::of(wire)));
    assert_eq!(path(utf8).variable(), wire.variable());
    assert_eq!(path(utf8).variable().to_string(), "V.G.Größe[2].€");
    assert_eq!(format!("{utf8:?}"), format!("{:?}", wire));
}

/// Names for the axis interface are converted to names for the channel interface and back.
#[test]
fn axes_are_added_to_names_and_removed() {
    let x = CncStr::new("X").unwrap();
    for (on_axis, on_channel) in [
        ("V.A.ACT_POS", "V.A.ACT_POS.X"),
        ("V.A.LIST[2]", "V.A.LIST.X[2]"),
        ("V.A.S[1].LIST[2][3]", "V.A.S[1].LIST.X[2][3]"),
        ("V.A.Größe", "V.A.Größe.X"),
    ] {
        let mut buf = [0; 64];
        let there = path(on_axis).write_axis(x, &mut buf).unwrap();
        assert_eq!((there, there.axis()), (path(on_channel), Some(x)));
        assert_eq!(there.write_without_axis(&mut [0; 64]).unwrap(), path(on_axis));
        // A name that was parsed is converted like the name that was built.
        assert_eq!(path(on_channel).write_without_axis(&mut [0; 64]).unwrap(), path(on_axis));
    }
    // An index before the axis stays before the index after the axis.
    let indexed = path("V.A.LIST[2].X[3]");
    assert_eq!(indexed.write_without_axis(&mut [0; 64]).unwrap(), path("V.A.LIST[2][3]"));

    let rejected = |name: &'static str, axis: &str| {
        let axis = CncStr::new(axis).unwrap();
        Fault::of(path(name).write_axis(axis, &mut [0; 64]).unwrap_err())
    };
    assert_eq!(rejected("V.E.a", "X"), fault(Unexpected, "kind", 2, (0, 0x45)));
    assert_eq!(rejected("V.AB.a", "X"), fault(Unexpected, "kind", 3, (0, 0x42)));
    assert_eq!(rejected("V.A.a", ""), fault(Truncated, "part", 6, (1, 0)));
    assert_eq!(rejected("V.A.a[0]", "X.Y"), fault(Unexpected, "part", 7, (0, 0x2E)));
    let without = |name| Fault::of(path(name).write_without_axis(&mut [0; 64]).unwrap_err());
    assert_eq!(without("V.A.ACT_POS[1]"), fault(Missing, "part", 11, (0, 0)));
    assert_eq!(without("V.G.a.b"), fault(Unexpected, "kind", 2, (0, 0x47)));
}

/// Builders reject invalid names, and write nothing to the buffer if they return an error.
#[test]
fn builders_reject_invalid_names_and_write_nothing() {
    let rejected = |build: &dyn Fn(&mut [u8]) -> Option<Error>| {
        let mut buf = [0x55; 300];
        let error = build(&mut buf).expect("rejected");
        assert_eq!(buf, [0x55; 300]);
        Fault::of(error)
    };
    let pieces = |kind, parts: &[(&str, &[u32])]| {
        let pieces = Pieces::new(kind, parts);
        rejected(&|buf| pieces.write(buf).err())
    };
    assert_eq!(pieces("V.E", &[]), fault(Truncated, "part", 3, (1, 0)));
    assert_eq!(pieces("V.E", &[("", &[])]), fault(Truncated, "part", 4, (1, 0)));
    assert_eq!(pieces("", &[("a", &[])]), fault(Truncated, "kind", 0, (1, 0)));
    assert_eq!(pieces("V.E.a", &[("b", &[])]), fault(Unexpected, "kind", 3, (0, 0x2E)));
    assert_eq!(pieces("E", &[("b", &[])]), fault(Unexpected, "kind", 0, (0, 0x45)));
    assert_eq!(pieces("V.E", &[("ä", &[1]), ("b.c", &[])]), {
        fault(Unexpected, "part", 10, (0, 0x2E))
    });
    assert_eq!(pieces("V.E", &[("a[0]", &[])]), fault(Unexpected, "part", 5, (0, 0x5B)));
    assert_eq!(pieces("V.E", &[("a", &[10, u32::MAX])]), {
        fault(OutOfRange, "index", 10, (4_294_967_294, 4_294_967_295))
    });
    let element = path("V.E.a[1]");
    let again = rejected(&|buf| element.write_element(U32List::from(&[2]), buf).err());
    assert_eq!(again, fault(Unexpected, "index", 5, (0, 0x5B)));

    // A buffer with one byte less than the name has is rejected.
    let short = |build: &dyn Fn(&mut [u8]) -> Option<Error>, len: usize| {
        let mut buf = [0x55; 64];
        let error = build(&mut buf[..len - 1]).expect("rejected");
        assert_eq!(buf, [0x55; 64]);
        assert_eq!(Fault::of(error), fault(BufferTooSmall, "stream", 0, (len, len - 1)));
        assert_eq!(build(&mut buf[..len]), None);
    };
    short(&|buf| path("V.E.a").write_element(U32List::from(&[12]), buf).err(), 9);
    short(&|buf| path("V.A.a").write_axis(CncStr::new("X").unwrap(), buf).err(), 7);
    short(&|buf| path("V.A.a.X").write_without_axis(buf).err(), 5);
}

#[test]
fn an_element_without_index_is_the_variable() {
    let array = path("V.G.NP[0].V");
    assert_eq!(array.write_element(U32List::EMPTY, &mut [0; 64]).unwrap(), array);
}

#[cfg(feature = "alloc")]
#[test]
fn owned_names_are_the_written_ones() {
    let (name, x) = (path("V.A.LIST"), CncStr::new("X").unwrap());
    assert_eq!(name.element(U32List::from(&[2])).unwrap().as_bytes(), b"V.A.LIST[2]");
    assert_eq!(name.with_axis(x).unwrap().as_bytes(), b"V.A.LIST.X");
    assert_eq!(path("V.A.LIST.X[2]").without_axis().unwrap().as_bytes(), b"V.A.LIST[2]");
    let longest = format!("V.A.{}", "a".repeat(251));
    assert_eq!(path(&longest).element(U32List::EMPTY).unwrap().to_string(), longest);
    assert_eq!(path(&longest).element(U32List::from(&[0])).unwrap_err().kind(), TooLong);
    assert_eq!(name.without_axis().unwrap_err().kind(), Missing);
}

fn pieces() -> impl Strategy<Value = Pieces> {
    let name = "[A-Za-z_0-9äß€ ]{1,9}";
    let index = prop_oneof![0..12_u32, any::<u32>().prop_map(|index| index.min(u32::MAX - 1))];
    let part = (name, vec(index, 0..4));
    let kind = prop_oneof!["V\\.(E|G|A|CYC|P|L|S)", "V\\.[A-Zß]{1,4}"];
    (kind, vec(part, 1..5)).prop_map(|(kind, parts)| Pieces { kind, parts })
}

proptest! {
    #![proptest_config(kept::cases(4000, file!()))]

    /// A built name has the expected text, and is parsed into the same pieces.
    #[test]
    fn built_names_are_parsed(pieces in pieces()) {
        let name = pieces.name();
        let mut buf = [0; NAME_MAX];
        match pieces.write(&mut buf) {
            Err(error) => {
                prop_assert_eq!(error.kind(), TooLong);
                prop_assert!(name.chars().count() > NAME_MAX);
            }
            Ok(built) => {
                prop_assert_eq!(built.text(), name.as_str());
                prop_assert_eq!(&Pieces::of(built), &pieces);
                let again = VariablePath::from_text(built.text()).unwrap();
                prop_assert_eq!(&Pieces::of(again), &pieces);
                prop_assert_eq!(again.variable(), built.variable());
                let (_, last) = pieces.parts.last().unwrap();
                prop_assert_eq!(built.elements(), U32List::from(&last[..]));
                let mut buf = [0; NAME_MAX];
                let element = built.variable().write_element(built.elements(), &mut buf);
                prop_assert_eq!(element.unwrap(), built);
            }
        }
    }

    #[test]
    fn any_text_is_parsed_like_split(text in "(V\\.[EA]\\.)?[VEaä.\\[\\]019]{0,24}") {
        let text: Vec<u8> = CncStr::new(&text).unwrap().bytes().collect();
        let _ = check_name(&text, NameMutation::NONE);
    }
}
