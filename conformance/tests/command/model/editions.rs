//! The features of a simulated CNC by the edition of the manual and the version of the CNC.

use super::{CHANNEL_1, Cnc};

/// The replies to requests for: V.P by name, a handle of V.P, a handle of V.CYC, V.CYC by name, and a
/// description by name.
fn answers(options: &[&str]) -> [Result<Vec<u8>, u32>; 5] {
    let cnc = Cnc::start(options);
    let sda = cnc.sda();
    let ask = |offset, name: &[u8]| sda.ask(CHANNEL_1, offset, name);
    [
        ask(0x48, b"V.P.count\0"),
        ask(0x46, b"V.P.count\0"),
        ask(0x46, b"V.CYC.count\0"),
        ask(0x48, b"V.CYC.count\0"),
        ask(0x4C, b"V.E.vartest\0"),
    ]
}

#[test]
fn editions_differ() {
    let count = Ok(3.0_f64.to_le_bytes().to_vec());
    let cyclic = Ok(vec![42, 0, 0, 0]);
    // The description by name: UNS16, writable, two bytes, no dimensions.
    let described = Ok(b"\x04\0\0\x02\x05\0\0\0\x02\0\0\0\x02\0\0\0\0\0\0\0".to_vec());
    let english = [Err(0x710), Err(0x710), Err(0x706), cyclic.clone(), described.clone()];
    assert_eq!(answers(&[]), english);
    assert_eq!(answers(&["--edition", "en-1.05"]), english);
    let german = [count, Err(0x706), Err(0x706), cyclic.clone(), described];
    assert_eq!(answers(&["--edition", "de-1.051"]), german);

    // A version without the description by name, and a version that also lacks V.P on the interface
    // of variables.
    let old = ["--edition", "de-1.051", "--cnc-version", "V3.1.3115"];
    assert_eq!(answers(&old)[4], Err(0x703));
    assert!(answers(&old)[0].is_ok());
    let older = ["--edition", "de-1.051", "--cnc-version", "V3.1.3057.03"];
    assert_eq!(answers(&older)[0], Err(0x710));
    assert_eq!(answers(&older)[3], cyclic);
}

/// V.P, V.L and V.S are the dynamic parameters, read and written by name.
#[test]
fn parameters_on_the_interface_of_variables() {
    let cnc = Cnc::start(&["--edition", "de-1.051"]);
    let sda = cnc.sda();
    let one = 1.0_f64.to_le_bytes();
    assert_eq!(sda.write(CHANNEL_1, 0x4A, &[&b"V.S.radius\0"[..], &one].concat()), Ok(()));
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.S.radius\0"), Ok(one.to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x25, b"V.S.radius\0"), Ok(one.to_vec()));
    assert_eq!(sda.write(CHANNEL_1, 0x4A, b"V.S.radius\0\0\0\0\0"), Err(0x705));
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.L.temporary\0"), Err(0x710));
    // A REAL64 without a handle, which is an assumption.
    let described = b"\0\0\0\0\x08\0\0\0\x02\0\0\0\x08\0\0\0\0\0\0\0";
    assert_eq!(sda.ask(CHANNEL_1, 0x4C, b"V.L.depth\0"), Ok(described.to_vec()));
    // P parameters have no name on the interface of variables, and parameters are not counted.
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"P1\0"), Err(0x710));
    assert_eq!(sda.ask(CHANNEL_1, 0x44, b"V.P\0"), Err(0x710));
}

#[test]
fn descriptions_by_name() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let ask = |name: &[u8]| sda.ask(CHANNEL_1, 0x4C, name);
    let printed = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
    assert_eq!(ask(b"V.E.Variable_3\0"), Ok(printed.to_vec()));
    let axis = b"\x1B\0\x02\x01\x08\0\0\0\x02\0\0\0\x08\0\0\0\0\0\0\0";
    assert_eq!(ask(b"V.A.WCS.Y\0"), Ok(axis.to_vec()));
    // The description of a V.CYC variable contains the handle 0, because it has no handle.
    let cyclic = b"\0\0\0\0\x08\0\0\0\x02\0\0\0\x20\0\0\0\x02\0\0\0\x02\0\0\0\x02\0\0\0";
    assert_eq!(ask(b"V.CYC.matrix\0"), Ok(cyclic.to_vec()));
    for name in ["V.E.nobody", "V.E.test[1]", "V.P.count", "V.E", ""] {
        assert_eq!(ask(format!("{name}\0").as_bytes()), Err(0x710), "{name}");
    }
}
