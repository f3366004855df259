//! Sends the requests over the crate `ads`, whose calls block.
//!
//!     over_ads HOST:PORT EXPECTED.json

use std::time::Duration;

use ads::{AmsAddr, AmsNetId, Client, Source, Timeouts};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_clients::{Result, Transport, arguments, show};

struct OverAds {
    client: Client,
    net_id: AmsNetId,
}

impl Transport for OverAds {
    async fn send(&self, call: Call<'_>) -> Result<Vec<u8>> {
        let device = self.client.device(AmsAddr::new(self.net_id, call.port.0));
        let (group, offset) = (call.index_group.get(), call.index_offset.get());
        let mut reply = vec![0; call.read_length as usize];
        let received = match call.service {
            AdsService::Read => device.read(group, offset, &mut reply),
            AdsService::ReadWrite => device.write_read(group, offset, call.data, &mut reply),
            AdsService::Write => device.write(group, offset, call.data).map(|()| 0),
        };
        match received {
            // Keep only the received bytes; zeros follow them.
            Ok(len) => reply.truncate(len),
            Err(ads::Error::Ads(_, _, number)) => return Err(AdsError(number).into()),
            Err(error) => return Err(error.into()),
        }
        Ok(reply)
    }
}

#[tokio::main(flavor = "current_thread")]
async fn main() -> Result<()> {
    let (address, expected) = arguments()?;
    // The client derives its NetId from the address of its socket; a CNC needs a route to this
    // NetId.
    let timeouts = Timeouts::new(Duration::from_secs(5));
    let client = Client::new(&*address, timeouts, Source::Auto)?;
    let net_id = AmsNetId::new(127, 0, 0, 1, 1, 1);
    show(&OverAds { client, net_id }, &expected).await
}
