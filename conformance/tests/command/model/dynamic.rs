//! Dynamic parameters of the simulated CNC.

use ads_cnc_conformance::simulator::DEFAULT_MODEL;

use super::timed::Timed;
use super::{CHANNEL_1, Cnc};

/// The index offsets of the functions of a kind: count, name by index, value by name, value by index.
const P: [u32; 4] = [0x02, 0x1B, 0x1C, 0x1D];
const VL: [u32; 4] = [0x03, 0x1E, 0x1F, 0x20];
const VP: [u32; 4] = [0x04, 0x21, 0x22, 0x23];
const VS: [u32; 4] = [0x05, 0x24, 0x25, 0x26];

fn real(value: f64) -> Result<Vec<u8>, u32> {
    Ok(value.to_le_bytes().to_vec())
}

#[test]
fn printed_example() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    assert_eq!(sda.read(CHANNEL_1, 0x02, 4), Ok(vec![1, 0, 0, 0]));
    assert_eq!(sda.ask(CHANNEL_1, 0x1B, &[1, 0, 0, 0]), Ok(b"P1\0".to_vec()));
    let value = vec![0, 0, 0, 0, 0, 0x67, 0xB2, 0x40];
    assert_eq!(sda.ask(CHANNEL_1, 0x1C, b"P1\0"), Ok(value.clone()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1C, b"P1"), Ok(value.clone()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1D, &[1, 0, 0, 0]), Ok(value));
}

#[test]
fn every_kind_has_its_functions() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    for (kind, names) in [
        (P, &[("P1", 4711.0)][..]),
        (VL, &[("V.L.depth", 2.5)]),
        (VP, &[("V.P.count", 3.0), ("V.P.offset", -0.125)]),
        (VS, &[("V.S.radius", 6.25)]),
    ] {
        let [count, name_at, by_name, by_index] = kind;
        assert_eq!(sda.read(CHANNEL_1, count, 4), Ok(vec![names.len() as u8, 0, 0, 0]));
        for (index, &(name, value)) in (1_u8..).zip(names) {
            let (index, name) = ([index, 0, 0, 0], format!("{name}\0"));
            assert_eq!(sda.ask(CHANNEL_1, name_at, &index), Ok(name.clone().into_bytes()));
            assert_eq!(sda.ask(CHANNEL_1, by_name, name.as_bytes()), real(value), "{name}");
            assert_eq!(sda.ask(CHANNEL_1, by_index, &index), real(value), "{name}");
        }
        // Indices count from 1. A name of another kind does not exist.
        for index in [0, names.len() as u8 + 1, 255] {
            let wanted = if index == 0 { 0x705 } else { 0x706 };
            assert_eq!(sda.ask(CHANNEL_1, name_at, &[index, 0, 0, 0]), Err(wanted));
            assert_eq!(sda.ask(CHANNEL_1, by_index, &[index, 0, 0, 0]), Err(wanted));
        }
        assert_eq!(sda.ask(CHANNEL_1, by_name, b"V.X.nobody\0"), Err(0x710));
        assert_eq!(sda.ask(CHANNEL_1, by_name, b"P\0"), Err(0x710));
        assert_eq!(sda.ask(CHANNEL_1, by_name, &[b'x'; 97]), Err(0x705));
        // Channel 6 has no parameters, and channel 3 does not exist.
        assert_eq!(sda.read(0x12_2306, count, 4), Ok(vec![0; 4]));
        assert_eq!(sda.read(0x12_2303, count, 4), Err(0x702));
    }
    assert_eq!(sda.ask(CHANNEL_1, 0x1C, b"V.L.depth\0"), Err(0x710));
}

/// While a subroutine runs, its parameter is the first of the list. The other parameter then has another
/// index, but the same name (DYN-4).
#[test]
fn a_subroutine_shifts_indices() {
    let cnc = Cnc::start(&[]);
    let (sda, com) = (cnc.sda(), cnc.com());
    let first = || sda.ask(CHANNEL_1, 0x1E, &[1, 0, 0, 0]);
    assert_eq!(first(), Ok(b"V.L.depth\0".to_vec()));
    assert_eq!(com.write(0x12_0101, 0x1F, &[1]), Ok(()));
    assert_eq!(sda.read(CHANNEL_1, 0x03, 4), Ok(vec![2, 0, 0, 0]));
    assert_eq!(first(), Ok(b"V.L.temporary\0".to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x20, &[1, 0, 0, 0]), real(0.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x20, &[2, 0, 0, 0]), real(2.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x1F, b"V.L.depth\0"), real(2.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x1F, b"V.L.temporary\0"), real(0.5));
    assert_eq!(com.write(0x12_0101, 0x1F, &[0]), Ok(()));
    assert_eq!(sda.read(CHANNEL_1, 0x03, 4), Ok(vec![1, 0, 0, 0]));
    assert_eq!(first(), Ok(b"V.L.depth\0".to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1F, b"V.L.temporary\0"), Err(0x710));
    assert_eq!(sda.ask(CHANNEL_1, 0x20, &[2, 0, 0, 0]), Err(0x706));
}

/// A CNC whose channel 1 has these parameters.
fn with_parameters(parameters: &str) -> Timed {
    let edition = "edition = \"de-1.051\"\n";
    Timed::new(&format!("{edition}[[channel]]\nnumber = 1\nparameters = [\n{parameters}\n]\n"))
}

impl Timed {
    /// The names of a kind by their indices, up to the count.
    fn names(&self, kind: [u32; 4]) -> String {
        let count = self.read(kind[0]).unwrap();
        let name = |index: u8| {
            let name = self.ask(kind[1], &[index, 0, 0, 0]);
            name.map(|name| String::from_utf8(name).unwrap().replace('\0', ""))
        };
        assert_eq!(name(count[0] + 1), Err(0x706));
        (1..=count[0]).map(|index| name(index).unwrap()).collect::<Vec<_>>().join(" ")
    }
}

/// When a parameter is created or deleted, the indices of the parameters after it change. A deleted
/// parameter has no value and no name.
#[test]
fn parameters_are_created_and_deleted_in_time() {
    let cnc = with_parameters(
        r#"{ name = "V.L.late", value = 1, comes = "2s" },
        { name = "V.L.early", value = 2, goes = "1500ms" },
        { name = "V.L.always", value = 3 },
        { name = "V.L.between", value = 4, comes = "1s", goes = "3s" },
        { name = "P1", value = 5, comes = "2s" },"#,
    );
    let by_index = |index: u8| cnc.ask(VL[3], &[index, 0, 0, 0]);
    assert_eq!(cnc.names(VL), "V.L.early V.L.always");
    assert_eq!((by_index(1), by_index(2), by_index(3)), (real(2.0), real(3.0), Err(0x706)));
    cnc.pass(999);
    assert_eq!(cnc.names(VL), "V.L.early V.L.always");
    assert_eq!(cnc.ask(VL[2], b"V.L.between\0"), Err(0x710));
    cnc.pass(1);
    assert_eq!(cnc.names(VL), "V.L.early V.L.always V.L.between");
    assert_eq!(cnc.ask(VL[2], b"V.L.between\0"), real(4.0));
    cnc.pass(500);
    assert_eq!(cnc.names(VL), "V.L.always V.L.between");
    assert_eq!((by_index(1), by_index(2), by_index(3)), (real(3.0), real(4.0), Err(0x706)));
    assert_eq!(cnc.ask(VL[2], b"V.L.early\0"), Err(0x710));
    assert_eq!(cnc.names(P), "");
    cnc.pass(500);
    assert_eq!(cnc.names(VL), "V.L.late V.L.always V.L.between");
    assert_eq!((by_index(1), by_index(2), by_index(3)), (real(1.0), real(3.0), real(4.0)));
    assert_eq!(cnc.names(P), "P1");
    cnc.pass(1_000_000);
    assert_eq!(cnc.names(VL), "V.L.late V.L.always");
}

/// A parameter is also created and deleted on the interface of variables. A parameter that is created
/// again has its initial value, even if no request was sent while it did not exist.
#[test]
fn a_recreated_parameter_has_its_initial_value() {
    let cnc = with_parameters(
        r#"{ name = "V.P.often", value = 1.5, comes = "1s", goes = "2s", period = "4s" },
        { name = "V.P.stays", value = 2.5 },"#,
    );
    let read = |name: &str| cnc.ask(0x48, format!("{name}\0").as_bytes());
    let write = |name: &str, value: f64| cnc.write(name, &value.to_le_bytes());
    assert_eq!((read("V.P.often"), write("V.P.often", 9.0)), (Err(0x710), Err(0x710)));
    cnc.pass(1000);
    assert_eq!(cnc.names(VP), "V.P.often V.P.stays");
    assert_eq!(write("V.P.often", 9.0), Ok(()));
    assert_eq!(write("V.P.stays", 8.0), Ok(()));
    cnc.pass(999);
    assert_eq!((read("V.P.often"), cnc.ask(VP[3], &[1, 0, 0, 0])), (real(9.0), real(9.0)));
    // One whole period later, without a request in between.
    cnc.pass(4000);
    assert_eq!((read("V.P.often"), read("V.P.stays")), (real(1.5), real(8.0)));
    cnc.pass(1);
    assert_eq!(cnc.names(VP), "V.P.stays");
    assert_eq!(read("V.P.often"), Err(0x710));
}

/// A parameter that its object creates again has its initial value, too.
#[test]
fn a_parameter_recreated_by_an_object_has_its_initial_value() {
    let edition = ["edition = \"en-1.05\"", "edition = \"de-1.051\""];
    let cnc = Timed::new(&DEFAULT_MODEL.replace(edition[0], edition[1]));
    for _ in 0..2 {
        assert_eq!(cnc.write_object(0x1F, &[1]), Ok(()));
        assert_eq!(cnc.ask(VL[2], b"V.L.temporary\0"), real(0.5));
        assert_eq!(cnc.write("V.L.temporary", &9_f64.to_le_bytes()), Ok(()));
        assert_eq!(cnc.write_object(0x1F, &[0]), Ok(()));
    }
}

/// A parameter for which the model names both times and an object exists only while both conditions are
/// true.
#[test]
fn times_and_object_both_apply() {
    let timed = "while = \"example_subroutine_w\", comes = \"2s\"";
    let model = DEFAULT_MODEL.replace("while = \"example_subroutine_w\"", timed);
    let cnc = Timed::new(&model);
    let object = |value: u8| assert_eq!(cnc.write_object(0x1F, &[value]), Ok(()));
    object(1);
    assert_eq!(cnc.names(VL), "V.L.depth");
    cnc.pass(2000);
    assert_eq!(cnc.names(VL), "V.L.temporary V.L.depth");
    object(0);
    assert_eq!(cnc.names(VL), "V.L.depth");
}

/// The example of a parameter in a comment of the default model is valid TOML, and has its effect.
#[test]
fn the_commented_parameter_is_valid() {
    let row = DEFAULT_MODEL.lines().find_map(|line| {
        line.strip_prefix("#   ").filter(|row| row.starts_with("{ name = \"V.L.feed\""))
    });
    let cnc = with_parameters(row.unwrap());
    let there = (0..20).filter(|_| {
        let there = cnc.names(VL) == "V.L.feed";
        cnc.pass(1000);
        there
    });
    assert_eq!(there.collect::<Vec<_>>(), [2, 3, 4, 12, 13, 14]);
}
