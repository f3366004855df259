//! The codec accepts, rejects and dispatches the same inputs as version 0.1.0, with the same bytes.
//! The errors are the same, with one exception: if the name of a write by name has no NUL, the
//! error counts only the bytes searched for it.
//!
//! `outcomes.tsv` has rows for vectors of streams, vectors of frames, samples of calls, index
//! groups, and replies to samples of calls. A row has a digest of the inputs made of the vector,
//! sample or group, and a digest of their outcomes. When the file was created, its rows were
//! computed with version 0.1.0 (commit 8993f4c, before streams and functions were declared by
//! macros) and with the sources of version 0.2.0, and all of them were equal. Since then, the
//! exception has changed five rows of vectors `name-write-…`.
//!
//! A new vector or sample adds rows and changes no existing row. Compare the new rows with version
//! 0.1.0: check out 8993f4c, and copy `spec-vectors`, this file and `common/calls.rs` into it.
//! Rename `DispatchError` to `Refusal`, the fields of `DispatchError::Service` to `takes` and
//! `asked`, the type `AdsService` to `Service`, and `subject().name()` to `stream()`. Run the test
//! there and here with `ADS_CNC_WRITE_OUTCOMES=1`, and compare the two files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsPort, FrameRef};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Call, DispatchError};
use ads_cnc::{Encode as _, Error};
use ads_cnc_vectors::{Vector, vectors};

use super::common::{CALLS, CallSample, Fault, Subject};

/// The number of mutated inputs made of each vector and of the data of each sample.
const MUTATIONS: usize = 48;

/// A digest of 64 bits, computed like the hash FNV-1a.
struct Digest(u64);

impl Digest {
    const EMPTY: Self = Self(0xCBF2_9CE4_8422_2325);
    const PRIME: u64 = 0x100_0000_01B3;

    fn add(&mut self, bytes: &[u8]) {
        // The length is added too; otherwise a byte that moves from one input to the next would
        // change nothing.
        self.0 = (self.0 ^ bytes.len() as u64).wrapping_mul(Self::PRIME);
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(Self::PRIME);
        }
    }

    /// The digest reduced to 32 bits, so that a row is short.
    fn short(&self) -> u32 {
        (self.0 ^ (self.0 >> 32)) as u32
    }
}

/// The random number generator SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
}

/// The computed rows by kind and by name. The name is that of the vector, sample or index group
/// from which the inputs are made. A reply that is a vector has the names of the sample and of the
/// vector.
type Rows = BTreeMap<(&'static str, String), Row>;

/// The number of inputs, their digest, the number of accepted inputs, and the digest of the
/// outcomes.
struct Row {
    inputs: u32,
    given: Digest,
    accepted: u32,
    outcomes: Digest,
}

impl Row {
    const EMPTY: Self =
        Self { inputs: 0, given: Digest::EMPTY, accepted: 0, outcomes: Digest::EMPTY };

    /// Adds an input and its outcome.
    fn add(&mut self, input: &[u8], outcome: Outcome) {
        self.inputs += 1;
        self.given.add(input);
        self.accepted += u32::from(outcome.is_ok());
        match outcome {
            Ok(bytes) => self.outcomes.add(&bytes),
            Err(error) => self.outcomes.add(error.as_bytes()),
        }
    }

    fn text(&self) -> String {
        let Self { inputs, given, accepted, outcomes } = self;
        format!("{inputs} {:08x}\t{accepted} {:08x}", given.short(), outcomes.short())
    }
}

/// The outcome of an input: bytes, such as those that the decoded value encodes to, or the error.
type Outcome = Result<Vec<u8>, String>;

fn shown(error: Error) -> String {
    let Fault { kind, field, offset, expected, found } = Fault::of(error);
    format!("{kind:?} {} {field} {offset} {expected} {found}", error.field().subject().name())
}

/// The inputs made of these bytes: the bytes unchanged, truncated, extended and mutated. The seed
/// of the mutations is derived from the bytes, so that a new vector does not change the inputs made
/// of other vectors.
fn inputs(bytes: &[u8]) -> Vec<Vec<u8>> {
    let len = bytes.len();
    // A long stream is truncated at some lengths only, to save time.
    let cuts = (0..=len).filter(|cut| len <= 300 || *cut < 40 || len - cut < 8 || cut % 101 == 0);
    let mut all: Vec<_> = cuts.map(|cut| bytes[..cut].to_vec()).collect();
    for end in [0, 0xFF].map(|byte| [byte; 3]) {
        all.extend((1..=3).map(|count| [bytes, &end[..count]].concat()));
    }
    let mut seed = Digest::EMPTY;
    seed.add(bytes);
    let mut random = Random(seed.0);
    for _ in 0..MUTATIONS {
        let mut mutated = bytes.to_vec();
        for _ in 0..=random.below(3) {
            mutate(&mut mutated, &mut random);
        }
        all.push(mutated);
    }
    all
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    let (at, byte) = (random.below(bytes.len() + 1), random.next() as u8);
    // Numbers at the limits of counts and lengths, and close to them.
    let number = random.pick(&[0, 1, 2, 255, 256, 257, 506, 507, 510, 511, 0x4000_0001, u32::MAX]);
    let kind = random.below(5);
    if kind == 0 {
        bytes.insert(at, byte);
    } else if let Some(tail) = bytes.get_mut(at..).filter(|tail| !tail.is_empty()) {
        match kind {
            1 => drop(bytes.remove(at)),
            2 => tail[0] = byte,
            3 => tail[0] ^= 1 << (byte % 8),
            // Write the number at a multiple of four, because many counts and lengths are there.
            _ => {
                let rest = bytes.iter_mut().skip(at / 4 * 4);
                rest.zip(number.to_le_bytes()).for_each(|(byte, new)| *byte = new);
            }
        }
    }
}

fn vectors_of(stream: &str) -> impl Iterator<Item = &'static Vector> {
    vectors().iter().filter(move |vector| vector.stream == stream)
}

/// The outcome of decoding an input as a stream. Checks that the owned type has the same outcome as
/// the borrowed type.
fn decoded(stream: Stream, input: &[u8]) -> Outcome {
    let mut outcomes = Subject::of(stream).readings().map(|reading| {
        let mut buf = vec![0; input.len() + 8];
        let len = (reading.encode)(input, &mut buf).map_err(shown)?;
        buf.truncate(len);
        Ok(buf)
    });
    let outcome = outcomes.next().expect("a view");
    assert!(outcomes.all(|other| other == outcome), "{stream}: {input:x?}");
    outcome
}

fn streams(rows: &mut Rows) {
    for stream in Stream::all() {
        for vector in vectors_of(stream.layout().name) {
            let row = rows.entry(("stream", vector.id.clone())).or_insert(Row::EMPTY);
            for input in inputs(&vector.bytes()) {
                row.add(&input, decoded(stream, &input));
            }
        }
    }
}

/// Adds the rows of frames. The outcome of an input is its first frame, empty bytes if the frame is
/// not complete, or the error.
fn frames(rows: &mut Rows) {
    for vector in vectors_of("ams-frame") {
        let row = rows.entry(("frame", vector.id.clone())).or_insert(Row::EMPTY);
        for input in inputs(&vector.bytes()) {
            let split = FrameRef::split(&input, 0x1000).map_err(shown);
            let outcome = split.map(|frame| frame.map_or(vec![], |(_, len)| input[..len].to_vec()));
            row.add(&input, outcome);
        }
    }
}

/// All fields of a call, as bytes.
fn call_bytes(call: &Call<'_>) -> Vec<u8> {
    let numbers = [call.index_group.get(), call.index_offset.get(), call.read_length];
    let mut bytes = call.port.0.to_le_bytes().to_vec();
    bytes.extend(call.service.command().0.to_le_bytes());
    bytes.extend(numbers.into_iter().flat_map(u32::to_le_bytes));
    bytes.extend(call.data);
    bytes
}

/// The outcome of a call: the function and the call that the request encodes to, or the error.
fn dispatched(call: &Call<'_>) -> Outcome {
    let request = call.dispatch().map_err(|error| match error {
        DispatchError::Port(port) => format!("Port {}", port.0),
        DispatchError::Group(group) => format!("Group {}", group.get()),
        DispatchError::Offset(offset) => format!("Offset {}", offset.get()),
        DispatchError::Service { expected, found } => format!("Service {expected:?} {found:?}"),
        DispatchError::Stream(error) => format!("Stream {}", shown(error)),
        other => panic!("{other}"),
    })?;
    let mut buf = vec![0; request.encoded_len()];
    let again = call_bytes(&request.encode(&mut buf).map_err(shown)?);
    Ok([request.function().spec().name.as_bytes(), &again].concat())
}

/// Adds the rows of addresses: calls with the index groups of all samples and with similar groups,
/// at the offsets 0 to 0xFF, at offsets that contain an axis, and at large offsets.
fn addresses(rows: &mut Rows) {
    let groups: BTreeSet<u32> = CALLS
        .iter()
        .map(|sample| sample.call.index_group.get())
        .flat_map(|at| [at, at ^ 1, at ^ 0x100, at ^ 0x1_0000, at ^ 0x10_0000])
        .collect();
    let of_axes =
        [1, 2, 0xFFFF_u32].into_iter().flat_map(|axis| (0..9).map(move |at| axis << 16 | at));
    let offsets: Vec<u32> = (0..0x100).chain(of_axes).chain([0xFFFF, 1 << 31, u32::MAX]).collect();
    let data = [&b""[..], b"\x01\0\0\0", b"\x01\0\0\0\0\0\0\0", b"V.E\0", b"\x01\0\0\0V.E\0"];
    for group in groups {
        let row = rows.entry(("address", format!("{group:#08x}"))).or_insert(Row::EMPTY);
        let mut random = Random(u64::from(group));
        for &offset in &offsets {
            for port in [AmsPort::SDA, AmsPort::COM, AmsPort(random.pick(&[550, 551, 554]))] {
                for service in [AdsService::Read, AdsService::Write, AdsService::ReadWrite] {
                    let has_data = service != AdsService::Read || random.below(8) == 0;
                    let call = Call {
                        port,
                        service,
                        index_group: IndexGroup::new(group),
                        index_offset: IndexOffset::new(offset),
                        read_length: random.pick(&[0, 4, 83, 84, 168, 2048, u32::MAX]),
                        data: if has_data { random.pick(&data) } else { b"" },
                    };
                    row.add(&call_bytes(&call), dispatched(&call));
                }
            }
        }
    }
}

/// Adds the rows of data: each sample of a call with its data unchanged, truncated, extended and
/// mutated.
fn data(rows: &mut Rows) {
    for sample in CALLS {
        let row = rows.entry(("data", sample.slug.to_owned())).or_insert(Row::EMPTY);
        for data in inputs(sample.call.data) {
            let call = Call { data: &data, ..sample.call };
            row.add(&call_bytes(&call), dispatched(&call));
        }
    }
}

/// Adds the rows of replies. Each sample of a call has a row for an empty reply and a reply of one
/// byte 0. A vector of the reply's stream only has a row if the outcomes of request and stream
/// differ, because the reply is longer than the request permits.
fn replies(rows: &mut Rows) {
    for CallSample { slug, call, .. } in CALLS {
        // Skip a sample that is rejected: the rows of data show its rejection.
        let Ok(request) = call.dispatch() else { continue };
        let reply = |input: &[u8]| {
            let reply = request.decode_reply(input).map_err(shown)?;
            Ok(reply.encode(&mut vec![0; input.len()]).map_err(shown)?.to_vec())
        };
        let row = rows.entry(("reply", (*slug).to_owned())).or_insert(Row::EMPTY);
        for input in [&[][..], &[0]] {
            row.add(input, reply(input));
        }
        let Some(stream) = request.function().spec().reply else { continue };
        for vector in vectors_of(stream.layout().name) {
            let (bytes, key) = (vector.bytes(), ("reply", format!("{slug}, {}", vector.id)));
            let outcome = reply(&bytes);
            if outcome != decoded(stream, &bytes) {
                rows.entry(key).or_insert(Row::EMPTY).add(&bytes, outcome);
            }
        }
    }
}

/// Parses the rows of a table. The keys are the first two columns, kind and name.
fn parsed(table: &str) -> BTreeMap<(&str, &str), Vec<&str>> {
    let rows = table.lines().skip(1).map(|line| line.split('\t').collect::<Vec<_>>());
    rows.map(|row| ((row[0], row[1]), row[2..].to_vec())).collect()
}

/// Describes each row that differs between the computed table and the file.
fn differences(table: &str, kept: &str) -> Vec<String> {
    let (rows, kept) = (parsed(table), parsed(kept));
    let keys: BTreeSet<_> = rows.keys().chain(kept.keys()).collect();
    let difference = |key| match (rows.get(key), kept.get(key)) {
        (Some(row), Some(other)) if row == other => None,
        (Some(row), Some(other)) if row[0] == other[0] => Some("other outcomes of the same inputs"),
        (Some(_), Some(_)) => Some("other inputs"),
        (Some(_), None) => Some("new"),
        (None, _) => Some("no longer computed"),
    };
    let differences = keys.into_iter().filter_map(|key| Some((key, difference(key)?)));
    differences.map(|((kind, name), how)| format!("{kind} {name}: {how}")).collect()
}

#[test]
#[cfg_attr(miri, ignore = "too many inputs for an interpreter")]
fn outcomes_are_those_of_0_1_0() {
    let mut rows = Rows::new();
    for compute in [streams, frames, addresses, data, replies] {
        compute(&mut rows);
    }
    let mut table = "kind\tname\tinputs, digest\taccepted, digest of outcomes\n".to_owned();
    for ((kind, name), row) in &rows {
        table += &format!("{kind}\t{name}\t{}\n", row.text());
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/outcomes.tsv");
    if std::env::var_os("ADS_CNC_WRITE_OUTCOMES").is_some() {
        std::fs::write(&path, &table).unwrap();
    }
    let kept = std::fs::read_to_string(path).unwrap();
    assert!(
        table == kept,
        "changed: {:#?}\n\
         Outcomes of the same inputs are part of the interface: a change belongs in CHANGELOG.md. Of new \
         rows, compare the outcomes with those of version 0.1.0, as the head of this file says. \
         ADS_CNC_WRITE_OUTCOMES=1 rewrites codec/tests/outcomes.tsv.",
        differences(&table, &kept)
    );
}
