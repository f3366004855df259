//! Defects of the ADS services (ADS).

use ads_cnc::ads::{AdsError, Command};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_vectors::ids::*;

use super::frame::{DATA, LENGTH, RESULT, is, measured, result, sent};
use super::{CncDefect, row, set_u32};

const READS: &[Command] = &[Command::READ, Command::READ_WRITE];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.ads.read-padded", &[ADS_1], "the data of a Read is padded with zeros to the length asked for",
        |cnc, call| {
            let len = usize::try_from(call.read_length).unwrap_or_default().min(0xFFF0);
            cnc.answer(call).map(|mut bytes| {
                if call.service == AdsService::Read {
                    bytes.resize(bytes.len().max(len), 0);
                }
                bytes
            })
        }),
    row("cnc.ads.read-write-padded", &[ADS_3],
        "the data of a ReadWrite is padded with zeros to the read length",
        |cnc, call| {
            let len = usize::try_from(call.read_length).unwrap_or_default().min(0xFFF0);
            cnc.answer(call).map(|mut bytes| {
                if call.service == AdsService::ReadWrite {
                    bytes.resize(bytes.len().max(len), 0);
                }
                bytes
            })
        }),
    row("cnc.ads.errors-as-nothing", &[ADS_4, ADS_7], "errors are answered as success without data",
        |cnc, call| cnc.answer(call).or_else(|_| Ok(Vec::new()))),
    row("cnc.ads.service-any", &[ADS_7], "a Write is taken for a ReadWrite and the other way round",
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
    sent("cnc.ads.read-length-16-bit", &[ADS_4], "the length in a reply takes 2 bytes",
        |_, request, mut bytes| {
            if is(request, READS) && bytes.len() >= DATA {
                bytes.drain(44..46);
            }
            measured(bytes)
        }),
    sent("cnc.ads.result-16-bit", &[ADS_4], "the result takes 2 bytes", |_, _, mut bytes| {
        if bytes.len() >= LENGTH {
            bytes.drain(40..42);
        }
        measured(bytes)
    }),
    sent("cnc.ads.result-1", &[ADS_4], "the result of success is 1", |_, _, mut bytes| {
        if result(&bytes) == 0 {
            set_u32(&mut bytes, RESULT, 1);
        }
        bytes
    }),
    sent("cnc.ads.result-missing", &[ADS_4], "a reply has no result", |_, _, mut bytes| {
        if bytes.len() >= LENGTH {
            bytes.drain(RESULT..LENGTH);
        }
        measured(bytes)
    }),
    sent("cnc.ads.write-reply-length", &[ADS_2, VAR_17],
        "the reply to a Write has a length, 0, after the result",
        |_, request, mut bytes| {
            if is(request, &[Command::WRITE]) {
                bytes.extend([0; 4]);
            }
            measured(bytes)
        }),
    sent("cnc.ads.write-reply-data", &[ADS_2, VAR_17],
        "the reply to a Write has the data that was written",
        |_, request, mut bytes| {
            if is(request, &[Command::WRITE]) {
                bytes.extend_from_slice(request.data().get(8..).unwrap_or_default());
            }
            measured(bytes)
        }),
    sent("cnc.ads.write-reply-empty", &[ADS_2], "the reply to a Write has no result",
        |_, request, mut bytes| {
            if is(request, &[Command::WRITE]) {
                bytes.truncate(RESULT);
            }
            measured(bytes)
        }),
];
