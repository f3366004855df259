//! Bytes as hex without spaces, for JSON. The parser accepts spaces.

use crate::text::shorten;

pub(crate) fn show(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

pub(crate) fn parse(text: &str) -> Result<Vec<u8>, String> {
    let digits: Option<Vec<u8>> = text
        .chars()
        .filter(|character| !character.is_ascii_whitespace())
        .map(|character| character.to_digit(16).and_then(|digit| u8::try_from(digit).ok()))
        .collect();
    let digits = digits.ok_or_else(|| format!("{} is not hex", cut(text)))?;
    let pairs = digits.chunks(2).map(|pair| match pair {
        [high, low] => Ok(high << 4 | low),
        _ => Err(format!("{} has an odd number of digits", cut(text))),
    });
    pairs.collect()
}

fn cut(text: &str) -> String {
    format!("{:?}", shorten(text, 40))
}

pub(crate) mod option {
    use serde::{Deserialize, Deserializer, Serializer, de::Error as _};

    pub(crate) fn serialize<S: Serializer>(
        bytes: &Option<Vec<u8>>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        match bytes {
            Some(bytes) => to.serialize_str(&super::show(bytes)),
            None => to.serialize_none(),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Vec<u8>>, D::Error> {
        let text = Option::<String>::deserialize(from)?;
        text.map(|text| super::parse(&text).map_err(D::Error::custom)).transpose()
    }
}

pub(crate) mod list {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

    pub(crate) fn serialize<S: Serializer>(
        list: &Option<Vec<Vec<u8>>>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let list = list
            .as_ref()
            .map(|list| list.iter().map(|bytes| super::show(bytes)).collect::<Vec<String>>());
        list.serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Vec<Vec<u8>>>, D::Error> {
        let list = Option::<Vec<String>>::deserialize(from)?;
        let parse = |list: Vec<String>| {
            list.iter().map(|text| super::parse(text)).collect::<Result<_, _>>()
        };
        list.map(|list| parse(list).map_err(D::Error::custom)).transpose()
    }
}
