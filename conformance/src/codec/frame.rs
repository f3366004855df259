//! Whole frames: two headers, and what the service says.

use ads_cnc::ads::{AdsError, AmsHeader, AmsTcpHeader, Command, FrameRef, StateFlags};
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::{Decode, Encode};
use ads_cnc_vectors::{Context, Value};

use super::given::Given;
use super::stream::{from_fields, to_fields};
use super::{Decoded, Refused, collect, data, stream, uns16, uns32};

/// The length of a header only counts.
const LENGTH: &str = "data_length";

const SERVICES: [&str; 6] = [
    "read-request",
    "read-reply",
    "write-request",
    "write-reply",
    "read-write-request",
    "read-write-reply",
];

/// The field of a frame that its service has.
fn field_of(stream: &str) -> String {
    stream.replace('-', "_")
}

pub(super) fn decode(context: &Context, bytes: &[u8]) -> Result<Decoded, Refused> {
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
    // What is after the frame is too much for its service.
    let rest = bytes.get(FrameRef::HEADERS_LEN..).unwrap_or_default();
    if let Some((name, value)) = service(context, &header, rest)? {
        fields.insert(name, value);
    }
    if len != bytes.len() {
        return Err(Refused::Unfit("a frame and more".to_owned()));
    }
    let bytes = FrameRef::new(header, frame.data())?.encode_to_vec()?;
    Ok(Decoded { fields, bytes })
}

/// Why a frame is none yet: the first part that has not come whole.
fn cut(context: &Context, bytes: &[u8]) -> Refused {
    let parts = || -> Result<(), Refused> {
        let (tcp, rest) = bytes.split_at(bytes.len().min(AMS_TCP_HEADER_LEN));
        AmsTcpHeader::decode(tcp)?;
        let (header, data) = rest.split_at(rest.len().min(AMS_HEADER_LEN));
        service(context, &AmsHeader::decode(header)?, data)?;
        Ok(())
    };
    // Data that no service takes apart do not tell that they are cut; their length does.
    let rest = || Refused::Unfit("less data than the header says".to_owned());
    parts().err().unwrap_or_else(rest)
}

/// The name and fields of the stream after the header, if there has to be one.
fn service(
    context: &Context,
    header: &AmsHeader,
    bytes: &[u8],
) -> Result<Option<(String, Value)>, Refused> {
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

pub(super) fn encode(of: Given<'_>, context: &Context) -> Result<Vec<u8>, Refused> {
    let tcp = of.record("ams_tcp_header")?;
    if tcp.number::<u16>("reserved")? != 0 {
        return Err(Refused::Unfit("a frame with a reserved number other than 0".to_owned()));
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
