//! Checks the headers of a received frame, and the lengths in its reply.

use ads_cnc::ads::{AmsHeader, FrameRef};
use ads_cnc::operation::AdsService;
use ads_cnc_vectors::ids::*;

use super::Client;
use crate::ads_service::{clause, decode_reply, reply_stream};
use crate::exchange::{Exchange, ExchangeError, Violation, violations};
use crate::text::plural;

/// Whether the payload would be a valid reply if its result had 0 or 2 bytes, or its length field 2
/// bytes.
fn is_narrow(service: AdsService, payload: &[u8]) -> bool {
    let missing: [(usize, &[u8]); 3] = [(0, &[0; 4]), (0, &[0; 2]), (6, &[0; 2])];
    missing.into_iter().any(|(at, zeros)| {
        let Some((before, after)) = payload.split_at_checked(at) else { return false };
        decode_reply(service, &[before, zeros, after].concat()).is_ok()
    })
}

impl Client {
    /// Adds the violations in the received frame to the exchange. Without a valid reply, also
    /// closes the connection.
    pub(super) fn judge(&mut self, asked: &AmsHeader, exchange: &mut Exchange) {
        let mut broken = Vec::new();
        match &exchange.outcome {
            Ok((answer, header)) => {
                broken.extend(violations(asked, header));
                let mut add = |requirement, what: String| {
                    broken.push(Violation { requirement, what });
                };
                let given = answer.data.as_ref().map_or(0, Vec::len);
                let read = exchange.read_length;
                if usize::try_from(read).is_ok_and(|read| given > read) {
                    add(
                        clause(exchange.service),
                        format!("{} of data for a read length of {read}", plural(given, "byte")),
                    );
                }
                if exchange.contradicts_itself() {
                    let error = answer.ams_error;
                    add(ADS_5, format!("AMS error {error:#x} with the reply of a success"));
                }
            }
            Err(fault) => {
                let mut add = |requirement, what: String| {
                    broken.push(Violation { requirement, what });
                };
                if let ExchangeError::Malformed(error) = fault {
                    if error.field().stream() == Some(reply_stream(exchange.service)) {
                        add(clause(exchange.service), error.to_string());
                        let payload = exchange.received.get(FrameRef::HEADERS_LEN..);
                        if payload.is_some_and(|payload| is_narrow(exchange.service, payload)) {
                            add(ADS_4, error.to_string());
                        }
                    } else {
                        add(ADS_5, error.to_string());
                    }
                    if exchange.received.len() == FrameRef::HEADERS_LEN {
                        add(ADS_5, "no data, and no error in the AMS header".to_owned());
                    }
                }
                // Without a valid reply, the start of the next frame may be unknown.
                self.disconnect();
            }
        }
        exchange.violations.append(&mut broken);
    }
}
