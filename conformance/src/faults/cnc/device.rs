//! Device information and state (ADS).

use ads_cnc::ads::{AmsPort, Command};
use ads_cnc_vectors::ids::*;

use super::CncSeed;
use super::frame::{DATA, LENGTH, RESULT, is, measured, sent, set};

const INFO: &[Command] = &[Command::READ_DEVICE_INFO];
const STATE: &[Command] = &[Command::READ_STATE];

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    sent("cnc.ads.info-refused", &[ADS_8], "ReadDeviceInfo is refused",
        |_, request, bytes| if is(request, INFO) {
            measured(set(bytes, RESULT, &[1, 7, 0, 0]).into_iter().take(LENGTH).collect())
        } else {
            bytes
        }),
    sent("cnc.ads.info-name-15", &[ADS_8], "the name in ReadDeviceInfo takes 15 bytes",
        |_, request, mut bytes| {
            if is(request, INFO) {
                bytes.pop();
            }
            measured(bytes)
        }),
    sent("cnc.ads.info-version-wide", &[ADS_8], "the version numbers in ReadDeviceInfo are UNS16 each",
        |_, request, mut bytes| {
            if is(request, INFO) && bytes.len() > DATA {
                bytes.splice(43..43, [0]);
                bytes.splice(45..45, [0]);
            }
            measured(bytes)
        }),
    sent("cnc.ads.info-com-only", &[ADS_8], "ReadDeviceInfo is refused at 551 and 552",
        |_, request, bytes| if is(request, INFO) && request.header().target.port != AmsPort::COM {
            measured(set(bytes, RESULT, &[1, 7, 0, 0]).into_iter().take(LENGTH).collect())
        } else {
            bytes
        }),
    sent("cnc.ads.state-swapped", &[ADS_9], "ReadState has the device state before the ADS state",
        |_, request, mut bytes| {
            if is(request, STATE)
                && let Some(states) = bytes.get_mut(LENGTH..)
            {
                states.reverse();
            }
            bytes
        }),
    sent("cnc.ads.state-wide", &[ADS_9], "the states in ReadState are UNS32", |_, request, mut bytes| {
        if is(request, STATE) && bytes.len() == DATA {
            bytes.splice(44..44, [0; 2]);
            bytes.extend([0; 2]);
        }
        measured(bytes)
    }),
    sent("cnc.ads.state-refused", &[ADS_9], "ReadState is refused",
        |_, request, bytes| if is(request, STATE) {
            measured(set(bytes, RESULT, &[1, 7, 0, 0]).into_iter().take(LENGTH).collect())
        } else {
            bytes
        }),
    sent("cnc.ads.state-com-only", &[ADS_9], "ReadState is refused at 551 and 552",
        |_, request, bytes| if is(request, STATE) && request.header().target.port != AmsPort::COM {
            measured(set(bytes, RESULT, &[1, 7, 0, 0]).into_iter().take(LENGTH).collect())
        } else {
            bytes
        }),
];
