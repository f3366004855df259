//! Tests of code page 1252 (GEN-3), in comparison with the crate `encoding_rs`.

use ads_cnc::CncStr;
use ads_cnc::text::{char_to_cp1252, cp1252_to_char};
use encoding_rs::WINDOWS_1252;
use proptest::prelude::*;

use super::common::text::{CncStrMutation, check_cp1252, check_utf8};
use super::kept;

/// Every byte is converted to the same character as by the crate `encoding_rs`.
#[test]
fn bytes_decode_as_elsewhere() {
    for byte in 0..=u8::MAX {
        let bytes = [byte];
        let (text, faulty) = WINDOWS_1252.decode_without_bom_handling(&bytes);
        assert!(!faulty);
        assert_eq!(text.chars().collect::<Vec<_>>(), [cp1252_to_char(byte)], "{byte:#x}");
        assert_eq!(char_to_cp1252(cp1252_to_char(byte)), Some(byte));
    }
}

/// Every character is converted to the same byte as by the crate `encoding_rs`, or rejected by
/// both.
#[test]
fn characters_encode_as_elsewhere() {
    let mut encoder = WINDOWS_1252.new_encoder();
    let mut with_byte = 0;
    for character in '\0'..=char::MAX {
        let mut utf8 = [0; 4];
        let mut byte = [0; 1];
        let text = character.encode_utf8(&mut utf8);
        let (result, _, written) =
            encoder.encode_from_utf8_without_replacement(text, &mut byte, true);
        let theirs = match result {
            encoding_rs::EncoderResult::InputEmpty => Some(byte[..written].to_vec()),
            _ => None,
        };
        assert_eq!(char_to_cp1252(character).map(|byte| vec![byte]), theirs, "{character:?}");
        with_byte += usize::from(theirs.is_some());
    }
    assert_eq!(with_byte, 256);
}

/// All bytes except NUL are converted to characters and back, including the five bytes to which the
/// code page assigns no character.
#[test]
fn texts_convert_to_characters_and_back() {
    for byte in 1..=u8::MAX {
        let bytes = [b'V', byte, b'x'];
        let wire = CncStr::from_bytes(&bytes).unwrap();
        let text = wire.to_string();
        let typed = CncStr::new(&text).unwrap();
        assert_eq!((typed, typed.len()), (wire, 3));
        assert_eq!(typed.bytes().collect::<Vec<_>>(), bytes);
        assert_eq!(wire, *text.as_str());
    }
    assert!(CncStr::from_bytes(b"V\0x").is_err());
    assert!(CncStr::new("V\0x").is_err());
}

/// Owned and borrowed texts have the same bytes, and are displayed as the same text.
#[cfg(feature = "alloc")]
#[test]
fn owned_and_borrowed_texts_are_equal() {
    use ads_cnc::CncString;

    let all: Vec<u8> = (1..=u8::MAX).collect();
    let wire = CncStr::from_bytes(&all).unwrap();
    let owned = CncString::from(wire);
    assert_eq!(owned.as_bytes(), all);
    assert_eq!(owned.as_cnc_str(), wire);
    assert_eq!(wire.to_string().parse(), Ok(owned.clone()));
    assert_eq!(format!("{owned} {owned:?}"), format!("{wire} {wire:?}"));
    assert!("V.E.Ω".parse::<CncString>().is_err());
}

proptest! {
    #![proptest_config(kept::cases(256, file!()))]

    #[test]
    fn any_bytes_obey_the_laws_of_texts(bytes in prop::collection::vec(any::<u8>(), 0..40)) {
        let _ = check_cp1252(&bytes, CncStrMutation::NONE);
    }

    #[test]
    fn any_characters_obey_the_laws_of_texts(text in "[\\PCaä€\0\u{81}]{0,20}") {
        let _ = check_utf8(&text, CncStrMutation::NONE);
    }
}
