//! Defects of the ADS services (mainly ADS).

use ads_cnc::ads::{AdsError, Command};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_vectors::ids::*;

use super::frame::{DATA, LENGTH, RESULT, is, measured, result, sent};
use super::{CncDefect, changed, row, set_u32};

const READS: &[Command] = &[Command::READ, Command::READ_WRITE];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.ads.read-padded", &[ADS_1],
        "the CNC pads the data of the reply to a Read with zeros to the read length",
        |cnc, call| {
            let len = usize::try_from(call.read_length).unwrap_or_default().min(0xFFF0);
            changed(cnc, call, |bytes| if call.service == AdsService::Read {
                bytes.resize(bytes.len().max(len), 0);
            })
        }),
    row("cnc.ads.read-write-padded", &[ADS_3],
        "the CNC pads the data of the reply to a ReadWrite with zeros to the read length",
        |cnc, call| {
            let len = usize::try_from(call.read_length).unwrap_or_default().min(0xFFF0);
            changed(cnc, call, |bytes| if call.service == AdsService::ReadWrite {
                bytes.resize(bytes.len().max(len), 0);
            })
        }),
    row("cnc.ads.errors-as-nothing", &[ADS_4, ADS_7],
        "the CNC answers every request that it rejects with success and no data",
        |cnc, call| cnc.answer(call).or_else(|_| Ok(Vec::new()))),
    row("cnc.ads.service-any", &[ADS_7],
        "the CNC accepts a Read or a Write in place of a ReadWrite, and a ReadWrite in place of a \
         Write",
        |cnc, call| match cnc.answer(call) {
            Err(AdsError::SERVICE_NOT_SUPPORTED) => match call.service {
                AdsService::ReadWrite => {
                    cnc.answer(&Call { service: AdsService::Write, read_length: 0, ..*call })
                }
                _ => cnc
                    .answer(&Call { service: AdsService::ReadWrite, read_length: 2048, ..*call })
                    .map(|bytes| if call.service == AdsService::Write { Vec::new() } else { bytes }),
            },
            answer => answer,
        }),
    sent("cnc.ads.read-length-16-bit", &[ADS_4],
        "the data length in the reply to a Read or ReadWrite takes 2 bytes instead of 4",
        |_, request, mut bytes| {
            if is(request, READS) && bytes.len() >= DATA {
                bytes.drain(44..46);
            }
            measured(bytes)
        }),
    sent("cnc.ads.result-16-bit", &[ADS_4],
        "the result in a reply takes 2 bytes instead of 4",
        |_, _, mut bytes| {
            if bytes.len() >= LENGTH {
                bytes.drain(40..42);
            }
            measured(bytes)
        }),
    sent("cnc.ads.result-1", &[ADS_4],
        "the result of a successful request is 1 instead of 0",
        |_, _, mut bytes| {
            if result(&bytes) == 0 {
                set_u32(&mut bytes, RESULT, 1);
            }
            bytes
        }),
    sent("cnc.ads.result-missing", &[ADS_4],
        "the CNC omits the result from every reply",
        |_, _, mut bytes| {
            if bytes.len() >= LENGTH {
                bytes.drain(RESULT..LENGTH);
            }
            measured(bytes)
        }),
    sent("cnc.ads.write-reply-length", &[ADS_2, VAR_17],
        "the reply to a Write has a data length of 0 after the result",
        |_, request, mut bytes| {
            if is(request, &[Command::WRITE]) {
                bytes.extend([0; 4]);
            }
            measured(bytes)
        }),
    sent("cnc.ads.write-reply-data", &[ADS_2, VAR_17],
        "the reply to a Write has the length and the bytes of the written data after the result",
        |_, request, mut bytes| {
            if is(request, &[Command::WRITE]) {
                bytes.extend_from_slice(request.data().get(8..).unwrap_or_default());
            }
            measured(bytes)
        }),
    sent("cnc.ads.write-reply-empty", &[ADS_2],
        "the CNC omits the result from the reply to a Write",
        |_, request, mut bytes| {
            if is(request, &[Command::WRITE]) {
                bytes.truncate(RESULT);
            }
            measured(bytes)
        }),
];
