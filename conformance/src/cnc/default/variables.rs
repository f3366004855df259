//! Variables of the default model.

use ads_cnc::{Error, Handle, VariableAccess};

use super::rows::{
    Data, boolean, filling, real64, sgn08, sgn16, sgn32, string, uns08, uns16, uns32,
};
use crate::cnc::Variable;

const R: VariableAccess = VariableAccess::READ_ONLY;
const W: VariableAccess = VariableAccess::READ_WRITE;

/// How many V.E variables channel 1 has: printed.
const EXTERNALS: usize = 123;

/// What the examples print of handles, where it is not the index that makes them.
const HANDLE_TEST: u32 = 0x0200_1234;
const HANDLE_ARRAY: u32 = 0x2001_2341;
const HANDLE_WCS_Y: u32 = 0x0102_001B;

/// Makes a variable.
fn variable(
    handle: u32,
    name: &str,
    access: VariableAccess,
    data: Data,
) -> Result<Variable, Error> {
    let Data { var_type, dimensions, bytes } = data;
    let (handle, name) = (Handle(handle), name.parse()?);
    Ok(Variable { handle, name, var_type, access, dimensions, bytes })
}

pub(super) fn of_channel(number: u8) -> Result<Vec<Variable>, Error> {
    match number {
        1 => {
            let mut variables = externals()?;
            variables.extend(globals()?);
            variables.extend(axis_variables()?);
            Ok(variables)
        }
        _ => others(number),
    }
}

/// V.E of channel 1. The handle is 0x2000000 and the index, but for the printed one.
fn externals() -> Result<Vec<Variable>, Error> {
    let printed = || sgn32(&[123, 234, 345, 456, 567]).of(&[5]);
    // The longest name: with its NUL 256 bytes.
    let long = format!("V.E.{:x<251}", "name_of_255_characters_");
    let largest: Vec<i32> = (0..512).collect();
    let cube: Vec<u8> = (0..24).collect();
    let named = [
        // From index 2 on.
        ("V.E.Variable_3", R, boolean(&[1, 0]).of(&[2])),
        ("V.E.Testvar", W, printed()),
        ("V.E.vartest", W, uns16(&[4711])),
        ("V.E.test", W, printed()),
        ("V.E.array_sgn32", W, sgn32(&[-1, 0, 1, i32::MIN, i32::MAX]).of(&[5])),
        ("V.E.struct.array_uns32", W, uns32(&[0, 1, u32::MAX]).of(&[3])),
        ("V.E.trajectory.vector.x", W, real64(&[1.5])),
        ("V.E.trajectory.vector.y", W, real64(&[-2.25])),
        ("V.E.trajectory.vector.z", W, real64(&[1e-300])),
        ("V.E.struct1[0].struct2[0].array_sgn32", W, sgn32(&[10, 20, 30]).of(&[3])),
        ("V.E.struct1[5].struct2[8].array_sgn32", W, sgn32(&[15, 25, 35]).of(&[3])),
        ("V.E.L\u{e4}nge", W, real64(&[1234.5])),
        // What stands behind the NUL comes along.
        ("V.E.text", W, string(21, &[b"L\xE4nge 5\x80\0rest"])),
        ("V.E.texts", W, string(128, &[b"one", b"two", b"three"]).of(&[3])),
        ("V.E.matrix", W, sgn16(&[11, 12, 13, 21, 22, 23]).of(&[2, 3])),
        ("V.E.cube", W, uns08(&cube).of(&[2, 3, 4])),
        ("V.E.largest", R, sgn32(&largest).of(&[512])),
        (&long, R, uns08(&[255])),
        ("V.E.channel", R, uns32(&[1])),
        ("V.E.boolean", W, boolean(&[1])),
        ("V.E.sgn08", W, sgn08(&[i8::MIN])),
        ("V.E.uns08", W, uns08(&[u8::MAX])),
        ("V.E.sgn16", W, sgn16(&[i16::MIN])),
        ("V.E.uns16", W, uns16(&[u16::MAX])),
        ("V.E.sgn32", W, sgn32(&[i32::MIN])),
        ("V.E.uns32", W, uns32(&[u32::MAX])),
        ("V.E.real64", W, real64(&[1234.5678])),
    ];
    let mut variables = Vec::with_capacity(EXTERNALS);
    for index in 0_u8..2 {
        variables.push(generated(index)?);
    }
    for (index, (name, access, data)) in (2_u32..).zip(named) {
        let handle = match name {
            "V.E.test" => HANDLE_TEST,
            _ => 0x0200_0000 | index,
        };
        variables.push(variable(handle, name, access, data)?);
    }
    for index in (0_u8..).skip(variables.len()).take(EXTERNALS.saturating_sub(variables.len())) {
        variables.push(generated(index)?);
    }
    Ok(variables)
}

fn generated(index: u8) -> Result<Variable, Error> {
    let name = format!("V.E.Variable_{}", index.saturating_add(1));
    variable(0x0200_0000 | u32::from(index), &name, W, filling(index))
}

/// V.G of channel 1.
fn globals() -> Result<Vec<Variable>, Error> {
    // The example reads element 4.
    let array = sgn32(&[10, 11, 12, 13, 333, 15, 16, 17, 18, 19]).of(&[10]);
    Ok(vec![
        variable(0x0100_0000, "V.G.NP[0].V", W, real64(&[1.0, 2.0, 3.0]).of(&[3]))?,
        variable(0x0100_0001, "V.G.NP[1].V", W, real64(&[4.0, 5.0, 6.0]).of(&[3]))?,
        variable(0x0100_0002, "V.G.WZ_AKT.SPDL_AX_NR", R, uns16(&[7]))?,
        variable(HANDLE_ARRAY, "V.G.array", W, array)?,
        variable(0x0100_0004, "V.G.channel", R, uns32(&[1]))?,
    ])
}

/// V.A of channel 1: the axis's place is in the handle, its name behind the variable's.
fn axis_variables() -> Result<Vec<Variable>, Error> {
    Ok(vec![
        variable(0x0101_001A, "V.A.ACT_POS.X", R, real64(&[100.25]))?,
        variable(0x0102_001A, "V.A.ACT_POS.Y", R, real64(&[-200.5]))?,
        variable(0x0103_001A, "V.A.ACT_POS.Z", R, real64(&[0.0]))?,
        variable(0x0101_001B, "V.A.WCS.X", W, real64(&[11.125]))?,
        // Printed, for the second axis, on the axis interface.
        variable(HANDLE_WCS_Y, "V.A.WCS.Y", W, real64(&[1234.2]))?,
        variable(0x0103_001B, "V.A.WCS.Z", W, real64(&[-3.5]))?,
    ])
}

/// Variables of the other channels: the channel's number is in each handle and in V.E.channel.
fn others(number: u8) -> Result<Vec<Variable>, Error> {
    let channel = u32::from(number);
    let base = channel << 24;
    let position = real64(&[f64::from(number)]);
    Ok(vec![
        variable(base | 0x0200, "V.E.channel", R, uns32(&[channel]))?,
        variable(base | 0x0201, "V.E.array", W, uns32(&[channel; 2]).of(&[2]))?,
        variable(base | 0x0100, "V.G.channel", R, uns32(&[channel]))?,
        variable(base | 0x0300, "V.A.ACT_POS.X", R, position)?,
    ])
}
