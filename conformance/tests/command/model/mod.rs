//! The data model of the simulated CNC, in most tests as read and written by the published crate
//! `ads`, a client that is independent of this project. Most expected bytes are literals.

mod axes;
mod dynamic;
mod editions;
mod elements;
mod files;
mod objects;
mod programs;
mod service;
mod timed;
mod variables;

use std::time::Duration;

use crate::common::{Serve, task};
use ads::{AmsAddr, AmsNetId, Client, Source, Timeouts};

/// The index group of the variables of channel 1.
const CHANNEL_1: u32 = 0x12_2301;

/// A CNC in a separate process, and a client of it.
struct Cnc {
    client: Client,
    net_id: AmsNetId,
    _serve: Serve,
}

impl Cnc {
    fn start(options: &[&str]) -> Self {
        let serve = Serve::start(options);
        let timeouts = Timeouts::new(Duration::from_secs(5));
        let client = Client::new(&*serve.addr, timeouts, Source::Auto).unwrap();
        Self { client, net_id: serve.net_id.parse().unwrap(), _serve: serve }
    }

    fn at(&self, port: u16) -> Task<'_> {
        Task(self.client.device(AmsAddr::new(self.net_id, port)))
    }

    fn geo(&self) -> Task<'_> {
        self.at(551)
    }

    fn sda(&self) -> Task<'_> {
        self.at(552)
    }

    fn com(&self) -> Task<'_> {
        self.at(553)
    }
}

/// A task of the CNC; a rejected request returns its error number.
#[derive(Clone, Copy)]
struct Task<'a>(ads::Device<'a>);

impl Task<'_> {
    fn read(self, group: u32, offset: u32, length: usize) -> Result<Vec<u8>, u32> {
        task::read(self.0, group, offset, length)
    }

    fn write(self, group: u32, offset: u32, data: &[u8]) -> Result<(), u32> {
        task::number(self.0.write(group, offset, data))
    }

    fn ask(self, group: u32, offset: u32, data: &[u8]) -> Result<Vec<u8>, u32> {
        task::ask(self.0, group, offset, data)
    }
}
