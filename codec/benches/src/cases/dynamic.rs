//! The cases of the streams of dynamic parameters, and of the program stream.

use ads_cnc::dynamic::*;
use ads_cnc::layout::Stream;
use ads_cnc::streaming::{ProgramStream, ProgramStreamRef};
use ads_cnc::{Decode, Encode};

use super::stream::{Entry, stream};
use crate::hand::{self, HandWritten};

pub(super) const STREAMS: &[Entry] = &[
    stream!("dynamic count", DynamicCount, DynamicCount, by hand hand::Number),
    stream!("dynamic index", DynamicIndex, DynamicIndex, by hand hand::NonZero),
    stream!(
        "dynamic name", DynamicName, DynamicNameRef<'_>, by hand hand::Open<&[u8], 1, 96>,
        owned DynamicName, by hand hand::Open<Vec<u8>, 1, 96>
    ),
    stream!(
        "dynamic name request", DynamicNameRequest,
        DynamicNameRequestRef<'_>, by hand hand::Padded<&[u8], 96>,
        owned DynamicNameRequest, by hand hand::Padded<Vec<u8>, 96>
    ),
    stream!("dynamic value", DynamicValue, DynamicValue, by hand hand::Real),
    stream!(
        "program stream", ProgramStream, ProgramStreamRef<'_>, by hand hand::Bytes<&[u8], 1, 992>,
        owned ProgramStream, by hand hand::Bytes<Vec<u8>, 1, 992>
    ),
];
