//! Requests whose replies depend on earlier requests, requests at the ends of lists, and requests
//! with unusual addresses.

use ads_cnc::ads::{AmsPort, Command};

use super::{Transcript, numbers};
use crate::number::u32_at;

const RESPONSE: &[u8] = b"V.G.SERVICE.RESPONSE\0";
const REQUEST: &[u8] = b"V.G.SERVICE.REQUEST\0";
const REQUEST_STATE: &[u8] = b"V.G.SERVICE.REQUEST_STATE\0";
const RESPONSE_STATE: &[u8] = b"V.G.SERVICE.RESPONSE_STATE\0";

impl Transcript<'_> {
    pub(super) fn sequences(&mut self) {
        self.addresses();
        self.contents();
        self.parts();
        self.handles();
        self.between_channels();
    }

    /// Writes a content and reads it back.
    fn write_and_read(&mut self, port: u16, group: u32, offset: u32, data: &[u8]) {
        self.write(port, group, offset, data);
        self.read(port, group, offset, 256);
    }

    /// Writes a variable by name and reads it back.
    fn write_and_read_by_name(&mut self, group: u32, name: &[u8], value: &[u8]) {
        self.write(552, group, 0x4A, &[name, value].concat());
        self.ask(group, 0x48, 4096, name);
    }

    fn addresses(&mut self) {
        let read = [0x12_0101_u32, 0x1B, 4].map(u32::to_le_bytes).concat();
        self.frame_from(AmsPort(40000), AmsPort(553), Command::READ, &read);
        self.read(552, 0x12_1306, 0, 4);
        self.read(552, 0x12_2306, 1, 4);
        self.read(552, 0x12_1301, 0x0101_0001, 256);
        self.read(553, 0x02_0106, 1, 4);
        self.read(553, 0x02_0103, 1, 4);
        self.read(553, 0x12_0205, 1, 8);
        self.read(553, 0x12_0101, 0x15, 0x1_0002);
        self.read(553, 0x12_0101, 0x90, 4094);
        self.read(552, 0x12_2302, 2, 8);
        for index in [257_u32, 2, 3] {
            self.ask(0x12_2302, 0x1B, 96, &index.to_le_bytes());
        }
        self.ask(0x12_2301, 0x22, 8, b"V.L.depth\0");
        self.ask(0x12_2301, 0x48, 8, b"v.e.VARTEST\0");
    }

    fn contents(&mut self) {
        for there in [1, 0] {
            self.write(553, 0x12_0101, 0x1F, &[there]);
            self.read(552, 0x12_2301, 3, 4);
            self.ask(0x12_2301, 0x20, 8, &[1, 0, 0, 0]);
        }
        self.write_and_read(553, 0x12_0101, 0x1D, b"a longer text\0");
        self.write_and_read(553, 0x12_0101, 0x1D, b"short\0");
        self.write_and_read(553, 0x12_0101, 0x14, &[9]);
        self.write_and_read(553, 0x12_0101, 0x1A, &1.1_f64.to_le_bytes());
        self.write_and_read(553, 0x02_0101, 1, &[1]);
        self.write_and_read(553, 0x12_0101, 1, &[0]);
        self.write_and_read(553, 0x12_0102, 1, &[1]);
        self.read(553, 0x12_0101, 1, 1);
        self.write_and_read(552, 0x12_3301, 2, &(-7_i16).to_le_bytes());
        self.write_and_read(552, 0x12_3301, 2, &7_i16.to_le_bytes());
        self.write_and_read(552, 0x12_3301, 0x1_0001, &[0]);
        self.read(552, 0x12_3300, 0x1001, 1);
        self.write_and_read(552, 0x12_1302, 0x2_0002, &[1; 8]);
        // Writing axis number 0 removes the axis from the channel; writing 3 returns it.
        self.read(552, 0x12_1301, 0x3_0002, 8);
        self.write_and_read(552, 0x12_1301, 0x3_0001, &[0, 0]);
        self.read(552, 0x12_1301, 0x3_0002, 8);
        self.write_and_read(552, 0x12_1301, 0x3_0001, &[3, 0]);
    }

    fn parts(&mut self) {
        let one = 0x12_2301;
        self.write_and_read_by_name(one, b"V.E.Variable_2[0]\0", &[9]);
        self.ask(one, 0x48, 64, b"V.E.Variable_2\0");
        self.write_and_read_by_name(one, b"V.E.text\0", b"abc\0");
        self.write_and_read_by_name(one, b"V.E.text\0", b"abc");
        self.write_and_read_by_name(one, b"V.E.texts[2]\0", b"another text\0");
        self.write_and_read_by_name(one, b"V.CYC.count\0", &[1, 2, 3, 4]);
        self.ask(one, 0x48, 4, b"V.E.largest[12]\0");
        let long = format!("V.E.name_of_255_characters_{}\0", "x".repeat(228));
        self.write_and_read_by_name(one, long.as_bytes(), &[7]);
        self.write(552, one, 0x4A, &[&b"V.E.Variable_123\0"[..], &[3; 2031]].concat());
        let by_index: [(&[u8], &[&[u32]]); 4] = [
            (b"V.E.cube\0", &[&[1, 2, 3], &[0, 0, 4]]),
            (b"V.E.matrix\0", &[&[0, 3], &[1, 3]]),
            (b"V.E.texts\0", &[&[1], &[2]]),
            (b"V.E.largest\0", &[&[], &[511]]),
        ];
        for (name, all) in by_index {
            let handle = self.ask(one, 0x46, 4, name);
            let handle = u32_at(&handle, 0).unwrap_or_default();
            for indices in all {
                let count = u32::try_from(indices.len()).unwrap();
                let request = numbers(&[&[handle, count], *indices].concat());
                self.ask(one, 0x47, 4096, &request);
            }
        }
        let long = self.ask(one, 0x46, 4, b"V.E.Variable_122\0");
        let long = u32_at(&long, 0).unwrap_or_default();
        self.write(552, one, 0x49, &[numbers(&[long, 1, 300]), vec![5; 4]].concat());
        self.ask(one, 0x47, 4096, &numbers(&[long, 0]));
        self.write(552, one, 0x49, &numbers(&[&[long, 0][..], &[1; 510]].concat()));
        self.write(552, one, 0x49, &[numbers(&[0x200_0002, 0]), vec![1, 1]].concat());
        self.ask(one, 0x47, 4, &numbers(&[0x200_0002, 0]));
    }

    fn handles(&mut self) {
        let one = 0x12_2301;
        let handle = |bytes: Vec<u8>| u32_at(&bytes, 0).unwrap_or_default();
        let first = handle(self.ask(one, 0x46, 4, b"V.E.uns16\0"));
        for number in 30..60 {
            self.ask(one, 0x46, 4, format!("V.E.Variable_{number}\0").as_bytes());
        }
        self.ask(one, 0x47, 4, &numbers(&[first, 0]));
        self.ask(0x12_2302, 0x46, 4, b"V.E.channel\0");
        self.ask(one, 0x47, 4, &numbers(&[first, 0]));
        // The variables of the Service Interface, by handle as well as by name.
        self.write_and_read_by_name(one, REQUEST, b"a request of more than twenty characters\0");
        let request = handle(self.ask(one, 0x46, 4, REQUEST));
        self.ask(one, 0x47, 256, &numbers(&[request, 0]));
        let state = handle(self.ask(one, 0x46, 4, REQUEST_STATE));
        self.write_and_read_by_name(one, RESPONSE_STATE, &[1, 0, 0, 0]);
        self.write(552, one, 0x49, &numbers(&[state, 0, 1]));
        self.ask(one, 0x48, 4, RESPONSE_STATE);
        self.write_and_read_by_name(one, RESPONSE, &[&[b'y'; 127][..], &[0]].concat());
        self.write_and_read_by_name(one, RESPONSE, b"short\0");
        self.write_and_read_by_name(
            one,
            b"V.G.SERVICE.UUID\0",
            b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0",
        );
    }

    fn between_channels(&mut self) {
        for (group, name) in [(0x12_2301, REQUEST_STATE), (0x12_2302, RESPONSE_STATE)] {
            self.write_and_read_by_name(group, name, &[1, 0, 0, 0]);
            self.ask(0x12_2301, 0x48, 4, REQUEST_STATE);
        }
    }
}
