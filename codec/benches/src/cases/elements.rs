//! The cases of the streams of objects and elements of the SDA task.

use ads_cnc::layout::Stream;
use ads_cnc::sda::*;
use ads_cnc::{Decode, Encode};

use super::stream::{Entry, stream};
use crate::hand::{self, HandWritten};

pub(super) const STREAMS: &[Entry] = &[
    stream!("object address query", ObjectAddressQuery, ObjectAddressQuery, by hand hand::Pair),
    stream!("object address", ObjectAddress, ObjectAddress, by hand hand::Pair),
    stream!("element count", ElementCount, ElementCount, by hand hand::Number),
    stream!(
        "element text", ElementText, ElementTextRef<'_>, by hand hand::Open<&[u8], 0, 256>,
        owned ElementText, by hand hand::Open<Vec<u8>, 0, 256>
    ),
    stream!("element length", ElementLength, ElementLength, by hand hand::Length),
    stream!("element write flag", ElementWriteFlag, ElementWriteFlag, by hand hand::Flag),
];
