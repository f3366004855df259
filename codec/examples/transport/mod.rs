//! A transport that uses the published crate `ads`.

use std::{env, error::Error, time::Duration};

use ads::{AmsAddr, AmsNetId, Client, Source, Timeouts};
use ads_cnc::operation::{AdsService, Operation};

pub(crate) type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Converts an ADS error with a number from 0x700 on, as a CNC returns, to `None`. Returns any
/// other error, for example of the network, of decoding, or with a lower number.
#[allow(dead_code, reason = "the examples that write need every error")]
pub(crate) fn unless_rejected<T>(result: Result<T>) -> Result<Option<T>> {
    match result {
        Err(error) => match error.downcast_ref() {
            Some(ads::Error::Ads(_, _, 0x700..)) => Ok(None),
            _ => Err(error),
        },
        Ok(reply) => Ok(Some(reply)),
    }
}

pub(crate) struct Cnc {
    client: Client,
    net_id: AmsNetId,
}

impl Cnc {
    /// Connects to the address in the first argument, such as `127.0.0.1:48898`. The second
    /// argument is the NetId of the CNC, such as `127.0.0.1.1.1`.
    pub(crate) fn from_args() -> Result<Self> {
        let argument = |place| env::args().nth(place).ok_or("arguments: HOST:PORT NET_ID …");
        let timeouts = Timeouts::new(Duration::from_secs(5));
        let client = Client::new(&*argument(1)?, timeouts, Source::Auto)?;
        Ok(Self { client, net_id: argument(2)?.parse()? })
    }

    /// Sends the operation and decodes its reply, which borrows from `buf`.
    pub(crate) fn call<'r, O: Operation>(
        &self,
        op: &O,
        buf: &'r mut Vec<u8>,
    ) -> Result<O::Reply<'r>> {
        let device = self.client.device(AmsAddr::new(self.net_id, op.port().0));
        let (group, offset) = (op.index_group().get(), op.index_offset().get());
        let mut data = vec![0; op.encoded_len()];
        op.encode(&mut data)?;
        buf.resize(op.read_length() as usize, 0);
        let len = match op.service() {
            AdsService::Read => device.read(group, offset, buf)?,
            AdsService::ReadWrite => device.write_read(group, offset, &data, buf)?,
            AdsService::Write => device.write(group, offset, &data).map(|()| 0)?,
        };
        Ok(op.decode_reply(&buf[..len])?)
    }
}
