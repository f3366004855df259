//! Reads the fields of a value to be encoded, by name and required type.

use std::fmt::Display;

use ads_cnc::{CncStr, TextRef};
use ads_cnc_vectors::{Fields, Tagged, Value};

use super::CodecError;

/// The fields of one record.
#[derive(Clone, Copy)]
pub(super) struct FieldReader<'f>(pub(super) &'f Fields);

pub(super) fn invalid(why: impl Display) -> CodecError {
    CodecError::InvalidFields(why.to_string())
}

impl<'f> FieldReader<'f> {
    fn field(self, name: &str) -> Result<&'f Value, CodecError> {
        self.0.get(name).ok_or_else(|| invalid(format_args!("no field {name}")))
    }

    pub(super) fn has(self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    fn one(self, name: &str) -> Result<&'f Tagged, CodecError> {
        let single = || invalid(format_args!("{name} is not a single value"));
        self.field(name)?.tagged().ok_or_else(single)
    }

    fn list(self, name: &str) -> Result<&'f [Value], CodecError> {
        self.field(name)?.list().ok_or_else(|| invalid(format_args!("{name} is not a list")))
    }

    pub(super) fn record(self, name: &str) -> Result<FieldReader<'f>, CodecError> {
        record(self.field(name)?)
    }

    pub(super) fn records(self, name: &str) -> Result<Vec<FieldReader<'f>>, CodecError> {
        self.list(name)?.iter().map(record).collect()
    }

    /// The integer in a field, which must fit the type `T`.
    pub(super) fn number<T: TryFrom<i128>>(self, name: &str) -> Result<T, CodecError> {
        integer(self.one(name)?)
    }

    pub(super) fn numbers(self, name: &str) -> Result<Vec<u32>, CodecError> {
        let number = |value: &Value| match value.tagged() {
            Some(tagged) => integer(tagged),
            None => Err(invalid(format_args!("{name} is not a list of numbers"))),
        };
        self.list(name)?.iter().map(number).collect()
    }

    pub(super) fn word(self, name: &str) -> Result<&'f str, CodecError> {
        let tagged = self.one(name)?;
        tagged.value.as_deref().ok_or_else(|| invalid(format_args!("{name} has no value")))
    }

    pub(super) fn bytes(self, name: &str) -> Result<Vec<u8>, CodecError> {
        Ok(hex(self.one(name)?)?.to_vec())
    }

    /// The text in a field, without the NUL and the bytes after it.
    pub(super) fn characters(self, name: &str) -> Result<CncStr<'f>, CodecError> {
        Ok(text(self.one(name)?)?.text())
    }
}

fn record(value: &Value) -> Result<FieldReader<'_>, CodecError> {
    match value {
        Value::Record(fields) => Ok(FieldReader(fields)),
        _ => Err(invalid("a record is expected")),
    }
}

pub(super) fn integer<T: TryFrom<i128>>(tagged: &Tagged) -> Result<T, CodecError> {
    let number = tagged.integer().ok_or_else(|| invalid("an integer is expected"))?;
    T::try_from(number).map_err(|_| invalid(format_args!("{number} is out of range")))
}

pub(super) fn bits(tagged: &Tagged) -> Result<u64, CodecError> {
    tagged.real_bits().ok_or_else(|| invalid("a float needs its bits"))
}

pub(super) fn hex(tagged: &Tagged) -> Result<&[u8], CodecError> {
    tagged.hex.as_deref().ok_or_else(|| invalid("hex is expected"))
}

pub(super) fn text(tagged: &Tagged) -> Result<TextRef<'_>, CodecError> {
    let characters = CncStr::from_bytes(hex(tagged)?)?;
    let tail = tagged.tail.as_deref().unwrap_or_default();
    Ok(TextRef::with_tail(characters, (!tagged.open).then_some(tail)))
}
