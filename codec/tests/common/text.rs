//! Laws of texts, with the crate `encoding_rs` as the reference for CP1252 (GEN-3).

use std::hash::{DefaultHasher, Hash, Hasher as _};

use ads_cnc::text::{TextRef, char_to_cp1252, cp1252_to_char};
use ads_cnc::{CncStr, Error, ErrorKind};
use encoding_rs::{EncoderResult, WINDOWS_1252};

/// A fault that is added to a text, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct CncStrMutation {
    pub(crate) shown: fn(String) -> String,
    pub(crate) bytes: fn(&mut Vec<u8>),
    /// Changes the result of `CncStr::len`, given the characters of the text.
    pub(crate) len: fn(usize, &str) -> usize,
    pub(crate) fault: fn(Fault) -> Option<Fault>,
}

impl CncStrMutation {
    pub(crate) const NONE: Self =
        Self { shown: |text| text, bytes: |_| (), len: |len, _| len, fault: Some };
}

/// The kind, the offset and the found number of an error.
type Fault = (ErrorKind, usize, u32);

fn fault_of(error: Error) -> Fault {
    (error.kind(), error.offset() as usize, error.found())
}

/// Checks any bytes as CP1252: bytes with a NUL are an error; other bytes have the same characters
/// as in the crate `encoding_rs`. Returns the displayed text.
pub(crate) fn check_cp1252(bytes: &[u8], mutation: CncStrMutation) -> Result<String, Fault> {
    let found = CncStr::from_bytes(bytes).map_err(fault_of);
    let nul = bytes.iter().position(|&byte| byte == 0);
    let wanted = nul.map(|at| (ErrorKind::InnerNul, at, at as u32));
    assert_eq!(found.err().and_then(mutation.fault), wanted, "{bytes:x?}");
    let text = found?;
    let (characters, faulty) = WINDOWS_1252.decode_without_bom_handling(bytes);
    assert!(!faulty);
    let shown = check_both(text, &characters, bytes, mutation);
    for (&byte, character) in bytes.iter().zip(characters.chars()) {
        assert_eq!((cp1252_to_char(byte), char_to_cp1252(character)), (character, Some(byte)));
    }
    check_field(bytes);
    Ok(shown)
}

/// Checks any Rust string: its CP1252 bytes are the same as in the crate `encoding_rs`, or the
/// first character that is a NUL or has no CP1252 byte is an error. Returns the displayed text.
pub(crate) fn check_utf8(utf8: &str, mutation: CncStrMutation) -> Result<String, Fault> {
    let found = CncStr::new(utf8).map_err(fault_of);
    let mut bytes = Vec::new();
    let mut fault = None;
    for (at, character) in utf8.chars().enumerate() {
        let theirs = encoded(character);
        assert_eq!(char_to_cp1252(character), theirs, "{character:?}");
        match theirs {
            Some(0) => fault = fault.or(Some((ErrorKind::InnerNul, at, at as u32))),
            Some(byte) => bytes.push(byte),
            None => fault = fault.or(Some((ErrorKind::NotCp1252, at, character.into()))),
        }
    }
    assert_eq!(found.err().and_then(mutation.fault), fault, "{utf8:?}");
    let text = found?;
    Ok(check_both(text, utf8, &bytes, mutation))
}

fn encoded(character: char) -> Option<u8> {
    let (mut utf8, mut byte) = ([0; 4], [0; 1]);
    let text = character.encode_utf8(&mut utf8);
    let mut encoder = WINDOWS_1252.new_encoder();
    let (result, _, written) = encoder.encode_from_utf8_without_replacement(text, &mut byte, true);
    (result == EncoderResult::InputEmpty && written == 1).then_some(byte[0])
}

/// Checks that `text` has these characters and these bytes, and that the texts created from the
/// characters and from the bytes are equal.
fn check_both(
    text: CncStr<'_>,
    characters: &str,
    bytes: &[u8],
    mutation: CncStrMutation,
) -> String {
    let shown = (mutation.shown)(text.to_string());
    assert_eq!(shown, characters);
    assert!(text.chars().eq(characters.chars()) && text == *characters);
    let mut again: Vec<u8> = text.bytes().collect();
    (mutation.bytes)(&mut again);
    assert_eq!(again, bytes);
    let len = (mutation.len)(text.len(), characters);
    assert_eq!((len, text.is_empty()), (bytes.len(), bytes.is_empty()));

    let wire = CncStr::from_bytes(bytes).expect("text without NUL");
    let typed = CncStr::new(characters).expect("text in CP1252");
    let hash = |text: CncStr<'_>| {
        let mut hasher = DefaultHasher::new();
        text.hash(&mut hasher);
        hasher.finish()
    };
    assert!(wire == typed && hash(wire) == hash(typed));
    assert_eq!((format!("{wire} {wire:?}")), format!("{typed} {typed:?}"));
    // A text with one character more differs.
    let longer = [bytes, b"x"].concat();
    assert!(CncStr::from_bytes(&longer).unwrap() != typed);
    #[cfg(feature = "alloc")]
    {
        let owned = ads_cnc::CncString::from(typed);
        assert_eq!((owned.as_bytes(), owned.as_cnc_str()), (bytes, wire));
        assert_eq!(characters.parse(), Ok(owned.clone()));
        assert_eq!(format!("{owned} {owned:?}"), format!("{wire} {wire:?}"));
    }
    shown
}

/// Checks that a text field has the text and the tail from which it was created, and that its
/// length includes the NUL, if any. It must equal a field with one NUL exactly if its end is one
/// NUL.
fn check_field(bytes: &[u8]) {
    let text = CncStr::from_bytes(bytes).expect("text without NUL");
    for (tail, len) in [(None, 0), (Some(&[][..]), 1), (Some(&[0, 0][..]), 3)] {
        let field = TextRef::with_tail(text, tail);
        assert_eq!((field.text(), field.tail()), (text, tail));
        assert_eq!(field.field_len(), bytes.len() + len);
        assert_eq!(field == TextRef::from(text), len == 1);
        #[cfg(feature = "alloc")]
        assert_eq!(ads_cnc::Text::from(field).as_ref(), field);
    }
}
