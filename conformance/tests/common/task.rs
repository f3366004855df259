//! A simulated CNC in a separate process, and requests to its tasks with the crate `ads`, a client
//! that is independent of this project.

use std::time::Duration;

use ads::{AmsAddr, AmsNetId, Client, Device, Error, Source, Timeouts};

use super::Serve;

/// A CNC in a separate process, and a client of it.
pub(crate) struct Cnc {
    client: Client,
    net_id: AmsNetId,
    _serve: Serve,
}

impl Cnc {
    pub(crate) fn start(options: &[&str]) -> Self {
        let serve = Serve::start(options);
        Self { client: client(&serve), net_id: serve.net_id.parse().unwrap(), _serve: serve }
    }

    pub(crate) fn at(&self, port: u16) -> Task<'_> {
        self.at_net_id(self.net_id, port)
    }

    pub(crate) fn at_net_id(&self, net_id: AmsNetId, port: u16) -> Task<'_> {
        Task(self.client.device(AmsAddr::new(net_id, port)))
    }

    pub(crate) fn geo(&self) -> Task<'_> {
        self.at(551)
    }

    pub(crate) fn sda(&self) -> Task<'_> {
        self.at(552)
    }

    pub(crate) fn com(&self) -> Task<'_> {
        self.at(553)
    }
}

/// A client that uses the IP address of its socket as its NetId: 127.0.0.1.1.1.
pub(crate) fn client(serve: &Serve) -> Client {
    Client::new(&*serve.addr, Timeouts::new(Duration::from_secs(5)), Source::Auto).unwrap()
}

/// A task of the CNC; a rejected request returns its error number.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a>(pub(crate) Device<'a>);

impl Task<'_> {
    pub(crate) fn read(self, group: u32, offset: u32, length: usize) -> Result<Vec<u8>, u32> {
        let mut reply = vec![0xEE; length];
        let length = number(self.0.read(group, offset, &mut reply))?;
        reply.truncate(length);
        Ok(reply)
    }

    pub(crate) fn write(self, group: u32, offset: u32, data: &[u8]) -> Result<(), u32> {
        number(self.0.write(group, offset, data))
    }

    /// Sends a ReadWrite with a read length of 2048 bytes.
    pub(crate) fn ask(self, group: u32, offset: u32, data: &[u8]) -> Result<Vec<u8>, u32> {
        self.ask_for(group, offset, data, 2048)
    }

    pub(crate) fn ask_for(
        self,
        group: u32,
        offset: u32,
        data: &[u8],
        length: usize,
    ) -> Result<Vec<u8>, u32> {
        let mut reply = vec![0xEE; length];
        let length = number(self.0.write_read(group, offset, data, &mut reply))?;
        reply.truncate(length);
        Ok(reply)
    }
}

/// Converts an ADS error to its number; any other error fails the test.
pub(crate) fn number<T>(result: ads::Result<T>) -> Result<T, u32> {
    result.map_err(|error| match error {
        Error::Ads(_, _, number) => number,
        other => panic!("{other}"),
    })
}
