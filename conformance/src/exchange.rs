//! A request and its result, with all bytes.

use std::fmt;
use std::io;
use std::time::Duration;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsHeader, AmsPort, AmsTcpHeader, FrameRef, StateFlags};
use ads_cnc::limits::AMS_TCP_HEADER_LEN;
use ads_cnc::operation::{AdsService, Call, Function};
use ads_cnc::{Decode as _, Error};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::evidence::{Describe, Evidence};
use crate::gate::GateRejection;
use crate::text::plural;

/// A request and its result.
#[derive(Debug)]
pub struct Exchange {
    /// The AMS port of the request.
    pub port: AmsPort,
    pub service: AdsService,
    pub index_group: IndexGroup,
    pub index_offset: IndexOffset,
    pub read_length: u32,
    pub data: Vec<u8>,
    /// The whole frame of the request; empty if the request was rejected by the gate, cannot be
    /// encoded, belongs to a dry run, or had no connection.
    pub sent: Vec<u8>,
    /// The frame received, or the bytes that arrived instead.
    pub received: Vec<u8>,
    /// The reply and its AMS header, or the reason why there is no valid reply.
    pub outcome: Result<(AdsReply, AmsHeader), ExchangeError>,
    /// Violations of the rules of AMS/TCP and of the ADS services in the received bytes.
    pub violations: Vec<Violation>,
}

/// The reply of a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdsReply {
    /// Error of the AMS header.
    pub ams_error: AdsError,
    /// Result of the service.
    pub result: AdsError,
    /// The data; `None` if the reply ends after its result, as every reply to a Write does, or if
    /// it has an AMS error and ends after its headers.
    pub data: Option<Vec<u8>>,
}

impl AdsReply {
    /// The data of a successful reply, which is empty for a Write; `None` for an error.
    pub fn success(&self) -> Option<&[u8]> {
        match (self.ams_error.is_ok(), self.result.is_ok()) {
            (true, true) => Some(self.data.as_deref().unwrap_or_default()),
            _ => None,
        }
    }
}

impl fmt::Display for AdsReply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.ams_error, self.result, &self.data) {
            (AdsError::NO_ERROR, AdsError::NO_ERROR, Some(data)) => {
                f.write_str(&plural(data.len(), "byte"))
            }
            (AdsError::NO_ERROR, AdsError::NO_ERROR, None) => f.write_str("success without data"),
            (AdsError::NO_ERROR, result, _) => write!(f, "ADS error {result:#x}"),
            (error, ..) => write!(f, "AMS error {error:#x}"),
        }
    }
}

/// The reason why there is no valid reply.
#[derive(Debug)]
pub enum ExchangeError {
    /// The gate rejected the request.
    NotPermitted(Box<GateRejection>),
    /// The request was not sent, because this is a dry run.
    NotSent,
    /// The request cannot be encoded.
    Unsendable(Error),
    /// No reply arrived within this time.
    Silence(Duration),
    /// The target closed the connection before the whole reply had arrived.
    Closed,
    /// The reply was not examined, because only the request is judged.
    Unseen,
    /// The received bytes are not an AMS/TCP frame, or not a reply of the service.
    Malformed(Error),
    /// A network error.
    Io(String),
    /// The connection could not be opened.
    Disconnected(String),
}

impl ExchangeError {
    pub(crate) fn io(error: io::Error) -> Self {
        Self::Io(error.to_string())
    }

    pub(crate) fn disconnected(error: io::Error) -> Self {
        Self::Disconnected(error.to_string())
    }
}

impl From<GateRejection> for ExchangeError {
    fn from(rejection: GateRejection) -> Self {
        Self::NotPermitted(Box::new(rejection))
    }
}

impl fmt::Display for ExchangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPermitted(why) => write!(f, "not sent, rejected for safety: {why}"),
            Self::NotSent => f.write_str("not sent (dry run)"),
            Self::Unsendable(error) => write!(f, "not sent: {error}"),
            // The hashes of `doc/detection.tsv` depend on the texts of the following errors.
            Self::Silence(time) => write!(f, "no answer within {} ms", time.as_millis()),
            Self::Closed => f.write_str("connection closed without an answer"),
            Self::Unseen => f.write_str("not examined: only the request is judged"),
            Self::Malformed(error) => write!(f, "malformed answer: {error}"),
            Self::Io(error) => write!(f, "network: {error}"),
            Self::Disconnected(error) => write!(f, "no connection: {error}"),
        }
    }
}

/// A violation of a rule of AMS/TCP or of an ADS service, such as a wrong address or length.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    pub requirement: ClauseId,
    pub what: String,
}

impl Violation {
    pub(crate) fn of_invoke_id(id: u32, asked: u32) -> Self {
        let what = format!("a reply to invoke ID {id:#x} instead of {asked:#x}");
        Self { requirement: ADS_5, what }
    }
}

impl Exchange {
    pub(crate) fn new(call: &Call<'_>) -> Self {
        Self {
            port: call.port,
            service: call.service,
            index_group: call.index_group,
            index_offset: call.index_offset,
            read_length: call.read_length,
            data: call.data.to_vec(),
            sent: Vec::new(),
            received: Vec::new(),
            outcome: Err(ExchangeError::Closed),
            violations: Vec::new(),
        }
    }

    /// The reply, if a valid one arrived.
    pub fn reply(&self) -> Option<&AdsReply> {
        self.outcome.as_ref().ok().map(|(reply, _)| reply)
    }

    /// The data of a successful reply; `None` for an error or without a reply.
    pub fn success(&self) -> Option<&[u8]> {
        self.reply().and_then(AdsReply::success)
    }

    /// Whether the reply contains an error.
    pub fn is_error(&self) -> bool {
        self.reply().is_some_and(|reply| reply.success().is_none())
    }

    /// Whether the AMS header contains an error, but the data after it is a successful reply.
    pub(crate) fn contradicts_itself(&self) -> bool {
        let has_data = self.received.len() > FrameRef::HEADERS_LEN;
        let of_both = |answer: &AdsReply| !answer.ams_error.is_ok() && answer.result.is_ok();
        has_data && self.reply().is_some_and(of_both)
    }

    /// Whether the reply contains an error, or is a success without data.
    pub fn is_rejected(&self) -> bool {
        self.reply().is_some_and(|reply| reply.success().is_none_or(<[u8]>::is_empty))
    }

    /// The reply, or why no valid reply arrived, in a few words.
    pub fn result(&self) -> String {
        match &self.outcome {
            Ok((answer, _)) => answer.to_string(),
            Err(fault) => fault.to_string(),
        }
    }

    /// Like [`result`](Self::result), with the usual meaning of an ADS error number, if known.
    pub(crate) fn result_in_words(&self) -> String {
        let error = self.reply().filter(|reply| reply.ams_error.is_ok());
        let meaning = error.and_then(|answer| meaning(answer.result));
        let meaning = meaning.map_or_else(String::new, |meaning| format!(" ({meaning})"));
        format!("{}{meaning}", self.result())
    }

    pub fn call(&self) -> Call<'_> {
        Call {
            port: self.port,
            service: self.service,
            index_group: self.index_group,
            index_offset: self.index_offset,
            read_length: self.read_length,
            data: &self.data,
        }
    }
}

impl fmt::Display for Exchange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { port, service, index_group, index_offset, .. } = self;
        write!(f, "{service} {index_group}, {index_offset} at port {port}")
    }
}

/// The result as text.
impl Describe for &Exchange {
    fn describe(self) -> String {
        self.result()
    }
}

impl From<&Exchange> for Evidence {
    fn from(exchange: &Exchange) -> Self {
        let function = exchange.call().dispatch().ok().map(|request| request.function());
        let spec = function.map(Function::spec);
        // An error reply without data has no stream to show.
        let has_stream = |data: &&[u8]| exchange.success().is_some() || !data.is_empty();
        let data = exchange.reply().and_then(|reply| reply.data.as_deref()).filter(has_stream);
        let evidence = Self {
            call: exchange.to_string(),
            function,
            compared: function.into_iter().collect(),
            request_stream: spec.and_then(|spec| spec.request).map(|stream| stream.layout().name),
            reply_stream: spec.and_then(|spec| spec.reply).map(|stream| stream.layout().name),
            sent: Evidence::start(&exchange.data).to_vec(),
            received: data.map(|data| Self::start(data).to_vec()),
            result: exchange.result(),
            ..Self::default()
        };
        evidence.cut(&exchange.sent, &exchange.received)
    }
}

/// The usual meaning of an error number; the manuals do not document the CNC's numbers (ADS-7).
pub(crate) const fn meaning(error: AdsError) -> Option<&'static str> {
    Some(match error {
        AdsError::SERVICE_NOT_SUPPORTED => "service not supported",
        AdsError::INVALID_GROUP => "no such channel, axis or class",
        AdsError::INVALID_OFFSET => "no such object, element or function",
        AdsError::INVALID_ACCESS => "read or write not allowed",
        AdsError::INVALID_SIZE => "invalid size",
        AdsError::INVALID_DATA => "no such index or handle, or invalid now",
        AdsError::SYMBOL_NOT_FOUND => "no such name",
        _ => return None,
    })
}

/// The AMS header of a frame, even if its lengths are inconsistent.
fn header(frame: &[u8]) -> Option<AmsHeader> {
    let header = frame.get(AMS_TCP_HEADER_LEN..FrameRef::HEADERS_LEN)?;
    AmsHeader::decode(header).ok()
}

/// Whether the received bytes are taken for a reply over AMS. Either their AMS header contains the
/// source or target address of the request, or they end after a valid AMS/TCP header, before the
/// end of the AMS header.
pub(crate) fn is_of_ads(sent: &[u8], received: &[u8]) -> bool {
    let Some((sent, got)) = header(sent).zip(header(received)) else {
        return incomplete_frame(received).is_some();
    };
    let of_request = [sent.source, sent.target];
    of_request.contains(&got.source) || of_request.contains(&got.target)
}

/// The length of the frame that starts with these bytes, if they are only a part of the frame and
/// contain at least its AMS/TCP header.
pub(crate) fn incomplete_frame(received: &[u8]) -> Option<usize> {
    let header = AmsTcpHeader::decode(received.get(..AMS_TCP_HEADER_LEN)?).ok()?;
    let whole = usize::try_from(header.length).ok()?.checked_add(AMS_TCP_HEADER_LEN)?;
    (FrameRef::split(received, u32::MAX) == Ok(None)).then_some(whole)
}

/// The violation if the invoke ID of the received frame differs from that of the sent frame.
pub(crate) fn other_invoke_id(sent: &[u8], received: &[u8]) -> Option<Violation> {
    let (id, asked) = (header(received)?.invoke_id, header(sent)?.invoke_id);
    (id != asked).then(|| Violation::of_invoke_id(id, asked))
}

/// The violations in the AMS header of a response: a wrong command, wrong state flags or a wrong
/// address (ADS-5). The hashes of `doc/detection.tsv` depend on the texts of the violations.
pub(crate) fn violations(sent: &AmsHeader, got: &AmsHeader) -> Vec<Violation> {
    let mut broken = Vec::new();
    let mut check = |kept: bool, what: fmt::Arguments<'_>| {
        if !kept {
            broken.push(Violation { requirement: ADS_5, what: what.to_string() });
        }
    };
    let (ask, reply) = (sent.command, got.command);
    check(reply == ask, format_args!("a reply to command {1} instead of {0}", ask.0, reply.0));
    let flags = got.state_flags;
    let is_response = flags == StateFlags::RESPONSE;
    check(is_response, format_args!("state flags {:#06x} instead of 0x0005", flags.0));
    let (to, from) = (got.target, sent.source);
    check(to == from, format_args!("a reply to {to} instead of {from}"));
    let (by, asked) = (got.source, sent.target);
    check(by == asked, format_args!("a reply from {by} instead of {asked}"));
    broken
}
