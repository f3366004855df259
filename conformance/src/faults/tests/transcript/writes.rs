//! Writes, queries of other channels, axis exchange, and stream writes.

use super::{Transcript, numbers};
use crate::number::u32_at;

impl Transcript<'_> {
    /// Queries, mostly of channel 6, which has rank 3: by number and by rank, with unknown channels
    /// and axes, and with several read lengths. At the end, accesses to elements of a large array.
    pub(super) fn queries(&mut self) {
        let by_name = [0x46_u32, 0x48, 0x4C, 0x1_0004, 0x1_0005].map(|at| (0x12_2306_u32, at));
        for (group, offset) in by_name {
            let name = if offset > 0xFFFF { &b"V.A.ACT_POS\0"[..] } else { b"V.E.array\0" };
            self.elsewhere(552, group, offset, name);
        }
        for offset in [0x45, 0x4B] {
            self.elsewhere(552, 0x12_2306, offset, b"\0\0\0\0V.E\0");
        }
        self.elsewhere(552, 0x12_2306, 0x44, b"V.E\0");
        let handle = self.ask(0x12_2306, 0x46, 4, b"V.E.array\0");
        let handle = u32_at(&handle, 0).unwrap_or_default();
        self.elsewhere(552, 0x12_2306, 0x47, &numbers(&[handle, 1, 1]));
        for offset in [0x1B, 0x1D, 0x1E, 0x20] {
            self.elsewhere(552, 0x12_2302, offset, &numbers(&[1]));
            self.elsewhere(552, 0x12_2301, offset, &numbers(&[1]));
        }
        self.elsewhere(552, 0x12_2302, 0x1C, b"P1\0");
        self.elsewhere(552, 0x12_2302, 0x02, &[]);
        self.elsewhere(552, 0x12_2306, 0x02, &[]);
        self.elsewhere(552, 0x12_2900, 0, &numbers(&[6, 0]));
        for group in (0x12_3306..=0x12_3806).step_by(0x100) {
            self.elsewhere(552, group, 0, &[]);
            self.elsewhere(552, group, 1, &[]);
        }
        for (group, offset) in
            [(0x13_0106, 0), (0x13_0106, 1), (0x12_0106, 1), (0x12_0101, 0x1_0001)]
        {
            self.elsewhere(553, group, offset, &[]);
        }
        self.ask(0x12_2301, 0x48, 4, b"V.E.largest[257]\0");
        for name in [&b"V.E.largest[257]\0"[..], b"V.E.largest[512]\0"] {
            self.write(552, 0x12_2301, 0x4A, &[name, &[3; 4]].concat());
        }
        self.ask(0x12_2301, 0x48, 4096, b"V.E.largest\0");
    }

    fn elsewhere(&mut self, port: u16, group: u32, offset: u32, data: &[u8]) {
        let groups = [group, group - 0x10_0003, group - 0x10_0000, group + 0x40];
        for (group, offset) in
            groups.map(|group| (group, offset)).into_iter().chain([(group, offset + 0x64_0000)])
        {
            for len in [1, 4, 5, 9, 252] {
                match data {
                    [] => drop(self.read(port, group, offset, len)),
                    data => drop(self.ask(group, offset, len, data)),
                }
            }
        }
    }

    /// Writes, mostly to unknown channels, axes and elements.
    pub(super) fn unknown_writes(&mut self) {
        self.write(552, 0x12_2309, 0x4A, b"V.E.Variable_2[0]\0\x09");
        self.write(552, 0x12_2309, 0x49, &[numbers(&[0x200_0002, 0]), vec![1, 1]].concat());
        for (group, axis) in [(0x12_2309, 1), (0x12_2301, 9)] {
            let value = [&b"V.A.WCS\0"[..], &[0; 8]].concat();
            self.write(552, group, axis << 16 | 6, &value);
        }
        for (port, group, offset) in
            [(552, 0x12_3309, 2), (553, 0x12_0109, 1), (553, 0x12_0101, 0x9_0001)]
        {
            self.write(port, group, offset, &[0]);
            self.write(port, group, offset, &[0; 2]);
        }
        for offset in [0x1002, 0x9_0002, 0x102] {
            self.write(552, 0x12_3301, offset, &[0; 2]);
            self.write(552, 0x12_1301, offset, &[0; 8]);
            self.write(552, 0x12_3300, offset, &[1]);
        }
    }

    pub(super) fn writes(&mut self) {
        let contents = [
            (0x12_0101, 1, &[1][..]),
            (0x12_0102, 1, &[1]),
            (0x12_0101, 0x10, &[0]),
            (0x12_0101, 0x14, &[1, 2]),
            (0x12_0101, 0x14, &[1]),
            (0x12_0101, 0x1A, &[1, 2, 3, 4, 5, 6, 7, 8]),
            (0x12_0101, 0x1_0002, &[1]),
            (0x12_0202, 2, &[1]),
            (0x12_0101, 0x15, &[1, 2, 3, 4]),
        ];
        for (group, offset, data) in contents {
            self.write(553, group, offset, data);
            for axis in 0..4 {
                self.read(553, group, axis << 16 | offset & 0xFFFF, 64);
            }
            self.read(553, group, offset, 64);
        }
        for (group, offset, data) in [
            (0x12_1301, 1, &[7, 0][..]),
            (0x12_1301, 2, &[1, 2, 3, 4]),
            (0x12_3301, 2, &[9, 9]),
            (0x12_3301, 1, &[1]),
            (0x12_3302, 2, &[3, 4]),
            (0x12_4301, 0x1_0001, &[1, 2, 3, 4, 5, 6, 7, 8]),
            (0x02_5301, 1, &[1, 2, 3, 4, 5, 6, 7, 8]),
        ] {
            self.write(552, group, offset, data);
            self.read(552, group, offset, 64);
            self.read(552, group & !0xFF | 1, offset, 64);
            self.read(552, group, offset + 0x1_0000, 64);
        }
        for (name, value) in [
            ("V.E.Testvar[3]", &[9, 8, 7, 6][..]),
            ("V.E.Testvar", &[5; 20]),
            ("V.E.Testvar", &[5; 19]),
            ("V.E.vartest", &[1, 2]),
            ("V.E.vartest", &[1, 2, 3]),
            ("V.E.largest[1]", &[1, 2, 3, 4]),
            ("V.E.matrix[1][2]", &[4, 5]),
            ("V.E.array[1]", &[4, 5, 6, 7]),
            ("V.E.texts", &[65; 384]),
        ] {
            for group in [0x12_2301, 0x12_2302] {
                self.write(552, group, 0x4A, &[name.as_bytes(), &[0], value].concat());
                let whole = name.split('[').next().unwrap();
                for group in [0x12_2301, 0x12_2302, 0x12_2306] {
                    self.ask(group, 0x48, 4096, format!("{whole}\0").as_bytes());
                }
            }
        }
        self.odd_writes();
        self.write(552, 0x12_2301, 0x4A, b"V.E.vartest\x01\x02\x03\x04");
        self.write(552, 0x12_2301, 0x4A, b"V.E.sgn32\x01\x02\x03\x04");
        let matrix = self.ask(0x12_2301, 0x46, 4, b"V.E.matrix\0");
        let matrix = u32_at(&matrix, 0).unwrap_or_default();
        for (header, value) in [
            (&[0x200_1234, 1, 3][..], &[1, 2, 3, 4][..]),
            (&[0x200_1234, 0], &[6; 20]),
            (&[0x200_1234, 1, 5], &[1, 2, 3, 4]),
            (&[0x200_1234, 0], &[6; 80]),
            (&[matrix, 2, 0, 1], &[1, 2]),
            (&[matrix, 2, 1, 0], &[3, 4]),
        ] {
            self.write(552, 0x12_2301, 0x49, &[numbers(header), value.to_vec()].concat());
            self.ask(0x12_2301, 0x47, 64, &numbers(&[header[0], 0]));
            self.ask(0x12_2301, 0x48, 64, b"V.E.test\0");
            self.ask(0x12_2301, 0x47, 64, &numbers(&[0x200_1234, 0]));
        }
        for (place, value) in [(1, [1; 8]), (2, [2; 8])] {
            self.write(552, 0x12_2301, place << 16 | 6, &[&b"V.A.WCS\0"[..], &value].concat());
            for place in 1..4 {
                self.ask(0x12_2301, place << 16 | 5, 8, b"V.A.WCS\0");
            }
        }
    }

    /// Writes of a wrong size or to a read-only variable, a shorter text after a longer one, and
    /// requests with an unknown name or a wrong number of indices.
    fn odd_writes(&mut self) {
        for (name, value) in [
            ("V.E.vartest", &[7, 7, 7][..]),
            ("V.E.channel", &[9, 9, 9, 9]),
            ("V.E.text", b"a long text\0"),
            ("V.E.text", b"b\0"),
        ] {
            let name = format!("{name}\0");
            self.write(552, 0x12_2301, 0x4A, &[name.as_bytes(), value].concat());
            self.ask(0x12_2301, 0x48, 64, name.as_bytes());
        }
        for name in ["V.A.WCS\0", "V.E.struct1[9].struct2[0].array_sgn32\0"] {
            self.ask(0x12_2301, 0x46, 4, name.as_bytes());
        }
        self.ask(0x12_2301, 0x47, 64, &numbers(&[0x200_1234, 0x101, 1]));
    }

    pub(super) fn services(&mut self) {
        for (name, value) in [
            ("UUID", &b"560AACBF\0"[..]),
            ("REQUEST", b"a request in lower case, longer than twenty-one and sixty-four bytes\0"),
            ("REQUEST_STATE", &[7, 0, 0, 0]),
            ("RESPONSE", b"a response longer than twenty-one bytes\0"),
            ("RESPONSE_STATE", &[1, 1, 0, 0]),
            ("REQUEST_STATE", &[1, 0, 0, 0]),
            ("RESPONSE", &[b'x'; 100]),
            ("RESPONSE", &[b'x'; 129]),
            ("RESPONSE_STATE", &[2, 0, 0, 0]),
            ("REQUEST_STATE", &[0, 0, 0, 0]),
        ] {
            let name = format!("V.G.SERVICE.{name}\0");
            self.write(552, 0x12_2301, 0x4A, &[name.as_bytes(), value].concat());
            for name in ["UUID", "REQUEST", "REQUEST_STATE", "RESPONSE_STATE", "RESPONSE"] {
                for group in [0x12_2301, 0x12_2302] {
                    let name = format!("V.G.SERVICE.{name}\0");
                    self.ask(group, 0x48, 256, name.as_bytes());
                }
            }
        }
        self.ask(0x12_2301, 0x48, 256, b"V.G.SERVICE_UUID\0");
    }

    pub(super) fn exchange(&mut self) {
        let look = |it: &mut Self| {
            for axis in 1..4 {
                it.read(553, 0x12_0200 | axis, 1, 8);
                it.read(553, 0x12_0101, axis << 16 | 1, 8);
                it.ask(0x12_2301, axis << 16 | 5, 8, b"V.A.WCS\0");
                let handle = it.ask(0x12_2301, axis << 16 | 4, 4, b"V.A.WCS\0");
                let handle = u32_at(&handle, 0).unwrap_or_default();
                it.ask(0x12_2301, 0x47, 8, &numbers(&[handle, 0]));
            }
        };
        self.exchanged(1, 2, 3);
        look(self);
        self.exchanged(1, 2, 2);
        self.exchanged(1, 3, 3);
        self.cnc.set_active(1, false).unwrap();
        for group in [0x02_2301, 0x02_2302, 0x02_2303, 0x12_2306] {
            self.ask(group, 0x48, 4, b"V.E.channel\0");
        }
        self.cnc.set_active(1, true).unwrap();
    }

    fn exchanged(&mut self, channel: u8, place: u8, axis: u32) {
        let done = self.cnc.exchange_axis(channel, place, axis);
        self.record(format!("{done:?}").into_bytes());
    }

    /// Stream writes of one byte more than the maximum length, of the maximum, and of 700 bytes.
    pub(super) fn streams(&mut self) {
        for len in [993, 992, 700] {
            for group in [0x02_0101, 0x12_0101] {
                self.write(553, group, 0x90, &vec![b'X'; len]);
            }
        }
    }
}
