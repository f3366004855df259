//! What the three ADS services have on the wire, each its own and all in the same way.

use ads_cnc::ads::{AdsError, Command, ReadReplyRef, ReadWriteReplyRef, WriteReply};
use ads_cnc::layout::Stream;
use ads_cnc::operation::Service;
use ads_cnc::{Decode, Encode, Error};

/// The service that a command asks for, if it is one of the three.
pub const fn service_of(command: Command) -> Option<Service> {
    match command {
        Command::READ => Some(Service::Read),
        Command::WRITE => Some(Service::Write),
        Command::READ_WRITE => Some(Service::ReadWrite),
        _ => None,
    }
}

/// The requirement that says what a service is.
pub(crate) const fn clause(service: Service) -> &'static str {
    match service {
        Service::Read => "ADS-1",
        Service::Write => "ADS-2",
        Service::ReadWrite => "ADS-3",
    }
}

/// The stream of a service's request.
pub(crate) const fn request_stream(service: Service) -> Stream {
    match service {
        Service::Read => Stream::ReadRequest,
        Service::Write => Stream::WriteRequest,
        Service::ReadWrite => Stream::ReadWriteRequest,
    }
}

/// The stream of a service's reply.
pub(crate) const fn reply_stream(service: Service) -> Stream {
    match service {
        Service::Read => Stream::ReadReply,
        Service::Write => Stream::WriteReply,
        Service::ReadWrite => Stream::ReadWriteReply,
    }
}

/// Result and data of a service's reply; of a Write there is never any data.
pub fn decode_reply(service: Service, payload: &[u8]) -> Result<(AdsError, Option<&[u8]>), Error> {
    match service {
        Service::Read => ReadReplyRef::decode(payload).map(|reply| (reply.result, reply.data)),
        Service::Write => WriteReply::decode(payload).map(|reply| (reply.result, None)),
        Service::ReadWrite => {
            ReadWriteReplyRef::decode(payload).map(|reply| (reply.result, reply.data))
        }
    }
}

/// A service's reply; a Write's has no room for data and leaves it out.
pub fn encode_reply(
    service: Service,
    result: AdsError,
    data: Option<&[u8]>,
) -> Result<Vec<u8>, Error> {
    match service {
        Service::Read => ReadReplyRef { result, data }.encode_to_vec(),
        Service::Write => WriteReply { result }.encode_to_vec(),
        Service::ReadWrite => ReadWriteReplyRef { result, data }.encode_to_vec(),
    }
}
