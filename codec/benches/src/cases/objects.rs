//! The cases of the streams of objects of the COM task, and of content.

use ads_cnc::layout::Stream;
use ads_cnc::{
    Content, ContentRef, Decode, Descriptor, DescriptorRef, Descriptors, DescriptorsRef, Encode,
    ObjectCount,
};

use super::stream::{Entry, stream};
use crate::hand::{self, HandWritten};

const MAX: usize = 0x40_0000;

pub(super) const STREAMS: &[Entry] = &[
    stream!("object count", ObjectCount, ObjectCount, by hand hand::Number),
    stream!(
        "descriptor", ObjectDescriptor, DescriptorRef<'_>, by hand hand::Descriptor,
        owned Descriptor, by hand hand::Descriptor
    ),
    stream!(
        "two descriptors", ObjectDescriptors, DescriptorsRef<'_>, by hand hand::Descriptors,
        owned Descriptors, by hand hand::Descriptors
    ),
    stream!(
        "content", Content, ContentRef<'_>, by hand hand::Bytes<&[u8], 0, MAX>,
        owned Content, by hand hand::Bytes<Vec<u8>, 0, MAX>
    ),
];
