//! Code page 1252: one byte per character.

/// The characters of the bytes 0x80..=0x9F. Any other byte has the character with the same code point.
///
/// The code page has no characters for the bytes 0x81, 0x8D, 0x8F, 0x90 and 0x9D. These bytes are
/// converted to the control characters with the same code points, so that every byte converts to a
/// character and back.
const HIGH: [char; 32] = [
    '\u{20AC}', '\u{81}', '\u{201A}', '\u{0192}', '\u{201E}', '\u{2026}', '\u{2020}', '\u{2021}',
    '\u{02C6}', '\u{2030}', '\u{0160}', '\u{2039}', '\u{0152}', '\u{8D}', '\u{017D}', '\u{8F}',
    '\u{90}', '\u{2018}', '\u{2019}', '\u{201C}', '\u{201D}', '\u{2022}', '\u{2013}', '\u{2014}',
    '\u{02DC}', '\u{2122}', '\u{0161}', '\u{203A}', '\u{0153}', '\u{9D}', '\u{017E}', '\u{0178}',
];

/// The character of a CP1252 byte.
///
/// ```
/// assert_eq!(ads_cnc::text::cp1252_to_char(0x80), '€');
/// ```
pub fn cp1252_to_char(byte: u8) -> char {
    let high = byte.checked_sub(0x80).and_then(|index| HIGH.get(usize::from(index)));
    high.copied().unwrap_or(char::from(byte))
}

/// The byte that [`cp1252_to_char`] converts to this character; `None` if there is no such byte.
///
/// ```
/// assert_eq!(ads_cnc::text::char_to_cp1252('ß'), Some(0xDF));
/// assert_eq!(ads_cnc::text::char_to_cp1252('Ω'), None);
/// ```
pub fn char_to_cp1252(character: char) -> Option<u8> {
    match u8::try_from(character) {
        Ok(byte @ (..=0x7F | 0xA0..)) => Some(byte),
        _ => (0x80..).zip(HIGH).find_map(|(byte, high)| (high == character).then_some(byte)),
    }
}
