//! Tests of the tables of fields: their documentation, and their consistency with the streams.

use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::Path;

use ads_cnc::layout::{FieldSpec, Layout, Size, Stream, Type};
use ads_cnc::limits::*;

use super::common::each_sample;

/// Each file in `codec/doc` equals the documentation generated from the table of its stream. The
/// documentation of the handwritten type of this stream includes the file.
#[test]
fn documentation_shows_the_tables() {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("doc");
    let write = std::env::var_os("ADS_CNC_WRITE_TABLES").is_some();
    let mut stale = Vec::new();
    for file in std::fs::read_dir(dir).unwrap() {
        let path = file.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let table = render(Stream::by_name(name).expect("a table of no stream"));
        if write {
            std::fs::write(&path, &table).unwrap();
        } else if std::fs::read_to_string(&path).ok().as_deref() != Some(&table) {
            stale.push(path);
        }
    }
    assert!(stale.is_empty(), "run with ADS_CNC_WRITE_TABLES=1 to rewrite {stale:#?}");
}

fn render(stream: Stream) -> String {
    let layout = stream.layout();
    let mut text = format!("{}; {}.\n\n", layout.title, length(layout));
    if let Some(record) = record(stream) {
        let of = record.layout().name;
        writeln!(text, "One or more records, each laid out as `{of}` ({}).", layout.clause)
            .unwrap();
        return text;
    }
    text += "| offset | size | field | type | meaning | requirement |\n|---|---|---|---|---|---|\n";
    for (place, row) in layout.fields.iter().enumerate() {
        let counter = place.checked_sub(1).map(|before| &layout.fields[before]);
        let offset = match row.per_item {
            0 => row.offset.to_string(),
            per_item => format!("{} + {per_item}{}", row.offset, letter(layout.fields)),
        };
        let offset = match counter.map(|before| before.size) {
            Some(Size::CStringPrefix { max }) => format!("{offset} … {max}"),
            _ => offset,
        };
        writeln!(
            text,
            "| {offset} | {} | `{}` | `{}` | {} | {} |",
            size(row.size, counter),
            row.name,
            row.ty,
            row.meaning,
            row.clause
        )
        .unwrap();
    }
    text
}

fn length(layout: &Layout) -> String {
    match (layout.is_fixed(), layout.max) {
        (true, 1) => "1 byte".to_owned(),
        (true, max) => format!("{max} bytes"),
        (false, max) => format!("at most {max} bytes"),
    }
}

/// For a stream of records, returns the stream that consists of one such record; otherwise `None`.
fn record(stream: Stream) -> Option<Stream> {
    let fields = stream.layout().fields;
    stream.layout().repeats.then(|| {
        let found =
            Stream::all().find(|one| !one.layout().repeats && one.layout().fields == fields);
        found.expect("the record is a stream too")
    })
}

fn size(size: Size, counter: Option<&FieldSpec>) -> String {
    match (size, counter) {
        (Size::Fixed(size) | Size::Padded(size), _) => size.to_string(),
        (Size::FixedOnSuccess(size), Some(error)) => {
            format!("{size}; the stream may end before it if `{}` is not 0", error.name)
        }
        (Size::Items { each: 1, max }, Some(counter)) => format!("`{}` ≤ {max}", counter.name),
        (Size::Items { each, max }, Some(counter)) => {
            let letter = letter(std::slice::from_ref(counter));
            format!("{each} × {letter}, {letter} ≤ {max}")
        }
        (Size::CString { max, is_optional: true }, _) => format!("≤ {max} with NUL, or 0"),
        (Size::CString { max, .. } | Size::CStringPrefix { max }, _) => format!("≤ {max} with NUL"),
        (Size::OptionalFixed(size), _) => format!("{size}; the stream may have no byte at all"),
        (Size::TextAndTail { min: 0, max } | Size::Rest { min: 0, max }, _) => format!("≤ {max}"),
        (Size::TextAndTail { min, max } | Size::Rest { min, max }, _) => format!("{min} … {max}"),
        (Size::OptionalNul { max }, _) => format!("≤ {max}, with NUL or without"),
        (Size::NonZero, _) => "4".to_owned(),
        (Size::Uns8To32, _) => "1, 2 or 4".to_owned(),
        (other, _) => panic!("how is {other:?} shown?"),
    }
}

/// The letter (m or n) that the manual uses for a count. It occurs in the meaning of the count's
/// row.
fn letter(fields: &[FieldSpec]) -> &'static str {
    let words = fields.iter().flat_map(|row| row.meaning.split(|c: char| !c.is_alphanumeric()));
    words.into_iter().find(|word| ["m", "n"].contains(word)).expect("a letter for the count")
}

/// A walk of each sample finds each field, and each item of a list, at the offset that the table
/// states.
#[test]
fn offsets_are_where_walks_find_the_fields() {
    for (stream, sample) in each_sample() {
        let bytes = sample.bytes();
        let (mut items, mut text) = (0, 0);
        stream
            .walk(&bytes, |segment| {
                let row = segment.field.spec().unwrap();
                let each = match row.size {
                    Size::Items { each, .. } => {
                        items = segment.item + 1;
                        each
                    }
                    _ => 0,
                };
                let before = text;
                // The offsets of fields after a text of variable length assume an empty text with
                // its NUL.
                if let Size::CStringPrefix { .. } = row.size {
                    text = segment.bytes.len() as u32 - 1;
                }
                let record = segment.record * DESCRIPTOR_LEN as u32;
                let counted = row.per_item * items + each * segment.item;
                let table = row.offset + counted + record + before;
                assert_eq!(segment.offset, table, "{stream} {}: {segment:?}", sample.slug);
            })
            .unwrap();
    }
}

/// In the tables, there are no gaps between fields (GEN-2).
#[test]
fn streams_are_packed() {
    for stream in Stream::all() {
        let mut end = 0;
        for row in stream.layout().fields {
            assert_eq!(row.offset, end, "{stream}: {}", row.name);
            end += match row.size {
                Size::Fixed(size) | Size::FixedOnSuccess(size) | Size::Padded(size) => size,
                Size::OptionalFixed(size) => size,
                Size::CStringPrefix { .. } => 1,
                _ => 0,
            };
        }
    }
}

/// The requirement of each field and table has the form of an ID: three letters, a hyphen and a
/// number.
#[test]
fn requirements_are_ids() {
    let is_id = |id: &str| {
        id.split_once('-').is_some_and(|(area, number)| {
            area.len() == 3
                && area.bytes().all(|byte| byte.is_ascii_uppercase())
                && !number.is_empty()
                && number.bytes().all(|byte| byte.is_ascii_digit())
        })
    };
    for layout in Stream::all().map(Stream::layout) {
        let ids = layout.fields.iter().map(|row| row.clause).chain([layout.clause]);
        ids.for_each(|id| assert!(is_id(id), "{}: {id}", layout.name));
    }
}

#[test]
fn names_are_unique() {
    let names: HashSet<_> = Stream::all().map(|stream| stream.layout().name).collect();
    assert_eq!(names.len(), Stream::all().count());
    for stream in Stream::all() {
        assert_eq!(Stream::by_name(stream.layout().name), Some(stream));
        let rows = stream.layout().fields;
        let names: HashSet<_> = rows.iter().map(|row| row.name).collect();
        assert_eq!(names.len(), rows.len(), "{stream}");
    }
}

/// The table of the write flag has the type BOOLEAN. With the type UNS08, the decoder would accept
/// the same bytes.
#[test]
fn the_write_flag_is_a_boolean() {
    assert_eq!(Stream::ElementWriteFlag.layout().fields[0].ty, Type::Boolean);
}

/// The constants of limits equal numbers that the requirements contain, or that follow from them,
/// such as `NAMELESS_DIMENSIONS_MAX`. This project assumes `ADS_DATA_MAX`.
#[test]
fn limits_are_the_numbers_of_the_clauses() {
    assert_eq!([TEXT_MAX, NAME_MAX, INDEX_KIND_MAX], [256, 255, 260]);
    assert_eq!([VARIABLE_MAX, HANDLE_VALUE_MAX, NAME_VALUE_MAX], [2048, 2040, 2047]);
    // As many dimensions or indices as fit the 2048 bytes of a stream together with its other
    // fields and, in a description by index, the shortest name (VAR-24).
    assert_eq!([DIMENSIONS_MAX, NAMELESS_DIMENSIONS_MAX, INDICES_MAX], [506, 507, 510]);
    assert_eq!([DYNAMIC_NAME_MAX, SERVICE_TEXT_MAX], [96, 128]);
    assert_eq!([DESCRIPTOR_LEN, DESCRIPTOR_TEXT_LEN], [84, 32]);
    assert_eq!([AMS_TCP_HEADER_LEN, AMS_HEADER_LEN, ADS_DATA_MAX], [6, 32, 0x40_0000]);
    assert_eq!([STREAM_PACKET_MAX, STREAM_MAX, NC_LINE_MAX], [992, 4094, 990]);
    // For the maximum lengths of these streams, no constants exist.
    for (stream, max) in [
        (Stream::ReadReply, 8 + ADS_DATA_MAX),
        (Stream::ReadWriteReply, 8 + ADS_DATA_MAX),
        (Stream::ObjectDescriptors, ADS_DATA_MAX),
        (Stream::ElementText, TEXT_MAX),
    ] {
        assert_eq!(stream.layout().max as usize, max, "{stream}");
    }
}
