//! The laws of the targets `…_bytes`, such as: bytes that the codec decodes are encoded to the same
//! bytes.

use ads_cnc::layout::Stream;
use ads_cnc::{Decode as _, Error, ErrorKind, NoData};

use crate::common::{self, Fault, Mutation};
use crate::{Defect, Outcome};

/// The streams of a family. The first byte of an input is an index into this list, so a new stream
/// is added at the end: stored inputs keep their meaning.
pub(crate) type Family = &'static [Stream];

/// Input: an index of the stream (1 byte), then the bytes of the stream.
///
/// The borrowed reading, the owned reading and the walk by the field table agree, errors included.
/// Bytes that they accept encode to the same bytes; the encoder writes as many bytes as it
/// announced, and rejects a smaller buffer. `decode_prefix`, `BinRead` and `BinWrite` agree with
/// these readings.
pub(crate) fn check(family: Family, data: &[u8], defect: Defect) -> Outcome {
    let Some((&pick, bytes)) = data.split_first() else { return Outcome::unread() };
    let Some(&stream) = family.get(usize::from(pick)) else { return Outcome::unread() };
    match common::check_bent(stream, bytes, &mutation(defect)) {
        // Accepted bytes encode to the same bytes, so they serve as the result.
        Ok(()) => Outcome::accepted((pick, bytes)),
        Err(error) => Outcome::rejected(shown(error)),
    }
}

/// The parts of an error that do not depend on the build.
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

/// The defects for program streams: [`DEFECTS`] without the last five, which concern bytes after a stream.
/// A program stream contains all bytes up to the end of the input.
pub(crate) const STREAMING_DEFECTS: &[&str] = match DEFECTS {
    [of_all @ .., _, _, _, _, _] => of_all,
    _ => &[],
};

/// The defects for variables: the last one concerns values that are read by their type, which only
/// the target `variable_bytes` checks.
pub(crate) const VARIABLE_DEFECTS: &[&str] = &[
    "the last byte loses its top bit when it is encoded",
    "the offset of an error after the first eight bytes is off by one",
    "the announced length is one too high if it is eight or more",
    "the readings differ if the last byte is odd",
    "a byte 0xB5 is encoded as 0xB4 if there are more than 16 bytes",
    "a buffer that is too small is written into",
    "an error has a different kind",
    "an error lacks its field",
    "the number that an error found is one too high if it is more than eight",
    "a vector has an extra byte if its last byte is 0",
    "a segment of more than four bytes is shown without its last byte",
    "`decode_prefix` returns one byte less if no byte follows the stream",
    "`decode_prefix` rejects an accepted stream of more than four bytes",
    "`BinWrite` writes a wrong last byte if there are more than four",
    "`BinRead` rejects an accepted stream of more than four bytes",
    "`BinRead` accepts a rejected stream",
    "`BinRead` consumes a stream that it rejects",
    "the segments of more than eight bytes lack the last byte",
    "`decode_prefix` counts the bytes after a stream as part of the stream",
    "`decode_prefix` accepts a rejected stream without its last byte",
    "`decode_prefix` rejects a stream if bytes follow it",
    "`BinRead` and `BinWrite` lose the last byte of a stream that bytes follow",
    "`BinRead` rejects a stream if bytes follow it",
    "typed bytes of a value after the sixteenth lose their top bit when they are written",
];

/// The changed behaviour for a target that has only some of these defects: `some` has their numbers, in the
/// order of the target's own defects. 0 stands for a defect that the target implements itself.
pub(crate) fn bend_among(some: &[u8], defect: Defect) -> Mutation {
    let number = (1..).zip(some).find(|(own, _)| defect.is(*own));
    mutation(number.map_or(Defect::NONE, |(_, number)| Defect::new(*number)))
}

fn mutation(defect: Defect) -> Mutation {
    let mut mutation = Mutation::NONE;
    if defect.is(1) {
        mutation.written = |bytes| {
            if let Some(last) = bytes.last_mut() {
                *last &= 0x7F;
            }
        };
    }
    if defect.is(2) {
        mutation.fault = |fault| match fault.offset {
            offset @ 9.. => Fault { offset: offset - 1, ..fault },
            _ => fault,
        };
    }
    if defect.is(3) {
        mutation.len = |len| len.map(|len| if len >= 8 { len + 1 } else { len });
    }
    if defect.is(4) {
        mutation.same = |bytes, same| same && bytes.last().is_none_or(|last| last % 2 == 0);
    }
    if defect.is(5) {
        mutation.written = |bytes| {
            let long = bytes.len() > 16;
            if let Some(byte) = bytes.iter_mut().find(|byte| long && **byte == 0xB5) {
                *byte = 0xB4;
            }
        };
    }
    if defect.is(6) {
        mutation.small = |small| small.iter_mut().take(1).for_each(|first| *first = 0);
    }
    if defect.is(7) {
        mutation.fault = |fault| Fault { kind: ErrorKind::Missing, ..fault };
    }
    if defect.is(8) {
        mutation.fault = |fault| Fault { field: "", ..fault };
    }
    if defect.is(9) {
        mutation.fault = |fault| match fault.found {
            found @ 9.. => Fault { found: found + 1, ..fault },
            _ => fault,
        };
    }
    if defect.is(10) {
        mutation.vec = |vec| {
            if vec.last() == Some(&0) {
                vec.push(0);
            }
        };
    }
    if defect.is(11) {
        mutation.segment = |len| if len > 4 { len - 1 } else { len };
    }
    if defect.is(12) {
        mutation.prefix = |bytes, prefix| {
            prefix.map(|len| if len == bytes.len() { len.saturating_sub(1) } else { len })
        };
    }
    if defect.is(13) {
        mutation.prefix = |bytes, prefix| match prefix {
            Ok(len) if len == bytes.len() && len > 4 => rejected(),
            _ => prefix,
        };
    }
    if defect.is(18) {
        mutation.joined = |bytes| bytes.truncate(bytes.len().saturating_sub(1).max(8));
    }
    if defect.is(19) {
        mutation.prefix = |bytes, prefix| prefix.map(|_| bytes.len());
    }
    if defect.is(20) {
        mutation.prefix = |bytes, prefix| prefix.or(Ok(bytes.len().saturating_sub(1)));
    }
    if defect.is(21) {
        mutation.prefix = |bytes, prefix| match prefix {
            Ok(len) if len < bytes.len() => rejected(),
            _ => prefix,
        };
    }
    #[cfg(feature = "binrw")]
    bend_binrw(&mut mutation, defect);
    if defect.is(24) {
        mutation.typed = |bytes| bytes.iter_mut().skip(16).for_each(|byte| *byte &= 0x7F);
    }
    mutation
}

/// The error with which a defect replaces a result.
fn rejected() -> Result<usize, Error> {
    NoData::decode(&[0]).map(|_| 0)
}

/// Adds the behaviour of a defect of `BinRead` or `BinWrite`.
#[cfg(feature = "binrw")]
fn bend_binrw(mutation: &mut Mutation, defect: Defect) {
    if defect.is(14) {
        mutation.binrw = |_, (mut written, read)| {
            if let Some([_, _, _, _, .., last]) = written.as_deref_mut() {
                *last ^= 1;
            }
            (written, read)
        };
    }
    if defect.is(15) {
        mutation.binrw = |bytes, (written, read)| {
            if read == bytes.len() && read > 4 { (None, 0) } else { (written, read) }
        };
    }
    if defect.is(16) {
        mutation.binrw = |bytes, (written, read)| match written {
            None => (Some(bytes.to_vec()), bytes.len()),
            _ => (written, read),
        };
    }
    if defect.is(17) {
        mutation.binrw = |bytes, (written, read)| {
            let read = if written.is_none() { bytes.len() } else { read };
            (written, read)
        };
    }
    if defect.is(22) {
        mutation.binrw = |bytes, (mut written, read)| {
            let follows = read < bytes.len();
            let last = written.as_mut().filter(|_| follows).and_then(Vec::pop);
            (written, read - usize::from(last.is_some()))
        };
    }
    if defect.is(23) {
        mutation.binrw = |bytes, (written, read)| {
            if read < bytes.len() { (None, 0) } else { (written, read) }
        };
    }
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

/// Object addresses and the attributes of elements.
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

    /// Every stream belongs to exactly one family.
    #[test]
    fn every_stream_is_in_one_family() {
        for subject in common::SUBJECTS {
            let of = FAMILIES.iter().filter(|(_, family)| family.contains(&subject.stream));
            assert_eq!(of.count(), 1, "{}", subject.stream);
        }
    }
}
