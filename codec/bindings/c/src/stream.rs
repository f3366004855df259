//! Decoding and building streams by their tables, and converting texts.

use codec::CncStr;
use codec::layout::{Field, Size, Stream, Type};
use codec::text::{char_to_cp1252, cp1252_to_char};

use crate::error::{AdsCncError, Fault, told};
use crate::memory::{AdsCncBytes, bytes, fill, put, put_item, room, slice, to_u32, to_usize};
use crate::tables::{field, field_number};

/// A field of a decoded stream, or one item of a field that is a list.
#[repr(C)]
pub struct AdsCncField {
    /// The number of the field.
    pub field: u32,
    /// The index of the record, from 0.
    pub record: u32,
    /// The index of the item in a list, from 0.
    pub item: u32,
    /// The offset of the bytes of the field in the stream.
    pub offset: u32,
    /// The number of bytes of the field.
    pub length: u32,
    /// The value of a number of at most four bytes; otherwise 0.
    pub number: u32,
}

/// A field of a stream to build, or one item of a field that is a list.
#[repr(C)]
pub struct AdsCncPart {
    /// The number of the field.
    pub field: u32,
    /// The number, if `data` is null and the field is a number of at most four bytes.
    pub number: u32,
    /// The bytes.
    pub data: AdsCncBytes,
}

/// # Safety
/// `fields` is null or points to memory for `room` values; `count` is null or points to memory for
/// one value.
pub(crate) unsafe fn walk(
    stream: Stream,
    data: &[u8],
    fields: *mut AdsCncField,
    room: u32,
    count: *mut u32,
) -> Result<(), Fault> {
    let mut found = 0_u32;
    let walked = stream.walk(data, |segment| {
        let is_number = segment.bytes.len() <= 4
            && segment
                .field
                .spec()
                .is_some_and(|row| row.ty != Type::String && row.ty != Type::Bytes);
        let number =
            segment.bytes.iter().rev().fold(0_u32, |sum, byte| sum << 8 | u32::from(*byte));
        let place = AdsCncField {
            field: field_number(segment.field),
            record: segment.record,
            item: segment.item,
            offset: segment.offset,
            length: to_u32(segment.bytes.len()),
            number: if is_number { number } else { 0 },
        };
        // SAFETY: the caller's contract.
        unsafe { put_item(fields, room, found, place) };
        found = found.saturating_add(1);
    });
    // SAFETY: the caller's contract.
    unsafe { put(count, found) };
    walked?;
    // Without an array, the fields are only counted.
    match found > room && !fields.is_null() {
        true => Err(Fault::Room(found, room)),
        false => Ok(()),
    }
}

/// Checks a stream and returns its fields.
///
/// # Safety
/// `data` points to `length` bytes; `fields` is null or points to memory for `room` values; `count`
/// and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_decode(
    stream: u32,
    data: *const u8,
    length: u32,
    fields: *mut AdsCncField,
    room: u32,
    count: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let decode = || -> Result<(), Fault> {
        let stream = crate::tables::stream(stream).ok_or(Fault::NoStream)?;
        // SAFETY: the caller's contract.
        unsafe { walk(stream, bytes(data, length)?, fields, room, count) }
    };
    // SAFETY: the caller's contract.
    unsafe { told(decode(), error) }
}

/// The bytes of a part: a slice of its data, or its number in little-endian order.
#[derive(Clone, Copy)]
enum Bytes<'a> {
    Data(&'a [u8]),
    Number([u8; 4], usize),
}

impl AsRef<[u8]> for Bytes<'_> {
    fn as_ref(&self) -> &[u8] {
        match self {
            Self::Data(bytes) => bytes,
            Self::Number(bytes, size) => bytes.get(..*size).unwrap_or(bytes),
        }
    }
}

/// # Safety
/// The pointer of the part is null, or points to its bytes, which are not written during `'a`.
unsafe fn part<'a>(stream: Stream, part: &AdsCncPart) -> Result<(Field, Bytes<'a>), Fault> {
    let field = field(stream, part.field).ok_or(Fault::NoField)?;
    let row = field.spec().ok_or(Fault::NoField)?;
    let is_text = matches!(row.ty, Type::String | Type::Bytes | Type::NetId);
    let size = match row.size {
        Size::Fixed(size) | Size::FixedOnSuccess(size) | Size::OptionalFixed(size) => size,
        Size::Items { each, .. } => each,
        Size::NonZero | Size::Uns8To32 => 4,
        _ => 0,
    };
    if !part.data.data.is_null() || is_text || size > 4 {
        // SAFETY: the caller's contract.
        return Ok((field, Bytes::Data(unsafe { part.data.get()? })));
    }
    let (number, size) = (part.number.to_le_bytes(), to_usize(size));
    match number.iter().skip(size).all(|byte| *byte == 0) {
        true => Ok((field, Bytes::Number(number, size))),
        false => Err(Fault::Argument(row.name)),
    }
}

/// Builds a stream from its fields.
///
/// # Safety
/// `parts` points to `count` parts, and each part to its data; `buffer` points to `room` bytes;
/// `length` and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_build(
    stream: u32,
    parts: *const AdsCncPart,
    count: u32,
    buffer: *mut u8,
    room: u32,
    length: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let build = || -> Result<(), Fault> {
        let stream = crate::tables::stream(stream).ok_or(Fault::NoStream)?;
        // SAFETY: the caller's contract.
        let parts = unsafe { slice(parts, count)? };
        for part in parts {
            // SAFETY: the caller's contract.
            unsafe { self::part(stream, part)? };
        }
        // The second pass over the parts cannot fail, because the first pass has checked all parts.
        // SAFETY: the caller's contract.
        let parts = parts.iter().filter_map(|part| unsafe { self::part(stream, part).ok() });
        // SAFETY: the caller's contract.
        unsafe { fill(buffer, room, length, |buffer| Ok(stream.join(parts, buffer)?.len())) }
    };
    // SAFETY: the caller's contract.
    unsafe { told(build(), error) }
}

/// An output buffer that also counts the bytes that do not fit.
struct Out<'b> {
    buffer: &'b mut [u8],
    length: usize,
}

impl Out<'_> {
    fn put(&mut self, bytes: &[u8]) {
        let room = self.buffer.get_mut(self.length..).and_then(|room| room.get_mut(..bytes.len()));
        room.into_iter().flatten().zip(bytes).for_each(|(to, from)| *to = *from);
        self.length = self.length.saturating_add(bytes.len());
    }

    fn finish(&self) -> Result<u32, Fault> {
        let [length, room] = [self.length, self.buffer.len()].map(to_u32);
        if length > room { Err(Fault::Room(length, room)) } else { Ok(length) }
    }
}

/// Converts a text, and writes the length of the result to `length`.
///
/// # Safety
/// `data` points to `size` bytes, `buffer` to memory for `room` bytes; `length` is null or points
/// to memory for one value.
unsafe fn convert(
    (data, size): (*const u8, u32),
    (buffer, room): (*mut u8, u32),
    length: *mut u32,
    write: impl FnOnce(&[u8], &mut Out<'_>) -> Result<(), Fault>,
) -> Result<(), Fault> {
    // SAFETY: the caller's contract.
    let (data, buffer) = unsafe { (bytes(data, size)?, self::room(buffer, room)?) };
    let mut out = Out { buffer, length: 0 };
    write(data, &mut out)?;
    // SAFETY: the caller's contract.
    unsafe { put(length, to_u32(out.length)) };
    out.finish().map(drop)
}

/// Converts CP1252, up to the first NUL or the end, to UTF-8 without a NUL. `length` is the length of
/// the result, even if it does not fit.
///
/// # Safety
/// `data` points to `size` bytes, `buffer` to `room` bytes; `length` and `error` are null or point to
/// memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_text_to_utf8(
    data: *const u8,
    size: u32,
    buffer: *mut u8,
    room: u32,
    length: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let to_utf8 = |data: &[u8], out: &mut Out<'_>| {
        for byte in data.iter().take_while(|byte| **byte != 0) {
            out.put(cp1252_to_char(*byte).encode_utf8(&mut [0; 4]).as_bytes());
        }
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(convert((data, size), (buffer, room), length, to_utf8), error) }
}

/// Converts UTF-8 to CP1252 without a NUL. `length` is the length of the result, even if it does not
/// fit.
///
/// # Safety
/// `data` points to `size` bytes, `buffer` to `room` bytes; `length` and `error` are null or point to
/// memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_text_from_utf8(
    data: *const u8,
    size: u32,
    buffer: *mut u8,
    room: u32,
    length: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let from_utf8 = |data: &[u8], out: &mut Out<'_>| {
        let text = core::str::from_utf8(data).map_err(|_| Fault::Argument("data"))?;
        CncStr::new(text)?;
        text.chars().filter_map(char_to_cp1252).for_each(|byte| out.put(&[byte]));
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(convert((data, size), (buffer, room), length, from_utf8), error) }
}
