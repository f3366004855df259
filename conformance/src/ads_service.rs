//! Requirements, streams and replies of the three ADS services (Read, Write, ReadWrite).

use ads_cnc::ads::{AdsError, Command, ReadReplyRef, ReadWriteReplyRef, WriteReply};
use ads_cnc::layout::Stream;
use ads_cnc::operation::AdsService;
use ads_cnc::{Decode, Encode, Error};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

/// The service of a command; `None` for other commands.
pub const fn service_of(command: Command) -> Option<AdsService> {
    match command {
        Command::READ => Some(AdsService::Read),
        Command::WRITE => Some(AdsService::Write),
        Command::READ_WRITE => Some(AdsService::ReadWrite),
        _ => None,
    }
}

/// The requirement that specifies a service.
pub(crate) const fn clause(service: AdsService) -> ClauseId {
    match service {
        AdsService::Read => ADS_1,
        AdsService::Write => ADS_2,
        AdsService::ReadWrite => ADS_3,
    }
}

/// The stream of a service's request.
pub(crate) const fn request_stream(service: AdsService) -> Stream {
    match service {
        AdsService::Read => Stream::ReadRequest,
        AdsService::Write => Stream::WriteRequest,
        AdsService::ReadWrite => Stream::ReadWriteRequest,
    }
}

/// The stream of a service's reply.
pub(crate) const fn reply_stream(service: AdsService) -> Stream {
    match service {
        AdsService::Read => Stream::ReadReply,
        AdsService::Write => Stream::WriteReply,
        AdsService::ReadWrite => Stream::ReadWriteReply,
    }
}

/// Decodes the payload of a service's reply into result and data. The data is `None` for a Write,
/// and if the reply ends after a result that is not 0.
///
/// # Errors
/// If the payload is not a reply of the service, for example because bytes follow the result of a
/// Write.
pub fn decode_reply(
    service: AdsService,
    payload: &[u8],
) -> Result<(AdsError, Option<&[u8]>), Error> {
    match service {
        AdsService::Read => ReadReplyRef::decode(payload).map(|reply| (reply.result, reply.data)),
        AdsService::Write => WriteReply::decode(payload).map(|reply| (reply.result, None)),
        AdsService::ReadWrite => {
            ReadWriteReplyRef::decode(payload).map(|reply| (reply.result, reply.data))
        }
    }
}

/// Encodes the payload of a service's reply; `data` is ignored for a Write.
///
/// # Errors
/// For a Read or a ReadWrite: if the result is 0 and `data` is `None`, or if `data` exceeds the
/// maximum length of the reply's stream.
pub fn encode_reply(
    service: AdsService,
    result: AdsError,
    data: Option<&[u8]>,
) -> Result<Vec<u8>, Error> {
    match service {
        AdsService::Read => ReadReplyRef { result, data }.encode_to_vec(),
        AdsService::Write => WriteReply { result }.encode_to_vec(),
        AdsService::ReadWrite => ReadWriteReplyRef { result, data }.encode_to_vec(),
    }
}
