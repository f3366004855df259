//! Judges the effect of a frame only by its bytes, independent of the codec and the gate.

pub(crate) fn number(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

/// Whether a frame is a query that writes nothing, moves nothing and occupies no resources of the device.
pub(crate) fn is_harmless(frame: &[u8]) -> bool {
    let (port, command) = (frame[12..14].try_into().unwrap(), frame[22]);
    if !(551..=553).contains(&u16::from_le_bytes(port)) || frame[23..26] != [0, 4, 0] {
        return false;
    }
    match command {
        // ReadDeviceInfo and ReadState
        1 | 4 => frame.len() == 38,
        // Read: any address except that of the program stream
        2 => {
            let (group, offset) = (number(frame, 38), number(frame, 42));
            frame.len() == 50
                && (group & 0xFF00 != 0x0100 || group >> 16 & 0xF != 2 || offset != 0x90)
        }
        // ReadWrite: the queries of variables, of axis variables and of dynamic parameters, and of
        // the address of an object
        9 => {
            let (group, offset) = (number(frame, 38), number(frame, 42));
            let of_decoder = group & !0x10_00FF == 0x2_2300 && group & 0xFF > 0;
            let variables = [0x44, 0x45, 0x46, 0x47, 0x48, 0x4B, 0x4C].contains(&offset);
            let dynamic = (0x1B..=0x26).contains(&offset);
            let of_axis = offset > 0xFFFF && [4, 5].contains(&(offset & 0xFFFF));
            let of_object = group & !0x10_F000 == 0x2_0900 && offset == 0;
            of_object || of_decoder && (variables || dynamic || of_axis)
        }
        _ => false,
    }
}
