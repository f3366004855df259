//! Bodies of the fuzz targets, and the replay of their corpora without a fuzzer.
//!
//! The laws are those of the codec's own tests, which feed them samples, cuts and random values.

#[path = "../../codec/tests/common/mod.rs"]
mod common;

use std::path::Path;

use ads_cnc::Encode as _;
use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsPort, FrameRef};
use ads_cnc::operation::{Call, Service};

/// A target's body.
pub type Body = fn(&[u8]);

/// Every target by name, which is that of its binary and of its directory in `corpus`.
pub const TARGETS: [(&str, Body); 2] = [("streams", streams), ("dispatch", dispatch)];

/// Bytes of a stream, which the first byte picks by its place in the list of streams.
///
/// View, owned reading and walk agree, errors included; what they accept encodes to the same
/// bytes, as many as announced, and into no smaller buffer. `0xFF` picks the splitting of frames.
pub fn streams(data: &[u8]) {
    is_stream(data);
}

/// A call: port (2 bytes), service (1), group, offset and read length (4 each), data.
///
/// Dispatch refuses it, or finds a request that encodes to the same call and is dispatched to
/// itself.
pub fn dispatch(data: &[u8]) {
    is_call(data);
}

/// The laws of [`streams`]; whether the bytes were accepted.
fn is_stream(data: &[u8]) -> bool {
    match data.split_first() {
        Some((&FRAMES, bytes)) => is_frame(bytes),
        Some((&pick, bytes)) => common::SUBJECTS
            .get(usize::from(pick))
            .is_some_and(|subject| common::check(subject.stream, bytes).is_ok()),
        None => false,
    }
}

const FRAMES: u8 = 0xFF;

/// A frame encodes to the bytes it was split from, and was not whole before its last byte.
fn is_frame(bytes: &[u8]) -> bool {
    let Ok(Some((frame, len))) = FrameRef::split(bytes, FRAME_DATA_MAX) else { return false };
    assert_eq!(frame.to_vec().as_deref(), Ok(&bytes[..len]));
    assert_eq!(FrameRef::split(&bytes[..len - 1], FRAME_DATA_MAX), Ok(None));
    true
}

const FRAME_DATA_MAX: u32 = 1024;

/// The laws of [`dispatch`]; whether the call was accepted.
fn is_call(data: &[u8]) -> bool {
    call(data).is_some_and(|call| common::check_call(&call).is_ok())
}

fn call(bytes: &[u8]) -> Option<Call<'_>> {
    let (&port, bytes) = bytes.split_first_chunk()?;
    let (&service, bytes) = bytes.split_first()?;
    let (&group, bytes) = bytes.split_first_chunk()?;
    let (&offset, bytes) = bytes.split_first_chunk()?;
    let (&read_length, data) = bytes.split_first_chunk()?;
    let service = *SERVICES.get(usize::from(service))?;
    Some(Call {
        port: AmsPort(u16::from_le_bytes(port)),
        service,
        index_group: IndexGroup::new(u32::from_le_bytes(group)),
        index_offset: IndexOffset::new(u32::from_le_bytes(offset)),
        read_length: u32::from_le_bytes(read_length),
        // A Read carries none.
        data: if service == Service::Read { &[] } else { data },
    })
}

const SERVICES: [Service; 3] = [Service::Read, Service::Write, Service::ReadWrite];

/// Name and bytes of the inputs that a target starts from, made of the codec's samples.
pub fn seeds(target: &str) -> Vec<(String, Vec<u8>)> {
    match target {
        "streams" => stream_seeds().chain([frame_seed()]).collect(),
        "dispatch" => common::CALLS.iter().map(call_seed).collect(),
        other => panic!("no target {other}"),
    }
}

fn stream_seeds() -> impl Iterator<Item = (String, Vec<u8>)> {
    (0..).zip(common::SUBJECTS).flat_map(|(pick, subject)| {
        let of_stream = |(stream, _): &(_, _)| *stream == subject.stream;
        common::each_sample().filter(of_stream).map(move |(stream, sample)| {
            (format!("{stream}-{}", sample.slug), [vec![pick], sample.bytes()].concat())
        })
    })
}

/// A Read as it comes over TCP: the samples of its two headers and of its request.
fn frame_seed() -> (String, Vec<u8>) {
    let parts = ["ams-tcp-header", "ams-header", "read-request"].map(|name| {
        let mut samples = common::each_sample().filter(|(stream, _)| stream.layout().name == name);
        samples.next().map(|(_, sample)| sample.bytes()).unwrap_or_default()
    });
    ("frame-read".into(), [vec![FRAMES], parts.concat()].concat())
}

fn call_seed(sample: &common::CallSample) -> (String, Vec<u8>) {
    let call = &sample.call;
    let service = SERVICES.iter().position(|&service| service == call.service);
    let mut bytes = call.port.0.to_le_bytes().to_vec();
    bytes.extend(service.and_then(|place| u8::try_from(place).ok()));
    for number in [call.index_group.get(), call.index_offset.get(), call.read_length] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(call.data);
    (sample.slug.into(), bytes)
}

/// Runs `body` on every file of `corpus` and says how many there were.
pub fn replay(corpus: &Path, body: Body) -> usize {
    let entries =
        std::fs::read_dir(corpus).unwrap_or_else(|error| panic!("{}: {error}", corpus.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("readable").path()).collect();
    paths.sort();
    for path in &paths {
        let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        // The test harness shows this only if the body panics.
        println!("{}", path.display());
        body(&bytes);
    }
    paths.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seeds are valid inputs, so that a fuzzer starts behind the checks and not before them.
    #[test]
    fn seeds_are_accepted() {
        for (name, bytes) in seeds("streams") {
            assert!(is_stream(&bytes), "{name}");
        }
        for (name, bytes) in seeds("dispatch") {
            assert!(is_call(&bytes), "{name}");
        }
    }
}
