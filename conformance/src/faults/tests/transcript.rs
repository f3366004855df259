//! A sequence of requests whose replies distinguish a CNC with a defect from the correct CNC.

mod sequences;
mod writes;

use std::sync::Arc;

use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef};

use super::{Faulty, SeededDefect};
use crate::number::u32_at;
use crate::simulator::{Cnc, DEFAULT_MODEL, Model, NET_ID, Responder as _, Settings};

/// A CNC and its replies. After the first difference from the replies `other` of another
/// transcript, no further request is sent.
pub(super) struct Transcript<'t> {
    faulty: Faulty,
    cnc: Arc<Cnc>,
    other: Option<&'t [Vec<u8>]>,
    pub(super) replies: Vec<Vec<u8>>,
    pub(super) differs: bool,
    count: u32,
}

impl<'t> Transcript<'t> {
    pub(super) fn new(defect: Option<&SeededDefect>, other: Option<&'t [Vec<u8>]>) -> Self {
        let edition = defect.and_then(|defect| defect.edition);
        let settings = Settings { edition, version: None };
        let model = Model::with_settings(DEFAULT_MODEL, "default", settings).unwrap();
        let faulty = Faulty::new(Cnc::new(model).with_stopped_clock(), defect);
        let cnc = Arc::clone(faulty.cnc());
        let mut transcript =
            Self { faulty, cnc, other, replies: Vec::new(), differs: false, count: 0 };
        transcript.all();
        transcript
    }

    fn record(&mut self, reply: Vec<u8>) {
        let right = self.other.is_none_or(|other| other.get(self.replies.len()) == Some(&reply));
        self.differs |= !right;
        self.replies.push(reply);
    }

    fn frame(&mut self, port: AmsPort, command: Command, data: &[u8]) -> Vec<u8> {
        self.frame_from(AmsPort(32905), port, command, data)
    }

    fn frame_from(
        &mut self,
        from: AmsPort,
        port: AmsPort,
        command: Command,
        data: &[u8],
    ) -> Vec<u8> {
        if self.differs {
            return Vec::new();
        }
        self.count += 1;
        let client = AmsAddr { net_id: AmsNetId([10, 0, 0, 1, 1, 1]), port: from };
        let target = AmsAddr { net_id: NET_ID, port };
        let header = AmsHeader::request(target, client, command, self.count | 0x5000_0000);
        let mut answers = Vec::new();
        self.faulty.respond(NET_ID, &FrameRef::new(header, data).unwrap(), &mut answers);
        self.record(answers.clone());
        answers
    }

    fn ads(&mut self, port: u16, command: Command, numbers: &[u32], data: &[u8]) -> Vec<u8> {
        let mut bytes: Vec<u8> = numbers.iter().flat_map(|one| one.to_le_bytes()).collect();
        bytes.extend_from_slice(data);
        let answer = self.frame(AmsPort(port), command, &bytes);
        answer.get(46..).unwrap_or_default().to_vec()
    }

    fn read(&mut self, port: u16, group: u32, offset: u32, len: u32) -> Vec<u8> {
        self.ads(port, Command::READ, &[group, offset, len], &[])
    }

    fn write(&mut self, port: u16, group: u32, offset: u32, data: &[u8]) {
        let len = u32::try_from(data.len()).unwrap();
        self.ads(port, Command::WRITE, &[group, offset, len], data);
    }

    fn ask(&mut self, group: u32, offset: u32, len: u32, data: &[u8]) -> Vec<u8> {
        let numbers = [group, offset, len, u32::try_from(data.len()).unwrap()];
        self.ads(552, Command::READ_WRITE, &numbers, data)
    }

    fn all(&mut self) {
        for port in 551..=553 {
            self.frame(AmsPort(port), Command::READ_DEVICE_INFO, &[]);
            self.frame(AmsPort(port), Command::READ_STATE, &[]);
            self.read(port, 0x12_3301, 0, 4);
            self.read(port, 0x13_0101, 0, 4);
        }
        self.objects();
        self.elements();
        self.parameters();
        self.variables();
        self.writes();
        self.unknown_writes();
        self.queries();
        self.services();
        for other in [Self::exchange, Self::streams, Self::sequences] {
            if !self.differs {
                other(self);
            }
        }
    }

    fn objects(&mut self) {
        let lists = [
            0x13_0100, 0x13_0101, 0x13_0102, 0x13_0106, 0x13_0201, 0x13_0205, 0x03_0103, 0x15_0101,
        ];
        for list in lists {
            self.read(553, list, 0, 4);
            for index in 1..26 {
                let object = self.read(553, list, index, 84);
                let (Some(group), Some(offset)) = (u32_at(&object, 12), u32_at(&object, 16)) else {
                    continue;
                };
                self.read(553, group, offset, u32_at(&object, 4).unwrap());
                self.read(553, group, offset, 256);
                self.read(553, group & !0x10_0000, offset, 256);
            }
            for (first, len) in [(1, 252), (2, 168), (23, 840), (1, 85), (257, 84), (1, 1092)] {
                self.read(553, list, first, len);
            }
        }
        let places = [
            (0x12_0100, 0x251),
            (0x12_0101, 0x251),
            (0x12_0200, 0x251),
            (0x12_0200, 0x1_0001),
            (0x12_0201, 1),
            (0x12_0202, 1),
            (0x02_0202, 1),
            (0x12_0101, 1),
            (0x12_0101, 2),
            (0x12_0102, 0x2_0001),
            (0x12_0101, 0x2_0001),
            (0x12_0101, 0x2001),
        ];
        for (group, offset) in places {
            self.read(553, group, offset, 64);
        }
        self.ads(553, Command::READ_WRITE, &[0x12_0101, 0x10, 8, 0], &[]);
    }

    fn elements(&mut self) {
        for class in 0..6 {
            let group = if class == 5 { 0x02_5900 } else { 0x12_0900 | class << 12 };
            for channel in [0, 1, 2, 3, 6, 7, 257] {
                for axis in (0..7).chain([0x1_0001, 0x100_0001]) {
                    let data = [channel, axis].map(u32::to_le_bytes).concat();
                    self.ask(group, 0, 8, &data);
                }
            }
            self.ask(group | 1, 0, 8, &[1, 0, 0, 0, 0, 0, 0, 0]);
            self.ads(552, Command::WRITE, &[group, 0, 8], &[1, 0, 0, 0, 0, 0, 0, 0]);
            self.read(552, group, 0, 8);
            let groups = match class {
                5 => vec![0x02_5300, 0x02_5301, 0x02_5302, 0x12_5300],
                _ => [0x12_0300, 0x12_0301, 0x12_0302, 0x02_0301, 0x02_0303]
                    .map(|group| group | class << 12)
                    .to_vec(),
            };
            for attribute in 0..6 {
                for group in &groups {
                    for axis in 0..5 {
                        for element in 0..8 {
                            let offset = axis << 16 | element;
                            self.read(552, group + (attribute << 8), offset, 256);
                        }
                        self.read(552, group + (attribute << 8), axis << 12 | 1, 256);
                    }
                }
            }
        }
    }

    fn parameters(&mut self) {
        for group in [0x12_2301, 0x12_2302, 0x02_2301] {
            for (count, at) in [(2, 0x1B), (3, 0x1E), (4, 0x21), (5, 0x24)] {
                self.read(552, group, count, 4);
                for index in [0, 1, 2, 3, 257] {
                    let index = u32::to_le_bytes(index);
                    let name = self.ask(group, at, 256, &index);
                    self.ask(group, at + 2, 8, &index);
                    let text = name.split(|byte| *byte == 0).next().unwrap().to_vec();
                    for name in [text.clone(), [text.as_slice(), b"x"].concat(), b"P1".to_vec()] {
                        self.ask(group, at + 1, 8, &[name.as_slice(), &[0]].concat());
                    }
                    let mut long = text;
                    long.resize(96, 0);
                    self.ask(group, at + 1, 8, &long);
                    long.push(0);
                    self.ask(group, at + 1, 8, &long);
                }
            }
        }
    }

    fn variables(&mut self) {
        for group in [0x12_2301, 0x12_2302, 0x02_2303] {
            for kind in [&b"V.E\0"[..], b"V.G\0", b"V.A\0", b"\0", b"", b"V.E.\0", b"V.E"] {
                self.ask(group, 0x44, 4, kind);
                let mut long = kind.to_vec();
                long.resize(256, 0);
                self.ask(group, 0x44, 4, &long);
                for index in (0..34).chain([122, 123, 258]) {
                    for offset in [0x45, 0x4B, 0x4D] {
                        let index = u32::to_le_bytes(index);
                        let found = self.ask(group, offset, 4096, &[&index, kind].concat());
                        if let (0x45, Some(handle)) = (offset, u32_at(&found, 0)) {
                            self.ask(group, 0x47, 2048, &numbers(&[handle, 0]));
                        }
                    }
                }
                let mut long = [&[0; 4], kind].concat();
                for len in [260, 261] {
                    long.resize(len, 0);
                    self.ask(group, 0x45, 4096, &long);
                }
                self.ask(group, 0x45, 4096, &[kind, &[0; 4]].concat());
            }
        }
        let names = [
            "V.E.Testvar",
            "V.E.Testvar[3]",
            "V.E.Testvar[5]",
            "V.E.vartest",
            "V.E.boolean",
            "V.E.matrix",
            "V.E.matrix[1][2]",
            "V.E.cube[1][2][3]",
            "V.E.largest",
            "V.E.struct",
            "V.E.struct.array_uns32[1]",
            "V.E.struct1[0].struct2[0].array_sgn32[1]",
            "V.E.struct1[5].struct2[8].array_sgn32",
            "V.E.text",
            "V.E.texts[1]",
            "V.E.real64",
            "V.G.NP[0].V",
            "V.G.NP[1].V[1]",
            "V.G.array",
            "V.G.array[4]",
            "V.G.WZ_AKT.SPDL_AX_NR",
            "V.A.ACT_POS.X",
            "V.A.WCS.Y",
            "V.CYC.count",
            "V.CYC.matrix[1][0]",
            "V.L.depth",
            "V.E.channel",
            "V.E.Testvarx",
            "V.E.array",
            "V.G.SERVICE.UUID",
            "V.E.uns16",
        ];
        for name in names {
            let ended = format!("{name}\0");
            self.named(ended.as_bytes());
            self.named(name.as_bytes());
            self.named(&[ended.as_bytes(), b"x"].concat());
        }
        self.named(b"V.E.L\xE4nge\0");
        let long = format!("V.E.name_of_255_characters_{}\0", "x".repeat(228));
        self.named(long.as_bytes());
        self.named(&[long.as_bytes(), &[0]].concat());
        for axis in [1, 2, 3, 4] {
            for function in 4..10 {
                for name in [&b"V.A.WCS\0"[..], b"V.A.WCS.Y\0"] {
                    let found = self.ask(0x12_2301, axis << 16 | function, 8, name);
                    self.ask(0x12_2301, axis << 12 | function, 8, name);
                    self.ask(0x12_2302, axis << 16 | function, 8, name);
                    if let (4, Some(handle)) = (function, u32_at(&found, 0)) {
                        self.ask(0x12_2301, 0x47, 8, &numbers(&[handle, 0]));
                    }
                }
            }
        }
        for handle in [0x200_1234, 0x7C00_0001, 1] {
            for indices in [&[][..], &[0], &[1], &[4], &[5], &[257], &[0, 1]] {
                let count = u32::try_from(indices.len()).unwrap();
                let header = [&[handle, count], indices].concat();
                self.ask(0x12_2301, 0x47, 64, &numbers(&header));
                self.ask(0x12_2301, 0x47, 64, &[numbers(&header), vec![0; 4]].concat());
                self.ask(0x12_2301, 0x47, 64, &numbers(&[handle, count]));
            }
        }
        let matrix = self.ask(0x12_2301, 0x46, 4, b"V.E.matrix\0");
        if let Some(handle) = u32_at(&matrix, 0) {
            for indices in [[0, 1], [1, 0], [1, 2]] {
                self.ask(0x12_2301, 0x47, 64, &numbers(&[handle, 2, indices[0], indices[1]]));
            }
        }
        self.ask(0x12_2301, 0x47, 2, &numbers(&[0x200_1234, 0]));
        self.read(553, 0x12_0101, 0x15, 2);
        self.read(552, 0x12_2301, 0x44, 4);
    }

    /// Reads a variable by name and by handle, and its description, in channels 1 and 2.
    fn named(&mut self, name: &[u8]) {
        for group in [0x12_2301, 0x12_2302] {
            self.ask(group, 0x48, 4096, name);
            self.ask(group, 0x4C, 4096, name);
            let handle = self.ask(group, 0x46, 4, name);
            if let Some(handle) = u32_at(&handle, 0) {
                self.ask(group, 0x47, 4096, &numbers(&[handle, 0]));
                self.ask(group, 0x47, 4096, &numbers(&[handle, 1, 1]));
            }
        }
    }
}

fn numbers(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}
