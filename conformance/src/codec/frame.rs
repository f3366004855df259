//! Whole frames: an AMS/TCP header, an AMS header and the stream of the service.

use ads_cnc::ads::{AdsError, AmsHeader, AmsTcpHeader, Command, FrameRef, StateFlags};
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::{Decode, Encode};
use ads_cnc_vectors::{Context, Value};

use super::field_reader::FieldReader;
use super::stream::{from_fields, to_fields};
use super::{CodecError, Decoded, collect, data, stream, uns16, uns32};

/// The length field of the AMS header, which the vectors omit because it is a counter.
const LENGTH: &str = "data_length";

const SERVICES: [&str; 6] = [
    "read-request",
    "read-reply",
    "write-request",
    "write-reply",
    "read-write-request",
    "read-write-reply",
];

/// The name of the field that contains the stream of the service, such as `read_request`.
fn field_of(stream: &str) -> String {
    stream.replace('-', "_")
}

pub(super) fn decode(context: &Context, bytes: &[u8]) -> Result<Decoded, CodecError> {
    let Some((frame, len)) = FrameRef::split(bytes, u32::MAX)? else {
        return Err(cut(context, bytes));
    };
    let header = frame.header();
    let mut ams_header = to_fields(context, &header)?;
    ams_header.remove(LENGTH);
    let mut fields = collect(vec![
        ("ams_tcp_header", Value::Record(collect(vec![("reserved", uns16(0))]))),
        ("ams_header", Value::Record(ams_header)),
    ]);
    // If bytes follow the frame, report the error of the service's stream, which then is too long.
    let rest = bytes.get(FrameRef::HEADERS_LEN..).unwrap_or_default();
    if let Some((name, value)) = service(context, &header, rest)? {
        fields.insert(name, value);
    }
    if len != bytes.len() {
        return Err(CodecError::InvalidFields("bytes after the frame".to_owned()));
    }
    let bytes = FrameRef::new(header, frame.data())?.encode_to_vec()?;
    Ok(Decoded { fields, bytes })
}

/// The error of an incomplete frame, which is the error of its first incomplete part.
fn cut(context: &Context, bytes: &[u8]) -> CodecError {
    let parts = || -> Result<(), CodecError> {
        let (tcp, rest) = bytes.split_at(bytes.len().min(AMS_TCP_HEADER_LEN));
        AmsTcpHeader::decode(tcp)?;
        let (header, data) = rest.split_at(rest.len().min(AMS_HEADER_LEN));
        service(context, &AmsHeader::decode(header)?, data)?;
        Ok(())
    };
    // Data that belongs to no service is not decoded as a stream: only the length in the header
    // shows that the data is truncated.
    let rest =
        || CodecError::InvalidFields("fewer bytes of data than the header requires".to_owned());
    parts().err().unwrap_or_else(rest)
}

/// Name and fields of the service's stream; `data` and the bytes for a command that is not a
/// service, and for state flags other than those of a request or a response. `None` if the AMS
/// header contains an error and no bytes follow.
fn service(
    context: &Context,
    header: &AmsHeader,
    bytes: &[u8],
) -> Result<Option<(String, Value)>, CodecError> {
    if bytes.is_empty() && header.error != AdsError::NO_ERROR {
        return Ok(None);
    }
    let name = match (header.command, header.state_flags) {
        (Command::READ, StateFlags::REQUEST) => "read-request",
        (Command::READ, StateFlags::RESPONSE) => "read-reply",
        (Command::WRITE, StateFlags::REQUEST) => "write-request",
        (Command::WRITE, StateFlags::RESPONSE) => "write-reply",
        (Command::READ_WRITE, StateFlags::REQUEST) => "read-write-request",
        (Command::READ_WRITE, StateFlags::RESPONSE) => "read-write-reply",
        _ => return Ok(Some(("data".to_owned(), data(bytes)))),
    };
    let decoded = stream::decode(name, context, bytes)?;
    Ok(Some((field_of(name), Value::Record(decoded.fields))))
}

pub(super) fn encode(of: FieldReader<'_>, context: &Context) -> Result<Vec<u8>, CodecError> {
    let tcp = of.record("ams_tcp_header")?;
    if tcp.number::<u16>("reserved")? != 0 {
        return Err(CodecError::InvalidFields(
            "the reserved field of a frame must be 0".to_owned(),
        ));
    }
    let mut header = of.record("ams_header")?.0.clone();
    header.insert(LENGTH.to_owned(), uns32(0));
    let header: AmsHeader = from_fields(context, &header)?;
    let data = match SERVICES.into_iter().find(|stream| of.has(&field_of(stream))) {
        Some(service) => stream::encode(service, context, of.record(&field_of(service))?.0)?,
        None if of.has("data") => of.bytes("data")?,
        None => Vec::new(),
    };
    Ok(FrameRef::new(header, &data)?.encode_to_vec()?)
}
