//! Tests of code page 1252 (GEN-3), in comparison with the crate `encoding_rs`.

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

/// A text of all bytes except NUL obeys the laws of texts, including the five bytes to which the code
/// page assigns no character. A character that the code page lacks is rejected.
#[test]
fn all_bytes_but_nul_obey_the_laws_of_texts() {
    let all: Vec<u8> = (1..=u8::MAX).collect();
    assert!(check_cp1252(&all, CncStrMutation::NONE).is_ok());
    #[cfg(feature = "alloc")]
    assert!("V.E.Ω".parse::<ads_cnc::CncString>().is_err());
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
