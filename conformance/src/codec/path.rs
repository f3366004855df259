//! Splits the name of a variable into its parts, and composes a name from parts.

use ads_cnc::text::CncStr;
use ads_cnc::{Kind, PathPart, TextRef, U32List, VariablePath};
use ads_cnc_vectors::{Tagged, Value};

use super::field_reader::FieldReader;
use super::{CodecError, Decoded, collect, numbers, record, text_tagged};

pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, CodecError> {
    let path = VariablePath::from_text(CncStr::from_bytes(bytes)?)?;
    let characters =
        |text: CncStr<'_>| Value::One(Tagged { open: true, ..text_tagged(TextRef::from(text)) });
    let parts = path.parts().map(|part| {
        let indices: Vec<u32> = part.indices.iter().collect();
        record(vec![("name", characters(part.name)), ("indices", numbers(&indices))])
    });
    let fields =
        vec![("kind", characters(path.kind().text())), ("parts", Value::List(parts.collect()))];
    let mut buf = [0; ads_cnc::limits::NAME_MAX];
    let again = VariablePath::write(path.kind(), path.parts(), &mut buf)?;
    Ok(Decoded { fields: collect(fields), bytes: again.text().bytes().collect() })
}

pub(super) fn encode(of: FieldReader<'_>) -> Result<Vec<u8>, CodecError> {
    let parts = of
        .records("parts")?
        .into_iter()
        .map(|part| Ok((part.characters("name")?, part.numbers("indices")?)));
    let parts = parts.collect::<Result<Vec<(CncStr<'_>, Vec<u32>)>, CodecError>>()?;
    let parts = parts.iter().map(|(name, indices)| PathPart {
        name: *name,
        indices: U32List::from(indices.as_slice()),
    });
    let kind = Kind::from_field(TextRef::from(of.characters("kind")?));
    let mut buf = [0; ads_cnc::limits::NAME_MAX];
    let path = VariablePath::write(kind, parts, &mut buf)?;
    Ok(path.text().bytes().collect())
}
