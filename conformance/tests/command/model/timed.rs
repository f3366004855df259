//! A CNC whose clock only the test advances.

use std::time::Duration;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_conformance::simulator::{Cnc, Model};

use super::CHANNEL_1;

pub(crate) struct Timed(pub(crate) Cnc);

impl Timed {
    pub(crate) fn new(model: &str) -> Self {
        Self(Cnc::new(Model::from_toml(model, "timed").unwrap()).with_stopped_clock())
    }

    pub(crate) fn pass(&self, milliseconds: u64) {
        self.0.pass(Duration::from_millis(milliseconds));
    }

    /// Sends a ReadWrite to the group of variables of channel 1.
    pub(crate) fn ask(&self, offset: u32, data: &[u8]) -> Result<Vec<u8>, u32> {
        self.call(AmsPort::SDA, AdsService::ReadWrite, CHANNEL_1, offset, data)
    }

    /// Sends a Read to the group of variables of channel 1.
    pub(crate) fn read(&self, offset: u32) -> Result<Vec<u8>, u32> {
        self.call(AmsPort::SDA, AdsService::Read, CHANNEL_1, offset, &[])
    }

    /// Writes a variable of channel 1 by its name.
    pub(crate) fn write(&self, name: &str, value: &[u8]) -> Result<(), u32> {
        let data = [name.as_bytes(), b"\0", value].concat();
        let done = self.call(AmsPort::SDA, AdsService::Write, CHANNEL_1, 0x4A, &data);
        done.map(|data| assert_eq!(data, [0; 0]))
    }

    /// Writes an object of channel 1.
    pub(crate) fn write_object(&self, offset: u32, content: &[u8]) -> Result<(), u32> {
        let done = self.call(AmsPort::COM, AdsService::Write, 0x12_0101, offset, content);
        done.map(|data| assert_eq!(data, [0; 0]))
    }

    fn call(
        &self,
        port: AmsPort,
        service: AdsService,
        group: u32,
        offset: u32,
        data: &[u8],
    ) -> Result<Vec<u8>, u32> {
        let call = Call {
            port,
            service,
            index_group: IndexGroup::new(group),
            index_offset: IndexOffset::new(offset),
            read_length: 2048,
            data,
        };
        self.0.answer(&call).map_err(|error| error.0)
    }
}
