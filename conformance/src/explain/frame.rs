//! Explains AMS/TCP frames: the headers, the ADS service, and the stream in the data of the
//! service.

use std::collections::HashMap;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsAddr, AmsHeader, AmsPort, Command, FrameRef, StateFlags};
use ads_cnc::layout::Stream;
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::operation::{AdsService, Call, DispatchError};
use ads_cnc::{Decode as _, Error};

use super::address;
use super::codes;
use super::explanation::{ExplainedFault, ExplainedStream, ServiceAddress};
use super::part;
use crate::ads_service::{reply_stream, request_stream, service_of};
use crate::number::{to_u32, to_usize, u32_at};
use crate::text::plural;
use crate::value_format::ValueFormat;

/// Command, index group and offset of requests, by source, target and invoke ID.
type PendingRequests = HashMap<(AmsAddr, AmsAddr, u32), (Command, IndexGroup, IndexOffset)>;

/// Whether the bytes begin with a frame, or at least with the valid headers of a frame (AMS/TCP and
/// AMS).
pub fn looks_like_frame(bytes: &[u8]) -> bool {
    match FrameRef::split(bytes, u32::MAX) {
        Ok(Some(_)) => true,
        Ok(None) => bytes.len() >= FrameRef::HEADERS_LEN,
        Err(_) => false,
    }
}

/// Explains consecutive frames.
pub(super) fn of_frames(
    ads_address: Option<&ServiceAddress>,
    bytes: &[u8],
    values: &ValueFormat,
) -> Vec<ExplainedStream> {
    let mut frames =
        FrameExplainer { ads_address, values, requests: HashMap::new(), parts: Vec::new() };
    let mut at = 0_usize;
    loop {
        let rest = bytes.get(at..).unwrap_or_default();
        let Some(len) = frames.frame(at, rest) else { break };
        at = at.saturating_add(len);
        if at >= bytes.len() {
            break;
        }
    }
    frames.parts
}

struct FrameExplainer<'q> {
    ads_address: Option<&'q ServiceAddress>,
    values: &'q ValueFormat,
    requests: PendingRequests,
    parts: Vec<ExplainedStream>,
}

impl FrameExplainer<'_> {
    /// Explains the frame that starts at offset `at` of the input; returns its length if the frame
    /// is complete and its headers have no error.
    fn frame(&mut self, at: usize, bytes: &[u8]) -> Option<usize> {
        let split = FrameRef::split(bytes, u32::MAX);
        let (tcp, rest) = halves(bytes, AMS_TCP_HEADER_LEN);
        let whole = self.header(Stream::AmsTcpHeader, at, tcp);
        if let (true, Err(error)) = (whole, &split)
            && error.field().stream() == Some(Stream::AmsTcpHeader)
        {
            self.fault(error, 0, rest);
            return None;
        }
        if !whole {
            return None;
        }
        let (ams, data) = halves(rest, AMS_HEADER_LEN);
        let whole = self.header(Stream::AmsHeader, at.saturating_add(AMS_TCP_HEADER_LEN), ams);
        if let (true, Err(error)) = (whole, &split) {
            self.fault(error, AMS_TCP_HEADER_LEN, data);
            return None;
        }
        let header = AmsHeader::decode(ams).ok()?;
        let after = at.saturating_add(FrameRef::HEADERS_LEN);
        let (data, len) = match split {
            Ok(Some((frame, len))) => (frame.data(), Some(len)),
            _ => (data, None),
        };
        if len.is_none() {
            self.cut(&header, data.len());
        }
        self.service(&header, after, data);
        len
    }

    /// Explains a header by its field table; returns whether the header has no error.
    fn header(&mut self, stream: Stream, at: usize, bytes: &[u8]) -> bool {
        let part = part::of_stream(stream, at, bytes, self.values);
        let whole = part.faults.is_empty();
        self.parts.push(part);
        whole
    }

    /// Adds an error to the header that was explained last, and the bytes after it as an unread
    /// part.
    fn fault(&mut self, error: &Error, base: usize, rest: &[u8]) {
        let Some(part) = self.parts.last_mut() else { return };
        part.push_fault(ExplainedFault::of(error, base));
        if !rest.is_empty() {
            let at = part.at.saturating_add(part.length);
            self.parts.push(ExplainedStream::opaque("Unread after the error".to_owned(), at, rest));
        }
    }

    /// Adds an error to the AMS header of a frame that contains less data than its header states.
    fn cut(&mut self, header: &AmsHeader, there: usize) {
        let Some(part) = self.parts.last_mut() else { return };
        let found = to_u32(there);
        let expected = header.data_length;
        part.push_fault(ExplainedFault {
            class: "truncated",
            field: "stream".to_owned(),
            offset: AMS_HEADER_LEN,
            expected: Some(expected),
            found: Some(found),
            text: format!(
                "the frame is truncated after the header: expected {}, found {found}",
                plural(expected, "byte")
            ),
        });
    }

    fn service(&mut self, header: &AmsHeader, at: usize, data: &[u8]) {
        let reply = header.state_flags.0 & RESPONSE_BIT != 0;
        if header.state_flags != StateFlags::REQUEST && header.state_flags != StateFlags::RESPONSE {
            let what = if reply { "response" } else { "request" };
            self.note(format!("the lowest bit of the state flags means a {what}"));
        }
        if reply && data.is_empty() && !header.error.is_ok() {
            return self.note("a reply with an AMS error may have no data (ADS-6)".to_owned());
        }
        let Some(service) = service_of(header.command) else {
            return self.other(header.command, reply, at, data);
        };
        let stream = if reply { reply_stream(service) } else { request_stream(service) };
        let mut part = part::of_stream(stream, at, data, self.values);
        let inside = inside(stream, data);
        let failed = reply && number(stream, data, "result").is_some_and(|result| result != 0);
        let faulty = !part.faults.is_empty();
        let length = match service {
            AdsService::Read => number(stream, data, "length"),
            _ => number(stream, data, "read_length"),
        };
        let ads_address = if reply {
            self.answered(header, service)
        } else {
            self.asks(header, (stream, service), data)
        };
        if let (Some(row), Some(_), Some(_)) = (part.rows.last_mut(), inside, ads_address) {
            row.below = row.field == "data" && row.length > 0;
            if row.below {
                row.value = format!("{}, below", plural(row.length, "byte"));
            }
        }
        self.parts.push(part);
        let Some(ads_address) = ads_address else {
            if reply && stream != Stream::WriteReply && !failed {
                self.note(
                    "the request is not in these bytes: specify its index group and offset"
                        .to_owned(),
                );
            }
            return;
        };
        // An error reply usually has no data, and if the stream of the service has an error, the
        // data may be missing completely.
        if (failed || faulty) && inside.is_none_or(|(_, data)| data.is_empty()) {
            return;
        }
        let (after, data) = inside.unwrap_or((data.len(), &[]));
        let mut part = address::of_data(&ads_address, at.saturating_add(after), data, self.values);
        if !reply && !faulty && part.faults.is_empty() {
            part.notes.extend(rejected(&ads_address, header.target.port, (service, length), data));
        }
        self.parts.push(part);
    }

    /// Returns the address in a request, and stores it for the reply.
    fn asks(
        &mut self,
        header: &AmsHeader,
        (stream, service): (Stream, AdsService),
        data: &[u8],
    ) -> Option<ServiceAddress> {
        let group = IndexGroup::new(number(stream, data, "index_group")?);
        let offset = IndexOffset::new(number(stream, data, "index_offset")?);
        let key = (header.source, header.target, header.invoke_id);
        self.requests.insert(key, (header.command, group, offset));
        let (port, service) = (Some(header.target.port), Some(service));
        Some(ServiceAddress { port, service, group, offset, reply: false })
    }

    /// The address to which a reply belongs: that of its request or, without a request, that given
    /// by the caller.
    fn answered(&mut self, header: &AmsHeader, service: AdsService) -> Option<ServiceAddress> {
        let key = (header.target, header.source, header.invoke_id);
        let requests = self.requests.get(&key).filter(|(command, ..)| *command == header.command);
        let (group, offset) = match requests {
            Some((_, group, offset)) => (*group, *offset),
            None => self.ads_address.map(|ads_address| (ads_address.group, ads_address.offset))?,
        };
        self.requests.remove(&key);
        let (port, service) = (Some(header.source.port), Some(service));
        Some(ServiceAddress { port, service, group, offset, reply: true })
    }

    /// Explains a command other than Read, Write and ReadWrite.
    fn other(&mut self, command: Command, reply: bool, at: usize, data: &[u8]) {
        let name = codes::command(command)
            .map_or_else(|| format!("AMS command {}", command.0), ToOwned::to_owned);
        let what = if reply { "response" } else { "request" };
        let title = format!("{name}, {what}: not a stream of the CNC");
        self.parts.push(ExplainedStream::opaque(title, at, data));
    }

    fn note(&mut self, note: String) {
        if let Some(part) = self.parts.last_mut() {
            part.notes.push(note);
        }
    }
}

/// The bit of the state flags that marks a response.
const RESPONSE_BIT: u16 = 1;

fn halves(bytes: &[u8], at: usize) -> (&[u8], &[u8]) {
    bytes.split_at_checked(at).unwrap_or((bytes, &[]))
}

/// The offset of the field `data` in the stream of a service, and the data as far as present;
/// `None` if the stream has no such field, or ends before it.
fn inside(stream: Stream, bytes: &[u8]) -> Option<(usize, &[u8])> {
    let data = ads_cnc::layout::Field::by_name(stream, "data")?.spec()?;
    let at = to_usize(data.offset);
    bytes.get(at..).map(|data| (at, data))
}

/// The number in a field, if the stream can be read up to the end of this field.
fn number(stream: Stream, bytes: &[u8], field: &str) -> Option<u32> {
    let mut number = None;
    // An error after the field is irrelevant here.
    let _fault = stream.walk(bytes, |segment| {
        if segment.field.name() == field {
            number = u32_at(segment.bytes, 0);
        }
    });
    number
}

/// The error with which the codec rejects a request although each of its streams is valid.
fn rejected(
    ads_address: &ServiceAddress,
    port: AmsPort,
    (service, read_length): (AdsService, Option<u32>),
    data: &[u8],
) -> Option<String> {
    let call = Call {
        port,
        service,
        index_group: ads_address.group,
        index_offset: ads_address.offset,
        read_length: read_length.unwrap_or(0),
        data,
    };
    match call.dispatch() {
        Err(DispatchError::Stream(error)) => {
            Some(format!("the codec rejects the request: {error}"))
        }
        // For a request to an address without a function, the explanation of the address contains
        // the reason.
        _ => None,
    }
}
