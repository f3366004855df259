//! Creates golden vectors from captured traffic. The network addresses of the machines and, by
//! default, the letters of texts are replaced, except in texts that the manual defines.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use ads_cnc::Encode as _;
use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef};
use ads_cnc::layout::{Segment as Piece, Size, Stream, Type as FieldType};
use ads_cnc::operation::{AdsService, Call, Function, Request};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{
    Accept, AdsService as VectorService, Context, Direction, Expect, Hex, Provenance,
    ProvenanceKind, Segment, Type, VERSION, Vector, requirement,
};
use serde_json::json;

use super::tally::count;
use crate::ads_service;
use crate::client::frame;
use crate::codec::decode_stream;
use crate::number::{digest, digest_more, to_usize};
use crate::rules::TargetVariable;
use crate::text::json as json_text;

/// Maximum number of vectors of a capture.
pub const VECTORS_MAX: usize = 10_000;
/// Maximum number of bytes in all vectors of a capture: a decoded vector needs up to 60 bytes of
/// memory for each of its bytes.
pub const VECTOR_BYTES_MAX: usize = 0x40_0000;

/// The AMS address of the client, and the AMS NetId of the CNC, in every collected frame.
const CLIENT: AmsAddr = AmsAddr { net_id: AmsNetId([192, 0, 2, 20, 1, 1]), port: AmsPort(0x8001) };
const CNC: AmsNetId = AmsNetId([192, 0, 2, 10, 1, 1]);

/// The vectors collected so far.
#[derive(Debug, Default)]
pub struct Collector {
    keep_texts: bool,
    vectors: BTreeMap<String, Vector>,
    /// Number of bytes in the vectors.
    bytes: usize,
    /// Number of streams and frames, repetitions included, that were omitted because of
    /// [`VECTORS_MAX`] or [`VECTOR_BYTES_MAX`].
    omitted: u64,
}

impl Collector {
    /// Creates a collector. With `keep_texts`, it keeps captured texts and NC programs. Otherwise,
    /// it omits NC programs and replaces the letters of texts, except kinds and type names.
    pub fn new(keep_texts: bool) -> Self {
        Self { keep_texts, ..Self::default() }
    }

    pub fn len(&self) -> usize {
        self.vectors.len()
    }

    pub fn is_empty(&self) -> bool {
        self.vectors.is_empty()
    }

    /// Number of streams and frames, repetitions included, that exceeded the maximum number of
    /// vectors or of their bytes.
    pub const fn omitted(&self) -> u64 {
        self.omitted
    }

    /// Adds vectors of the data of a request, of the data of its reply, and of both frames. `reply`
    /// is the data of a successful reply; `None` for an error reply, which gives no vector.
    pub(super) fn add(
        &mut self,
        request: &Request<'_>,
        call: &Call<'_>,
        reply: Option<&[u8]>,
        known: Option<&TargetVariable>,
    ) {
        let function = request.function();
        // NC programs may be confidential, so they are collected only together with texts.
        if function == Function::WriteProgramStream && !self.keep_texts {
            return;
        }
        let spec = function.spec();
        let kept = self.keep_texts || function == Function::ReadElementType;
        let context = Context {
            service: Some(match call.service {
                AdsService::Read => VectorService::Read,
                AdsService::Write => VectorService::Write,
                AdsService::ReadWrite => VectorService::ReadWrite,
            }),
            index_group: Some(call.index_group.get()),
            index_offset: Some(call.index_offset.get()),
            ..typed(known)
        };
        let is_text = context.kind == Some(Type::String);
        let scrubbed = |stream: Option<Stream>, data: &[u8]| match (kept, stream) {
            (false, Some(stream)) => scrub(stream, data, is_text),
            _ => data.to_vec(),
        };
        let sent = scrubbed(spec.request, call.data);
        let asked = spec.request.and_then(|stream| {
            self.stream(stream, Direction::Request, context.clone(), &sent, spec.clause)
        });
        let received = reply.map(|data| scrubbed(spec.reply, data));
        if let (Some(stream), Some(received)) = (spec.reply, &received) {
            let context = Context { request: asked, ..context };
            self.stream(stream, Direction::Reply, context, received, spec.clause);
        }
        self.frames(&Call { data: &sent, ..*call }, received.as_deref());
    }

    /// Adds the frame of the request, and that of a successful reply, encoded again with other
    /// addresses.
    fn frames(&mut self, call: &Call<'_>, received: Option<&[u8]>) {
        let cnc = AmsAddr { net_id: CNC, port: call.port };
        let header = AmsHeader::request(cnc, CLIENT, call.service.command(), 1);
        let Ok(asked) = frame(header, call) else { return };
        self.frame(Direction::Request, call.service, &asked);
        if received.is_none() {
            return;
        }
        let reply = ads_service::encode_reply(call.service, AdsError::NO_ERROR, received);
        let Ok(reply) = reply else { return };
        let frame =
            FrameRef::new(header.response(), &reply).and_then(|frame| frame.encode_to_vec());
        if let Ok(bytes) = frame {
            self.frame(Direction::Reply, call.service, &bytes);
        }
    }

    fn frame(&mut self, way: Direction, service: AdsService, bytes: &[u8]) {
        let mut segments = Vec::new();
        let (tcp, rest) = bytes.split_at(bytes.len().min(6));
        let (ams, data) = rest.split_at(rest.len().min(32));
        let inside = match way {
            Direction::Request => ads_service::request_stream(service),
            _ => ads_service::reply_stream(service),
        };
        for (stream, bytes) in
            [(Stream::AmsTcpHeader, tcp), (Stream::AmsHeader, ams), (inside, data)]
        {
            let prefix = format!("{}.", stream.layout().name.replace('-', "_"));
            segments.extend(self::segments(stream, bytes, &prefix));
        }
        self.record(
            "ams-frame",
            way,
            Context::default(),
            bytes,
            segments,
            &[ADS_5.as_str(), ads_service::clause(service).as_str()],
        );
    }

    /// Adds a stream and returns the ID of its vector; `None` if the stream does not decode or has
    /// no fields, or if the collector is full.
    fn stream(
        &mut self,
        stream: Stream,
        way: Direction,
        context: Context,
        bytes: &[u8],
        clause: &'static str,
    ) -> Option<String> {
        let layout = stream.layout();
        let segments = segments(stream, bytes, "");
        self.record(layout.name, way, context, bytes, segments, &[clause, layout.clause])
    }

    fn record(
        &mut self,
        stream: &str,
        direction: Direction,
        mut context: Context,
        bytes: &[u8],
        segments: Vec<Segment>,
        clauses: &[&'static str],
    ) -> Option<String> {
        let values = ["variable-value", "variable-handle-write", "variable-name-write", "content"];
        if !values.contains(&stream) {
            (context.kind, context.dimensions) = (None, None);
        }
        let decoded = decode_stream(stream, &context, bytes).ok()?;
        let mut clauses: Vec<&str> = clauses.to_vec();
        clauses.retain(|id| requirement(id).is_some());
        clauses.dedup();
        let known = serde_json::to_string(&context).unwrap_or_default();
        let way = if direction == Direction::Request { "request" } else { "reply" };
        let hash = hash([stream.as_bytes(), known.as_bytes(), way.as_bytes(), bytes]);
        let id = format!("captured-{stream}-{hash:016x}");
        if self.vectors.contains_key(&id) {
            return Some(id);
        }
        if clauses.is_empty() || segments.is_empty() {
            return None;
        }
        let length = self.bytes.saturating_add(bytes.len());
        if self.vectors.len() >= VECTORS_MAX || length > VECTOR_BYTES_MAX {
            count(&mut self.omitted);
            return None;
        }
        self.bytes = length;
        let canonical = (decoded.bytes != bytes).then_some(Hex(decoded.bytes));
        let vector = Vector {
            id: id.clone(),
            title: format!("Captured {way}: {}", stream.replace('-', " ")),
            requirements: clauses.iter().map(ToString::to_string).collect(),
            errata: Vec::new(),
            editions: Vec::new(),
            stream: stream.to_owned(),
            direction,
            context,
            segments,
            expect: Expect::Accept(Accept { value: decoded.fields, canonical }),
            sibling: None,
            provenance: Provenance {
                kind: ProvenanceKind::Derived,
                reason: Some(self.reason().to_owned()),
                sources: Vec::new(),
            },
            assumed: Vec::new(),
        };
        self.vectors.insert(id.clone(), vector);
        Some(id)
    }

    const fn reason(&self) -> &'static str {
        if self.keep_texts {
            "captured traffic, addresses replaced"
        } else {
            "captured traffic, addresses and letters of texts replaced"
        }
    }

    /// Writes the vectors to a new file, or to one new file for each stream in an existing folder.
    /// No file is overwritten; without vectors, no file is written.
    ///
    /// # Errors
    /// An error of the system, or [`io::ErrorKind::AlreadyExists`].
    pub fn write(&self, place: &Path) -> io::Result<Vec<PathBuf>> {
        let mut files: BTreeMap<PathBuf, Vec<&Vector>> = BTreeMap::new();
        for vector in self.vectors.values() {
            let file = if place.is_dir() {
                place.join(format!("captured-{}.json", vector.stream))
            } else {
                place.to_owned()
            };
            files.entry(file).or_default().push(vector);
        }
        let named = |file: &Path, error: io::Error| {
            io::Error::new(error.kind(), format!("{}: {error}", file.display()))
        };
        // Check this before writing any file.
        if let Some(there) = files.keys().find(|file| file.exists()) {
            return Err(named(there, io::ErrorKind::AlreadyExists.into()));
        }
        for (file, vectors) in &files {
            let document = json!({
                "$schema": "vectors.schema.json",
                "version": VERSION,
                "vectors": vectors,
            });
            let out = File::create_new(file).map_err(|error| named(file, error))?;
            let mut out = BufWriter::new(out);
            let written = json_text::write(&document, &mut out);
            written.and_then(|()| out.flush()).map_err(|error| named(file, error))?;
        }
        Ok(files.into_keys().collect())
    }
}

/// The context with the type and dimensions of the read or written value, if they are known.
fn typed(known: Option<&TargetVariable>) -> Context {
    let Some(known) = known else { return Context::default() };
    let name = known.description.var_type.name();
    let kind = name.and_then(|name| serde_json::from_value(json!(name)).ok());
    let dimensions =
        if known.indices.is_empty() { known.description.dimensions.clone() } else { Vec::new() };
    let dimensions = kind.map(|_: Type| dimensions);
    Context { kind, dimensions, ..Context::default() }
}

/// The fields of a stream as segments of a vector.
fn segments(stream: Stream, bytes: &[u8], prefix: &str) -> Vec<Segment> {
    let mut all = Vec::new();
    let repeats = stream.layout().repeats;
    // The walk ends at an error, but invalid streams are not collected.
    let _walked = stream.walk(bytes, |piece| {
        let several = piece
            .field
            .spec()
            .is_some_and(|spec| matches!(spec.size, Size::Items { each, .. } if each > 1));
        let name = piece.field.name();
        let field = match (repeats, several) {
            (true, _) => format!("{prefix}descriptors[{}].{name}", piece.record),
            (_, true) => format!("{prefix}{name}[{}]", piece.item),
            _ => format!("{prefix}{name}"),
        };
        all.push(Segment { field, hex: Hex(piece.bytes.to_vec()), value: None });
    });
    all
}

/// Replaces the letters of the texts in a stream, except in kinds and type names, which the manual
/// defines.
fn scrub(stream: Stream, bytes: &[u8], is_text: bool) -> Vec<u8> {
    let mut scrubbed = bytes.to_vec();
    let mut places = Vec::new();
    let _walked = stream.walk(bytes, |piece: Piece<'_>| {
        let Some(spec) = piece.field.spec() else { return };
        let is_private = match spec.ty {
            FieldType::String => !matches!(spec.name, "kind" | "type"),
            FieldType::Bytes => is_text && spec.name == "value",
            _ => false,
        };
        if is_private {
            let start = to_usize(piece.offset);
            places.push((start, start.saturating_add(piece.bytes.len()), spec.name == "name"));
        }
    });
    for (start, end, is_name) in places {
        let Some(text) = scrubbed.get_mut(start..end) else { continue };
        // The name of a variable begins with `V.` and its kind, which the manual defines.
        let kind = is_name && text.get(..2) == Some(b"V.");
        let skip = if kind { text.iter().skip(2).position(|byte| *byte == b'.') } else { None };
        let skip = skip.map_or(0, |at| at.saturating_add(2));
        for byte in text.iter_mut().skip(skip) {
            *byte = match *byte {
                b'A'..=b'Z' => b'X',
                b'a'..=b'z' => b'x',
                0x80.. => 0xE4,
                other => other,
            };
        }
    }
    scrubbed
}

/// A hash function that gives a vector the same ID on every machine.
fn hash<const N: usize>(parts: [&[u8]; N]) -> u64 {
    parts.iter().fold(digest(b""), |hash, part| digest_more(digest_more(hash, part), &[0xFF]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bytes_of_all_vectors_are_limited() {
        let mut collector = Collector::new(true);
        let mut bytes = vec![0; VECTOR_BYTES_MAX / 2];
        for number in [0, 1, 2, 1] {
            bytes[0] = number;
            let (way, context) = (Direction::Reply, Context::default());
            collector.stream(Stream::Content, way, context, &bytes, COM_5.as_str());
        }
        assert_eq!((collector.len(), collector.omitted()), (2, 1));
    }
}
