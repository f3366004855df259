//! Parses values.

use std::str::FromStr;

use ads_cnc::value::{Boolean, DataType, EncodeValue as _, Scalar, Shape};
use ads_cnc::{CncStr, U32List};

use super::Type;
use crate::number::{to_u32, to_usize};
use crate::text::plural;

/// The error for a text that is not a value of its type.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct InvalidValue(String);

/// Parses a value: an integer in decimal or, after 0x, in hexadecimal; a REAL in decimal; `TRUE`,
/// `FALSE`, `1` or `0` for a BOOLEAN; or a text. The elements of an array of numbers or BOOLEANs
/// are separated by commas or blanks, optionally in brackets; with commas, the brackets may be
/// nested as in JSON. The elements of an array of texts are separated by commas. A text must be
/// quoted if it contains a comma, starts with a quote, or starts or ends with a blank; quotes in it
/// are then doubled. The last index of an array changes fastest.
///
/// A single text is taken literally. It is encoded with one NUL, and may be shorter than its
/// variable.
///
/// # Errors
/// The reason why the text is not a value of the type, and the expected form.
pub fn parse(ty: &Type, text: &str) -> Result<Vec<u8>, InvalidValue> {
    let Some(data_type) = ty.data_type else {
        let name = if ty.name.is_empty() { "its type" } else { ty.name.as_str() };
        return Err(InvalidValue(format!("{name} is unknown; specify it with --type")));
    };
    match data_type {
        DataType::Boolean => items(ty, text, boolean),
        DataType::Sgn08 => items(ty, text, |text| integer(text, i8::MIN, i8::MAX, data_type)),
        DataType::Uns08 => items(ty, text, |text| integer(text, u8::MIN, u8::MAX, data_type)),
        DataType::Sgn16 => items(ty, text, |text| integer(text, i16::MIN, i16::MAX, data_type)),
        DataType::Uns16 => items(ty, text, |text| integer(text, u16::MIN, u16::MAX, data_type)),
        DataType::Sgn32 => items(ty, text, |text| integer(text, i32::MIN, i32::MAX, data_type)),
        DataType::Uns32 => items(ty, text, |text| integer(text, u32::MIN, u32::MAX, data_type)),
        DataType::Lint => items(ty, text, |text| integer(text, i64::MIN, i64::MAX, data_type)),
        DataType::Lword => items(ty, text, |text| integer(text, u64::MIN, u64::MAX, data_type)),
        DataType::Real32 => items(ty, text, |text| {
            let number: f32 = real(text, data_type)?;
            within(number.is_finite(), number, text, (f32::MIN, f32::MAX), data_type)
        }),
        DataType::Real64 => items(ty, text, |text| {
            let number: f64 = real(text, data_type)?;
            within(number.is_finite(), number, text, (f64::MIN, f64::MAX), data_type)
        }),
        DataType::String => texts(ty, text),
        other => Err(InvalidValue(format!("values of type {other:?} cannot be written"))),
    }
}

fn boolean(text: &str) -> Result<Boolean, InvalidValue> {
    match text.to_ascii_uppercase().as_str() {
        "TRUE" | "1" => Ok(Boolean::TRUE),
        "FALSE" | "0" => Ok(Boolean::FALSE),
        _ => Err(InvalidValue(format!(
            "{text} is not of type BOOLEAN, which has the values TRUE, FALSE, 1 and 0"
        ))),
    }
}

fn integer<T>(text: &str, least: T, most: T, ty: DataType) -> Result<T, InvalidValue>
where
    T: TryFrom<i128> + Into<i128> + Copy,
{
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1_i128, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    let hex = digits.strip_prefix("0x").or_else(|| digits.strip_prefix("0X"));
    let (digits, radix) = hex.map_or((digits, 10), |digits| (digits, 16));
    let is_number = !digits.is_empty() && digits.chars().all(|digit| digit.is_digit(radix));
    let name = ty.name();
    if !is_number {
        return Err(InvalidValue(format!("{text} is not of type {name}, which is a whole number")));
    }
    // A number with too many digits is out of range.
    let number = i128::from_str_radix(digits, radix).unwrap_or(i128::MAX).checked_mul(sign);
    number.and_then(|number| T::try_from(number).ok()).ok_or_else(|| {
        let (least, most) = (least.into(), most.into());
        InvalidValue(format!("{text} is not of type {name}, whose range is {least} to {most}"))
    })
}

fn real<T: FromStr + Default + PartialEq>(text: &str, ty: DataType) -> Result<T, InvalidValue> {
    let no = || {
        InvalidValue(format!(
            "{text} is not of type {}, which is a number such as -1.5e3",
            ty.name()
        ))
    };
    // Words such as "inf" are rejected: an axis must not be sent to infinity.
    let in_digits = text.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
    let number = if in_digits { text.parse().map_err(|_| no())? } else { return Err(no()) };
    let digits = text.split(['e', 'E']).next().unwrap_or(text);
    let is_nothing = number == T::default() && digits.contains(|c: char| ('1'..='9').contains(&c));
    if is_nothing {
        Err(InvalidValue(format!("{text} is not of type {}, which would round it to 0", ty.name())))
    } else {
        Ok(number)
    }
}

fn within<T: std::fmt::Debug>(
    is_within: bool,
    number: T,
    text: &str,
    (least, most): (T, T),
    ty: DataType,
) -> Result<T, InvalidValue> {
    if is_within {
        Ok(number)
    } else {
        Err(InvalidValue(format!(
            "{text} is not of type {}, whose range is {least:?} to {most:?}",
            ty.name()
        )))
    }
}

/// Checks the number of elements, and returns the dimensions of the value. If the dimensions and
/// the size of the type are unknown, any number is accepted.
fn counted(ty: &Type, given: usize) -> Result<Vec<u32>, InvalidValue> {
    let count = to_u32(given);
    if ty.size.is_none() && ty.dimensions.is_empty() {
        return Ok(if count == 1 { Vec::new() } else { vec![count] });
    }
    let needed = ty.dimensions.iter().fold(1_u32, |count, &len| count.saturating_mul(len));
    if needed == count {
        Ok(ty.dimensions.clone())
    } else if needed == 1 {
        let is_real = matches!(ty.data_type, Some(DataType::Real32 | DataType::Real64));
        let hint = if is_real && count == 2 { "; the decimal separator is a point" } else { "" };
        Err(InvalidValue(format!("{ty} is a single element, but {count} are given{hint}")))
    } else {
        let verb = if count == 1 { "is" } else { "are" };
        Err(InvalidValue(format!(
            "{ty} has {}, but {count} {verb} given",
            plural(needed, "element")
        )))
    }
}

fn items<T: Scalar>(
    ty: &Type,
    text: &str,
    one: impl Fn(&str) -> Result<T, InvalidValue>,
) -> Result<Vec<u8>, InvalidValue> {
    // Arrays are also accepted in brackets, and with only blanks between the elements.
    let text = text.trim();
    let flat = flat(ty, text)?;
    let text = flat.as_deref().unwrap_or(text);
    let inner = text.strip_prefix('[').and_then(|text| text.strip_suffix(']')).unwrap_or(text);
    let items: Vec<&str> = if inner.contains(',') {
        inner.split(',').map(str::trim).collect()
    } else {
        inner.split_whitespace().collect()
    };
    let items = if items.is_empty() { vec![inner] } else { items };
    let items: Vec<T> = items.into_iter().map(one).collect::<Result<_, _>>()?;
    counted(ty, items.len())?;
    items.as_slice().value_to_vec().map_err(|error| InvalidValue(error.to_string()))
}

/// The elements of a text that starts with `[[`, without the brackets; `None` for any other text.
/// As in JSON, the text must have brackets for each dimension of the array.
fn flat(ty: &Type, text: &str) -> Result<Option<String>, InvalidValue> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    if !text.starts_with("[[") {
        return Ok(None);
    }
    // The number of elements of a row, of a plane and so on, each of which starts and ends with a
    // bracket.
    let rows = ty.dimensions.iter().rev().scan(1_usize, |size, &len| {
        *size = size.saturating_mul(to_usize(len));
        Some(*size)
    });
    let rows: Vec<usize> = rows.collect();
    let brackets =
        |at: usize| rows.iter().filter(|&&row| at.checked_rem(row).unwrap_or(at) == 0).count();
    let mut items = Vec::new();
    for (at, item) in text.split(',').enumerate() {
        let value = item.trim_matches(['[', ']']);
        let opened = item.chars().take_while(|c| *c == '[').count();
        let closed = item.chars().rev().take_while(|c| *c == ']').count();
        if value.is_empty() || opened != brackets(at) || closed != brackets(at.saturating_add(1)) {
            return Err(InvalidValue(format!("the brackets do not match the dimensions of {ty}")));
        }
        items.push(value.to_owned());
    }
    Ok(Some(items.join(",")))
}

fn texts(ty: &Type, given: &str) -> Result<Vec<u8>, InvalidValue> {
    let all = if ty.dimensions.is_empty() { vec![given.to_owned()] } else { split(given)? };
    let dimensions = counted(ty, all.len())?;
    let encoded = |text| {
        let foreign = |error| InvalidValue(format!("{text:?} is not of type STRING: {error}"));
        CncStr::new(text).map_err(foreign)
    };
    let texts: Vec<CncStr<'_>> =
        all.iter().map(|text| encoded(text.as_str())).collect::<Result<_, _>>()?;
    let longest = texts.iter().map(CncStr::len).max().unwrap_or(0).saturating_add(1);
    let longest = to_u32(longest);
    let count = to_u32(texts.len()).max(1);
    let size = ty.size.unwrap_or(longest.saturating_mul(count));
    let each = size.checked_div(count).unwrap_or(0);
    if longest > each {
        let (most, given) = (each.saturating_sub(1), longest.saturating_sub(1));
        return Err(InvalidValue(format!(
            "a STRING of {} has at most {} and its NUL, but {given} are given",
            plural(each, "byte"),
            plural(most, "character")
        )));
    }
    let shape = Shape::new(DataType::String, U32List::from(dimensions.as_slice()), size);
    let mut room = vec![0; to_usize(size)];
    let done = shape.and_then(|shape| shape.encode_texts(&texts, &mut room).map(<[u8]>::to_vec));
    done.map_err(|error| InvalidValue(error.to_string()))
}

/// Splits a list of texts at the commas that are outside quotes.
fn split(given: &str) -> Result<Vec<String>, InvalidValue> {
    let (mut all, mut rest) = (Vec::new(), given);
    loop {
        let (text, after) = match rest.trim_start().strip_prefix('"') {
            Some(quoted) => quoted_text(quoted)?,
            None => match rest.split_once(',') {
                Some((text, after)) => (text.trim().to_owned(), Some(after)),
                None => (rest.trim().to_owned(), None),
            },
        };
        all.push(text);
        match after {
            Some(after) => rest = after,
            None => return Ok(all),
        }
    }
}

/// Parses a quoted text; `given` starts after the opening quote. Also returns the rest after the
/// comma that follows the closing quote; `None` if nothing follows.
fn quoted_text(given: &str) -> Result<(String, Option<&str>), InvalidValue> {
    let (mut text, mut rest) = (String::new(), given);
    loop {
        let open = || InvalidValue("a quoted text has no closing quote".to_owned());
        let (before, after) = rest.split_once('"').ok_or_else(open)?;
        text.push_str(before);
        if let Some(more) = after.strip_prefix('"') {
            text.push('"');
            rest = more;
            continue;
        }
        let after = after.trim_start();
        return match after.strip_prefix(',') {
            Some(after) => Ok((text, Some(after))),
            None if after.is_empty() => Ok((text, None)),
            None => {
                Err(InvalidValue(format!("expected a comma after the closing quote, not {after}")))
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::super::plain;
    use super::*;

    fn single(ty: DataType) -> Type {
        Type::known(ty, Vec::new())
    }

    #[test]
    fn numbers_are_decimal_or_hex() {
        let cases: [(DataType, &str, &[u8]); 9] = [
            (DataType::Sgn08, "-128", &[0x80]),
            (DataType::Uns08, "0xfF", &[0xFF]),
            (DataType::Uns16, "0x12", &[0x12, 0]),
            (DataType::Sgn32, "-0x1", &[0xFF; 4]),
            (DataType::Lword, "18446744073709551615", &[0xFF; 8]),
            (DataType::Lint, "-9223372036854775808", &[0, 0, 0, 0, 0, 0, 0, 0x80]),
            (DataType::Real32, "1.5", &[0, 0, 0xC0, 0x3F]),
            (DataType::Real64, "-2", &[0, 0, 0, 0, 0, 0, 0, 0xC0]),
            (DataType::Boolean, "true", &[1]),
        ];
        for (ty, text, bytes) in cases {
            assert_eq!(parse(&single(ty), text).unwrap(), bytes, "{text}");
        }
    }

    /// Nested brackets as in JSON must match the dimensions: with another nesting, elements would
    /// be written to wrong positions.
    #[test]
    fn nested_brackets_match_the_dimensions() {
        let cube = Type::known(DataType::Uns08, vec![2, 2, 2]);
        let parsed = |text: &str| parse(&cube, text);
        assert_eq!(parsed("[[[1,2],[3, 4]],[[5,6], [7,8]]]").unwrap(), [1, 2, 3, 4, 5, 6, 7, 8]);
        for text in [
            "[[1,2],[3,4],[5,6],[7,8]]",
            "[[[1,2,3],[4]],[[5,6],[7,8]]]",
            "[[[1,2],[3,4]],[[5,6],[7,8]]",
            "[[[1,2],[3,4]]]",
            "[[]]",
            "[[",
        ] {
            assert!(parsed(text).is_err(), "{text}");
        }
        assert!(parse(&single(DataType::Uns08), "[[1]]").is_err());
    }

    #[test]
    fn an_error_says_what_the_type_permits() {
        for (ty, text, why) in [
            (DataType::Sgn08, "128", "128 is not of type SGN08, whose range is -128 to 127"),
            (DataType::Uns32, "-1", "-1 is not of type UNS32, whose range is 0 to 4294967295"),
            (DataType::Lint, "0x1_0", "0x1_0 is not of type LINT, which is a whole number"),
            (
                DataType::Lword,
                "99999999999999999999999999999999999999999999",
                "99999999999999999999999999999999999999999999 is not of type LWORD, whose range is 0 to \
                 18446744073709551615",
            ),
            (DataType::Uns16, "1.5", "1.5 is not of type UNS16, which is a whole number"),
            (
                DataType::Real64,
                "inf",
                "inf is not of type REAL64, which is a number such as -1.5e3",
            ),
            (
                DataType::Real32,
                "1e39",
                "1e39 is not of type REAL32, whose range is -3.4028235e38 to 3.4028235e38",
            ),
            (
                DataType::Real64,
                "-1e-400",
                "-1e-400 is not of type REAL64, which would round it to 0",
            ),
            (
                DataType::Real32,
                "0.1e-50",
                "0.1e-50 is not of type REAL32, which would round it to 0",
            ),
            (
                DataType::Boolean,
                "2",
                "2 is not of type BOOLEAN, which has the values TRUE, FALSE, 1 and 0",
            ),
            (DataType::Uns08, "1,2", "UNS08 is a single element, but 2 are given"),
        ] {
            assert_eq!(parse(&single(ty), text).unwrap_err().to_string(), why);
        }
    }

    #[test]
    fn texts_that_do_not_fit_are_rejected() {
        let ty = Type { size: Some(4), ..Type::hinted(DataType::String) };
        assert_eq!(parse(&ty, "a,b").unwrap(), b"a,b\0");
        assert_eq!(parse(&ty, "").unwrap(), b"\0");
        assert_eq!(
            parse(&ty, "abcd").unwrap_err().to_string(),
            "a STRING of 4 bytes has at most 3 characters and its NUL, but 4 are given"
        );
        assert!(parse(&ty, "Ω").unwrap_err().to_string().contains("CP1252"));
        let two = Type { dimensions: vec![2], size: Some(12), ..ty };
        let bytes = parse(&two, "\"a,\"\"b\", c").unwrap();
        assert_eq!(bytes, b"a,\"b\0\0c\0\0\0\0\0");
        assert_eq!(plain(&two, &bytes).unwrap(), "\"a,\"\"b\",c");
        for odd in ["\"a", "\"a\"b,c", "a", "a,b,c"] {
            assert!(parse(&two, odd).is_err(), "{odd}");
        }
    }

    #[test]
    fn a_parsed_value_is_formatted_as_given() {
        for (ty, text) in [
            (Type::known(DataType::Sgn16, vec![2, 2]), "1,-2,3,-4"),
            (Type::known(DataType::Real64, vec![]), "0.1"),
            (Type::known(DataType::Real64, vec![]), "5e-324"),
            (Type::known(DataType::Real32, vec![3]), "0.0,-0.0,1e-45"),
            (Type::known(DataType::Boolean, vec![2]), "TRUE,FALSE"),
        ] {
            assert_eq!(plain(&ty, &parse(&ty, text).unwrap()).unwrap(), text);
        }
    }
}
