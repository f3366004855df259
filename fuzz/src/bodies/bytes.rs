//! Bytes → decode → encode: the same bytes.

use ads_cnc::layout::Stream;
use ads_cnc::{Error, ErrorKind};

use crate::common::{self, Bend, Fault};
use crate::{Defect, Outcome};

/// The streams of a family. An input picks one by its place with its first byte: add at the end.
pub(crate) type Family = &'static [Stream];

/// The first byte picks the stream, the rest are its bytes.
///
/// Borrowed reading, owned reading and the walk by the field table agree, errors included; what
/// they accept encodes to the same bytes, as many as announced, and into no smaller buffer.
pub(crate) fn check(family: Family, data: &[u8], defect: Defect) -> Outcome {
    let Some((&pick, bytes)) = data.split_first() else { return Outcome::unread() };
    let Some(&stream) = family.get(usize::from(pick)) else { return Outcome::unread() };
    match common::check_bent(stream, bytes, &bend(defect)) {
        // They encode to themselves.
        Ok(()) => Outcome::accepted((pick, bytes)),
        Err(error) => Outcome::refused(shown(error)),
    }
}

/// The parts of an error that mean the same in every build.
pub(crate) fn shown(error: Error) -> (String, u32, u32, u32) {
    (
        format!("{:?} {}", error.kind(), error.field()),
        error.offset(),
        error.expected(),
        error.found(),
    )
}

/// The seeded defects of decoding and encoding bytes, by number.
pub(crate) const DEFECTS: &[&str] = match VARIABLE_DEFECTS {
    [of_all @ .., _of_values] => of_all,
    [] => &[],
};

/// Values are read by a type too.
pub(crate) const VARIABLE_DEFECTS: &[&str] = &[
    "the last byte loses its top bit when it is encoded",
    "an error is one byte off if it is behind the first eight bytes",
    "the length of what has eight bytes or more is announced one too long",
    "the readings differ if the last byte is odd",
    "of more than 16 bytes one of 0xB5 becomes 0xB4 when it is encoded",
    "a buffer that is too small is written into",
    "an error is of another kind",
    "an error names no field",
    "an error has found one more than there is if that is more than eight",
    "a vector has a byte too much if the last is 0",
    "a segment of more than four bytes is shown as one byte less",
    "bytes of a value behind the sixteenth lose their top bit when they are written by a type",
];

/// Those of a target that has some of them, by their numbers here; 0 is none.
pub(crate) fn bend_among(some: &[u8], defect: Defect) -> Bend {
    let number = (1..).zip(some).find(|(own, _)| defect.is(*own));
    bend(number.map_or(Defect::NONE, |(_, number)| Defect::new(*number)))
}

fn bend(defect: Defect) -> Bend {
    let mut bend = Bend::NONE;
    if defect.is(1) {
        bend.written = |bytes| {
            if let Some(last) = bytes.last_mut() {
                *last &= 0x7F;
            }
        };
    }
    if defect.is(2) {
        bend.fault = |fault| match fault.offset {
            offset @ 9.. => Fault { offset: offset - 1, ..fault },
            _ => fault,
        };
    }
    if defect.is(3) {
        bend.len = |len| len.map(|len| if len >= 8 { len + 1 } else { len });
    }
    if defect.is(4) {
        bend.same = |bytes, same| same && bytes.last().is_none_or(|last| last % 2 == 0);
    }
    if defect.is(5) {
        bend.written = |bytes| {
            let long = bytes.len() > 16;
            if let Some(byte) = bytes.iter_mut().find(|byte| long && **byte == 0xB5) {
                *byte = 0xB4;
            }
        };
    }
    if defect.is(6) {
        bend.small = |small| small.iter_mut().take(1).for_each(|first| *first = 0);
    }
    if defect.is(7) {
        bend.fault = |fault| Fault { kind: ErrorKind::Missing, ..fault };
    }
    if defect.is(8) {
        bend.fault = |fault| Fault { field: "", ..fault };
    }
    if defect.is(9) {
        bend.fault = |fault| match fault.found {
            found @ 9.. => Fault { found: found + 1, ..fault },
            _ => fault,
        };
    }
    if defect.is(10) {
        bend.vec = |vec| {
            if vec.last() == Some(&0) {
                vec.push(0);
            }
        };
    }
    if defect.is(11) {
        bend.segment = |len| if len > 4 { len - 1 } else { len };
    }
    if defect.is(12) {
        bend.typed = |bytes| bytes.iter_mut().skip(16).for_each(|byte| *byte &= 0x7F);
    }
    bend
}

/// AMS/TCP and AMS headers, requests and replies.
pub(crate) const ADS: Family = &[
    Stream::AmsTcpHeader,
    Stream::AmsHeader,
    Stream::ReadRequest,
    Stream::ReadReply,
    Stream::WriteRequest,
    Stream::WriteReply,
    Stream::ReadWriteRequest,
    Stream::ReadWriteReply,
    Stream::DeviceInfoReply,
    Stream::DeviceStateReply,
];

/// Objects: counts, descriptors, contents.
pub(crate) const COM: Family =
    &[Stream::ObjectCount, Stream::ObjectDescriptor, Stream::ObjectDescriptors, Stream::Content];

/// Variables: kinds, names, descriptions, handles, values.
pub(crate) const VARIABLE: Family = &[
    Stream::VariableKind,
    Stream::VariableCount,
    Stream::VariableIndexKind,
    Stream::VariableDescription,
    Stream::VariableName,
    Stream::VariableHandle,
    Stream::VariableHandleRead,
    Stream::VariableValue,
    Stream::VariableHandleWrite,
    Stream::VariableNameWrite,
    Stream::VariableExtendedDescription,
    Stream::VariableDescriptionByName,
];

/// Object addresses and what an element has.
pub(crate) const SDA: Family = &[
    Stream::ObjectAddressQuery,
    Stream::ObjectAddress,
    Stream::ElementCount,
    Stream::ElementText,
    Stream::ElementLength,
    Stream::ElementWriteFlag,
];

/// Dynamic parameters.
pub(crate) const DYNAMIC: Family = &[
    Stream::DynamicCount,
    Stream::DynamicIndex,
    Stream::DynamicName,
    Stream::DynamicNameRequest,
    Stream::DynamicValue,
];

/// Data streaming.
pub(crate) const STREAMING: Family = &[Stream::ProgramStream];

/// All families by name.
pub(crate) const FAMILIES: &[(&str, Family)] = &[
    ("ads", ADS),
    ("com", COM),
    ("variable", VARIABLE),
    ("sda", SDA),
    ("dynamic", DYNAMIC),
    ("streaming", STREAMING),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Every stream is fuzzed, in one family.
    #[test]
    fn families_are_the_streams() {
        for subject in common::SUBJECTS {
            let of = FAMILIES.iter().filter(|(_, family)| family.contains(&subject.stream));
            assert_eq!(of.count(), 1, "{}", subject.stream);
        }
    }
}
