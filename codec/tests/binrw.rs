//! Tests of `BinRead` and `BinWrite` that the laws of all streams (`common`) do not contain.

#![cfg(feature = "binrw")]

use ads_cnc::ads::WriteRequest;
// `binrw::io` exists without `std`, too.
use ads_cnc::binrw::io::{self, Cursor, Read, Seek, SeekFrom};
use ads_cnc::binrw::{self, BinRead, BinWrite};
use ads_cnc::{Decode, Description, Error, ErrorKind, ExtendedReply, Handle, HandleRead};

/// A reader that returns one byte at a time, each after an interruption, and then an error.
struct Broken<'a> {
    bytes: Cursor<&'a [u8]>,
    interrupted: bool,
}

impl Read for Broken<'_> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        self.interrupted = !self.interrupted;
        if self.interrupted {
            return Err(io::ErrorKind::Interrupted.into());
        }
        match self.bytes.read(&mut buf[..1])? {
            0 => Err(io::ErrorKind::ConnectionReset.into()),
            read => Ok(read),
        }
    }
}

impl Seek for Broken<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.bytes.seek(to)
    }
}

fn own(error: &binrw::Error) -> &Error {
    error.root_cause().custom_err().unwrap_or_else(|| panic!("{error}"))
}

const READ: [u8; 12] = [0x41, 0x23, 1, 0x20, 1, 0, 0, 0, 4, 0, 0, 0];

/// A read is repeated after the error `Interrupted`; another error of the reader, here
/// `ConnectionReset`, is returned.
#[test]
fn errors_of_a_reader_are_returned() {
    let broken = |bytes| {
        let bytes = Cursor::new(bytes);
        HandleRead::read(&mut Broken { bytes, interrupted: false })
    };
    assert_eq!(broken(&READ).unwrap().indices, [4]);
    let error = broken(&READ[..9]).unwrap_err();
    let binrw::Error::Io(error) = error.root_cause() else { panic!("{error}") };
    assert_eq!(error.kind(), io::ErrorKind::ConnectionReset);
}

/// Invalid bytes are reported as an [`Error`] of the crate. Its offset counts from the start of the
/// reader's bytes; the position of the reader is restored.
#[test]
fn errors_have_positions() {
    let mut reader = Cursor::new(&[7, 7, 0x41, 0x23, 1, 0x20, 1, 0][..]);
    reader.set_position(2);
    let error = HandleRead::read(&mut reader).unwrap_err();
    let error = own(&error);
    assert_eq!((error.kind(), error.offset(), error.found()), (ErrorKind::Truncated, 6, 2));
    assert_eq!(reader.position(), 2);
    let reply = ExtendedReply::read(&mut Cursor::new(&[1, 0, 0][..])).unwrap_err();
    assert_eq!(own(&reply).kind(), ErrorKind::Truncated);
}

#[test]
fn invalid_values_are_not_written() {
    let mut written = Cursor::new(Vec::new());
    let read = HandleRead { handle: Handle(1), indices: vec![0; 511] };
    let error = read.write(&mut written).unwrap_err();
    assert_eq!(own(&error).kind(), ErrorKind::TooMany);
    assert!(written.into_inner().is_empty());
}

/// A length of 4 MiB or 4 294 967 295 bytes with only three bytes after it, and a count of
/// 4 294 967 295 dimensions, are errors.
#[test]
fn lengths_are_checked_before_memory_is_allocated() {
    for length in [0x40_0000_u32, u32::MAX] {
        let bytes = [&[0; 8], &length.to_le_bytes()[..], &[1, 2, 3]].concat();
        let error = WriteRequest::read(&mut Cursor::new(&bytes)).unwrap_err();
        assert_eq!((own(&error).kind(), own(&error).expected()), (ErrorKind::Truncated, length));
    }
    let count = [&[0; 16], &u32::MAX.to_le_bytes()[..]].concat();
    let error = Description::read(&mut Cursor::new(&count)).unwrap_err();
    assert_eq!((own(&error).kind(), own(&error).expected()), (ErrorKind::TooMany, 0));
    // The error has the maximum, or the number of items that fit, like that of `decode`.
    let bytes = [&count[..], &[1; 3000]].concat();
    let error = Description::read(&mut Cursor::new(&bytes)).unwrap_err();
    let decoded = Description::decode(&bytes[..2048]).unwrap_err();
    assert_eq!(
        (own(&error).kind(), own(&error).expected()),
        (ErrorKind::TooMany, decoded.expected())
    );
}
