//! Sends ReadDeviceInfo and ReadState requests, if the gate allows them.

use std::fmt;

use ads_cnc::Decode;
use ads_cnc::ads::{
    AdsError, AmsHeader, AmsPort, Command, DeviceInfoReply, DeviceStateReply, FrameRef, WriteReply,
};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::Client;
use crate::evidence::Evidence;
use crate::exchange::{ExchangeError, Violation, violations};
use crate::text::hex;

/// A command whose request has no data. The type that implements this trait is its reply.
pub trait Inquiry: for<'a> Decode<'a> {
    const COMMAND: Command;
    const NAME: &'static str;
    /// The requirement of the reply.
    const CLAUSE: ClauseId;

    /// The ADS error number; 0 means success.
    fn result(&self) -> AdsError;
}

impl Inquiry for DeviceInfoReply {
    const COMMAND: Command = Command::READ_DEVICE_INFO;
    const NAME: &'static str = "ReadDeviceInfo";
    const CLAUSE: ClauseId = ADS_8;

    fn result(&self) -> AdsError {
        self.result
    }
}

impl Inquiry for DeviceStateReply {
    const COMMAND: Command = Command::READ_STATE;
    const NAME: &'static str = "ReadState";
    const CLAUSE: ClauseId = ADS_9;

    fn result(&self) -> AdsError {
        self.result
    }
}

/// The reply to an inquiry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InquiryReply<R> {
    /// A success.
    Reply(R),
    /// An ADS error of the device.
    Rejected(AdsError),
    /// An error in the AMS header, for example because the router does not know the address.
    Ams(AdsError),
}

/// An inquiry and its result.
#[derive(Debug)]
pub struct Inquired<R> {
    /// The AMS port to which the request was sent.
    pub port: AmsPort,
    /// The frame sent; empty if nothing was sent.
    pub sent: Vec<u8>,
    /// The frame received, or the bytes that arrived instead.
    pub received: Vec<u8>,
    /// The reply, or why there is no valid reply.
    pub outcome: Result<InquiryReply<R>, ExchangeError>,
    /// Violations of the requirements of the headers and of the reply in the received bytes.
    pub violations: Vec<Violation>,
}

impl<R: Inquiry> Inquired<R> {
    /// The reply or the error, in a few words.
    pub fn result(&self) -> String {
        match &self.outcome {
            Ok(InquiryReply::Reply(_)) => "success".to_owned(),
            Ok(InquiryReply::Rejected(error)) => format!("ADS error {error:#x}"),
            Ok(InquiryReply::Ams(error)) => format!("AMS error {error:#x}"),
            Err(fault) => fault.to_string(),
        }
    }
}

impl<R: Inquiry> fmt::Display for Inquired<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at port {}", R::NAME, self.port)
    }
}

impl Client {
    /// Sends an inquiry. Sends nothing for example if the gate rejects it or this is a dry run.
    pub fn inquire<R: Inquiry>(&mut self, port: AmsPort) -> Inquired<R> {
        let (sent, received, violations) = (Vec::new(), Vec::new(), Vec::new());
        let mut inquired =
            Inquired { port, sent, received, outcome: Err(ExchangeError::NotSent), violations };
        inquired.outcome = self.exchange_inquiry(&mut inquired);
        tracing::debug!(
            sent = %hex::spaced(&inquired.sent),
            received = %hex::spaced(&inquired.received),
            "{inquired}: {}",
            inquired.result()
        );
        inquired
    }

    fn exchange_inquiry<R: Inquiry>(
        &mut self,
        inquired: &mut Inquired<R>,
    ) -> Result<InquiryReply<R>, ExchangeError> {
        let header = self.next_header(inquired.port, R::COMMAND);
        let bytes = super::whole(header, &[])?;
        let Inquired { sent, received, violations: broken, .. } = inquired;
        let came = self.deliver(&bytes, header, sent, received, broken)?;
        let reply = came.and_then(|got| {
            inquired.violations.extend(violations(&header, &got));
            decode_reply(&got, &inquired.received)
        });
        if let Err(fault) = &reply {
            if let ExchangeError::Malformed(error) = fault {
                // An error in the reply's stream violates the requirement of the reply; any other
                // error violates the requirement of the headers.
                let own = error.field().stream() == Some(R::STREAM);
                let requirement = if own { R::CLAUSE } else { ADS_5 };
                inquired.violations.push(Violation { requirement, what: error.to_string() });
            }
            self.disconnect();
        }
        reply
    }
}

/// Decodes the received frame.
fn decode_reply<R: Inquiry>(
    header: &AmsHeader,
    received: &[u8],
) -> Result<InquiryReply<R>, ExchangeError> {
    let data = received.get(FrameRef::HEADERS_LEN..).unwrap_or_default();
    if !header.error.is_ok() {
        return Ok(InquiryReply::Ams(header.error));
    }
    match R::decode(data) {
        Ok(reply) if reply.result().is_ok() => Ok(InquiryReply::Reply(reply)),
        Ok(reply) => Ok(InquiryReply::Rejected(reply.result())),
        // The reply may end after a result that is not 0 (ADS-6).
        Err(error) => match WriteReply::decode(data) {
            Ok(short) if !short.result.is_ok() => Ok(InquiryReply::Rejected(short.result)),
            _ => Err(ExchangeError::Malformed(error)),
        },
    }
}

impl<R: Inquiry> From<&Inquired<R>> for Evidence {
    fn from(inquired: &Inquired<R>) -> Self {
        let received = inquired.received.get(FrameRef::HEADERS_LEN..);
        let evidence = Self {
            call: inquired.to_string(),
            reply_stream: Some(R::STREAM.layout().name),
            received: received.map(|data| Self::start(data).to_vec()),
            result: inquired.result(),
            ..Self::default()
        };
        evidence.cut(&inquired.sent, &inquired.received)
    }
}
