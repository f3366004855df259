//! Requirements, streams and replies of the three ADS services (Read, Write, ReadWrite).

use ads_cnc::ads::{AdsError, Command, ReadReplyRef, ReadWriteReplyRef, WriteReply};
use ads_cnc::layout::Stream;
use ads_cnc::operation::Service;
use ads_cnc::{Decode, Encode, Error};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

/// The service of a command; `None` for other commands.
pub const fn service_of(command: Command) -> Option<Service> {
    match command {
        Command::READ => Some(Service::Read),
        Command::WRITE => Some(Service::Write),
        Command::READ_WRITE => Some(Service::ReadWrite),
        _ => None,
    }
}

/// The requirement that specifies a service.
pub(crate) const fn clause(service: Service) -> ClauseId {
    match service {
        Service::Read => ADS_1,
        Service::Write => ADS_2,
        Service::ReadWrite => ADS_3,
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

/// Result and data of a service's reply; the reply to a Write has no data.
pub fn decode_reply(service: Service, payload: &[u8]) -> Result<(AdsError, Option<&[u8]>), Error> {
    match service {
        Service::Read => ReadReplyRef::decode(payload).map(|reply| (reply.result, reply.data)),
        Service::Write => WriteReply::decode(payload).map(|reply| (reply.result, None)),
        Service::ReadWrite => {
            ReadWriteReplyRef::decode(payload).map(|reply| (reply.result, reply.data))
        }
    }
}

/// Encodes a service's reply; the reply to a Write has no data.
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
