//! Access to memory of the caller. Only this module and `machines` convert pointers to references
//! or write through pointers.

use crate::error::Fault;

/// Bytes in memory of the caller or in constants of the library. The pointer may be null if the
/// length is 0.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(test, derive(Debug))]
pub struct AdsCncBytes {
    /// The first byte.
    pub data: *const u8,
    /// The number of bytes.
    pub length: u32,
}

impl AdsCncBytes {
    pub(crate) const NONE: Self = Self { data: core::ptr::null(), length: 0 };

    pub(crate) fn of(bytes: &[u8]) -> Self {
        Self { data: bytes.as_ptr(), length: to_u32(bytes.len()) }
    }

    /// # Safety
    /// As for [`bytes`].
    pub(crate) unsafe fn get<'a>(self) -> Result<&'a [u8], Fault> {
        // SAFETY: the caller's contract is the same.
        unsafe { bytes(self.data, self.length) }
    }
}

pub(crate) fn to_u32(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}

pub(crate) fn to_usize(length: u32) -> usize {
    usize::try_from(length).unwrap_or(usize::MAX)
}

/// Checks that a slice can have this number of items, and that the pointer is null only if they
/// have no bytes. Returns the number.
fn items<T>(data: *const T, count: u32) -> Result<usize, Fault> {
    let count = to_usize(count);
    let size = count.checked_mul(size_of::<T>()).and_then(|size| isize::try_from(size).ok());
    match size {
        Some(_) if !data.is_null() => Ok(count),
        Some(0) => Ok(0),
        _ => Err(Fault::Pointer),
    }
}

/// # Safety
/// `data` is null, or points to `count` initialised, aligned items that are not written during
/// `'a`.
pub(crate) unsafe fn slice<'a, T>(data: *const T, count: u32) -> Result<&'a [T], Fault> {
    match items(data, count)? {
        0 => Ok(&[]),
        // SAFETY: not null and no longer than a slice can be; the rest is the caller's contract.
        count => Ok(unsafe { core::slice::from_raw_parts(data, count) }),
    }
}

/// # Safety
/// As for [`slice`].
pub(crate) unsafe fn bytes<'a>(data: *const u8, length: u32) -> Result<&'a [u8], Fault> {
    // SAFETY: the caller's contract is the same.
    unsafe { slice(data, length) }
}

/// # Safety
/// `data` is null, or points to `length` bytes that only the returned reference accesses during
/// `'a`.
pub(crate) unsafe fn room<'a>(data: *mut u8, length: u32) -> Result<&'a mut [u8], Fault> {
    match items(data.cast_const(), length)? {
        0 => Ok(&mut []),
        // SAFETY: not null and no longer than a slice can be; the rest is the caller's contract.
        length => Ok(unsafe { core::slice::from_raw_parts_mut(data, length) }),
    }
}

/// # Safety
/// `it` is null, or points to an initialised, aligned `T` that is not written during `'a`.
pub(crate) unsafe fn get<'a, T>(it: *const T) -> Result<&'a T, Fault> {
    // SAFETY: the caller's contract.
    unsafe { it.as_ref() }.ok_or(Fault::Pointer)
}

/// Writes a value to memory of the caller; does nothing if the pointer is null.
///
/// # Safety
/// `out` is null, or points to aligned memory for a `T`.
pub(crate) unsafe fn put<T>(out: *mut T, value: T) {
    if !out.is_null() {
        // SAFETY: not null; the rest is the caller's contract.
        unsafe { out.write(value) }
    }
}

/// Fills a buffer of the caller with `write`, and writes the number of bytes to `length`.
///
/// # Safety
/// As for [`room`] and [`put`].
pub(crate) unsafe fn fill(
    buffer: *mut u8,
    size: u32,
    length: *mut u32,
    write: impl FnOnce(&mut [u8]) -> Result<usize, Fault>,
) -> Result<(), Fault> {
    // SAFETY: the caller's contract.
    let written = write(unsafe { room(buffer, size)? })?;
    // SAFETY: the caller's contract.
    unsafe { put(length, to_u32(written)) };
    Ok(())
}

/// Writes to item `at` of an array of the caller; does nothing if the array is null or `at` is
/// after its end.
///
/// # Safety
/// `array` is null, or points to aligned memory for `room` items.
pub(crate) unsafe fn put_item<T>(array: *mut T, room: u32, at: u32, value: T) {
    if at < room && items(array.cast_const(), room).is_ok() {
        // SAFETY: there is room for more than `at` items, and a slice can have that many.
        unsafe { array.wrapping_add(to_usize(at)).write(value) }
    }
}
