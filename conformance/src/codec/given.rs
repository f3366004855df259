//! Fields of a value that is to be encoded, under their names and of the types they need.

use std::fmt::Display;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::value::{DataType, EncodeValue as _};
use ads_cnc::{CncStr, Elements, Text, TextRef, U32List};
use ads_cnc_vectors::{Context, Fields, Tagged, Type, Value};

use super::Refused;

/// The fields of one record.
#[derive(Clone, Copy)]
pub(super) struct Given<'f>(pub(super) &'f Fields);

fn unfit(why: impl Display) -> Refused {
    Refused::Unfit(why.to_string())
}

impl<'f> Given<'f> {
    fn field(self, name: &str) -> Result<&'f Value, Refused> {
        self.0.get(name).ok_or_else(|| unfit(format_args!("no field {name}")))
    }

    pub(super) fn has(self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    fn one(self, name: &str) -> Result<&'f Tagged, Refused> {
        let single = || unfit(format_args!("{name} is no single value"));
        self.field(name)?.tagged().ok_or_else(single)
    }

    fn list(self, name: &str) -> Result<&'f [Value], Refused> {
        self.field(name)?.list().ok_or_else(|| unfit(format_args!("{name} is no list")))
    }

    pub(super) fn record(self, name: &str) -> Result<Given<'f>, Refused> {
        record(self.field(name)?)
    }

    pub(super) fn records(self, name: &str) -> Result<Vec<Given<'f>>, Refused> {
        self.list(name)?.iter().map(record).collect()
    }

    /// A whole number that its type has room for.
    pub(super) fn number<T: TryFrom<i128>>(self, name: &str) -> Result<T, Refused> {
        integer(self.one(name)?)
    }

    /// Which type a number is given as.
    pub(super) fn kind(self, name: &str) -> Result<Type, Refused> {
        Ok(self.one(name)?.kind)
    }

    pub(super) fn numbers(self, name: &str) -> Result<Vec<u32>, Refused> {
        let number = |value: &Value| match value.tagged() {
            Some(tagged) => integer(tagged),
            None => Err(unfit(format_args!("{name} is no list of numbers"))),
        };
        self.list(name)?.iter().map(number).collect()
    }

    pub(super) fn bits(self, name: &str) -> Result<u64, Refused> {
        bits(self.one(name)?)
    }

    pub(super) fn word(self, name: &str) -> Result<&'f str, Refused> {
        let tagged = self.one(name)?;
        tagged.value.as_deref().ok_or_else(|| unfit(format_args!("{name} has no value")))
    }

    pub(super) fn bytes(self, name: &str) -> Result<Vec<u8>, Refused> {
        Ok(hex(self.one(name)?)?.to_vec())
    }

    pub(super) fn text(self, name: &str) -> Result<Text, Refused> {
        Ok(Text::from(text(self.one(name)?)?))
    }

    /// All bytes of a text in a field of fixed size.
    pub(super) fn fixed<const N: usize>(self, name: &str) -> Result<[u8; N], Refused> {
        let text = text(self.one(name)?)?;
        let mut bytes: Vec<u8> = text.text().bytes().collect();
        if let Some(tail) = text.tail() {
            bytes.push(0);
            bytes.extend(tail);
        }
        let all = bytes.len();
        let over = |_| unfit(format_args!("{name} has {all} bytes, more than its {N}"));
        bytes.resize(all.max(N), 0);
        <[u8; N]>::try_from(bytes).map_err(over)
    }

    /// Characters alone: a text without its end.
    pub(super) fn characters(self, name: &str) -> Result<CncStr<'f>, Refused> {
        Ok(text(self.one(name)?)?.text())
    }

    pub(super) fn place(self) -> Result<(IndexGroup, IndexOffset), Refused> {
        let group = IndexGroup::new(self.number("index_group")?);
        Ok((group, IndexOffset::new(self.number("index_offset")?)))
    }

    /// The bytes of a value: as many elements of the context's type as its dimensions say.
    pub(super) fn elements(self, name: &str, context: &Context) -> Result<Vec<u8>, Refused> {
        let lacks = |what: &str| Refused::Unsupported(format!("a value without {what}"));
        let kind = context.kind.ok_or_else(|| lacks("a type"))?;
        let dimensions = context.dimensions.as_deref().ok_or_else(|| lacks("dimensions"))?;
        let Some(data_type) = DataType::by_name(CncStr::new(kind.name())?) else {
            return Err(Refused::Unsupported(format!("values of type {kind:?}")));
        };
        let given = self.list(name)?;
        let items = given.iter().map(|value| match value.tagged() {
            Some(tagged) if tagged.kind == kind => Ok(tagged),
            _ => Err(unfit(format_args!("{name} has an element that is no {}", kind.name()))),
        });
        let items: Vec<&Tagged> = items.collect::<Result<_, _>>()?;
        let count = dimensions.iter().try_fold(1_usize, |count, &len| {
            count.checked_mul(usize::try_from(len).unwrap_or(usize::MAX))
        });
        if count != Some(items.len()) {
            let dimensions = U32List::from(dimensions);
            return Err(unfit(format_args!("{} elements for {dimensions:?}", items.len())));
        }
        encode(data_type, &items)
    }
}

/// The elements in their order, as the codec writes them.
fn encode(data_type: DataType, items: &[&Tagged]) -> Result<Vec<u8>, Refused> {
    let element = |one: &Tagged| {
        Ok(match data_type {
            DataType::Boolean => integer::<u8>(one)?.value_to_vec()?,
            DataType::Sgn08 => integer::<i8>(one)?.value_to_vec()?,
            DataType::Uns08 => integer::<u8>(one)?.value_to_vec()?,
            DataType::Sgn16 => integer::<i16>(one)?.value_to_vec()?,
            DataType::Uns16 => integer::<u16>(one)?.value_to_vec()?,
            DataType::Sgn32 => integer::<i32>(one)?.value_to_vec()?,
            DataType::Uns32 => integer::<u32>(one)?.value_to_vec()?,
            DataType::Lint => integer::<i64>(one)?.value_to_vec()?,
            DataType::Lword => integer::<u64>(one)?.value_to_vec()?,
            DataType::Real64 => f64::from_bits(bits(one)?).value_to_vec()?,
            DataType::Real32 => {
                let bits = u32::try_from(bits(one)?).map_err(|_| unfit("more than 32 bits"))?;
                f32::from_bits(bits).value_to_vec()?
            }
            DataType::String => text(one)?.value_to_vec()?,
            other => return Err(Refused::Unsupported(format!("values of type {other:?}"))),
        })
    };
    let each = items.iter().map(|one| element(one)).collect::<Result<Vec<_>, _>>()?;
    let bytes = each.concat();
    if data_type == DataType::String && items.len() != 1 {
        if each.windows(2).any(|two| two.first().map(Vec::len) != two.last().map(Vec::len)) {
            return Err(unfit("texts of an array have the same room each"));
        }
        let count = [u32::try_from(items.len()).unwrap_or(u32::MAX)];
        Elements::new(data_type, U32List::from(&count), &bytes)?;
    }
    Ok(bytes)
}

fn record(value: &Value) -> Result<Given<'_>, Refused> {
    match value {
        Value::Record(fields) => Ok(Given(fields)),
        _ => Err(unfit("no record where one has to be")),
    }
}

fn integer<T: TryFrom<i128>>(tagged: &Tagged) -> Result<T, Refused> {
    let number = tagged.integer().ok_or_else(|| unfit("no whole number where one has to be"))?;
    T::try_from(number).map_err(|_| unfit(format_args!("{number} is out of range")))
}

fn bits(tagged: &Tagged) -> Result<u64, Refused> {
    tagged.real_bits().ok_or_else(|| unfit("a float without its bits"))
}

fn hex(tagged: &Tagged) -> Result<&[u8], Refused> {
    tagged.hex.as_deref().ok_or_else(|| unfit("no hex where there has to be some"))
}

fn text(tagged: &Tagged) -> Result<TextRef<'_>, Refused> {
    let characters = CncStr::from_bytes(hex(tagged)?)?;
    let tail = tagged.tail.as_deref().unwrap_or_default();
    Ok(TextRef::with_tail(characters, (!tagged.open).then_some(tail)))
}
