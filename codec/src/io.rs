//! `BinRead` and `BinWrite`: reading and writing one row of a stream that `stream!` declares, and
//! implementations for streams whose types are written by hand, except `NoData`. No more items than the
//! maximum of a count are read, and memory is allocated only as the bytes arrive. The offset of an
//! error found while reading a row counts from the start of the reader.

use alloc::boxed::Box;
use alloc::vec::Vec;

use binrw::io::{self, Read, Seek, SeekFrom, Write};
use binrw::{BinResult, Endian};

use crate::ads::{AmsHeader, DeviceInfoReply, ReadReply, ReadWriteReply};
use crate::bytes::{Reader, Writer, to_u32, to_usize};
use crate::dynamic::DynamicValue;
use crate::error::{Error, ErrorKind};
use crate::layout::{ADS_DATA, Field, Size, Stream};
use crate::rows::{Owned, Pull};
use crate::sda::ElementLength;
use crate::stream::{Decode, Encode};
use crate::{Descriptor, Descriptors, ExtendedReply};

struct Source<'r, R> {
    reader: &'r mut R,
    bytes: Vec<u8>,
}

/// The maximum number of bytes to request from the reader at once. A wrong length therefore does
/// not cause an allocation that is much larger than the bytes that the reader returns.
const CHUNK: usize = 1024;

impl<R: Read> Pull for Source<'_, R> {
    fn exact(&mut self, len: usize) -> io::Result<()> {
        let mut left = len;
        while left > 0 {
            let before = self.bytes.len();
            self.bytes.resize(before.saturating_add(left.min(CHUNK)), 0);
            let count = self.reader.read(self.bytes.get_mut(before..).unwrap_or_default());
            let taken = count.as_ref().map_or(0, |count| *count);
            self.bytes.truncate(before.saturating_add(taken));
            left = left.saturating_sub(taken);
            match count {
                Ok(0) => break,
                Err(error) if error.kind() != io::ErrorKind::Interrupted => return Err(error),
                _ => {}
            }
        }
        Ok(())
    }

    fn rest(&mut self, max: u32) -> io::Result<()> {
        self.exact(to_usize(max).saturating_add(1))
    }

    fn until_nul(&mut self, max: u32) -> io::Result<()> {
        for _ in 0..max {
            let before = self.bytes.len();
            self.exact(1)?;
            if self.bytes.len() == before || self.bytes.last() == Some(&0) {
                break;
            }
        }
        Ok(())
    }

    fn counted(&mut self, each: usize, max: u32) -> io::Result<()> {
        let before = self.bytes.len();
        self.exact(size_of::<u32>())?;
        let count = self.bytes.get(before..).and_then(<[u8]>::first_chunk);
        let count = count.map_or(0, |count| u32::from_le_bytes(*count).min(max));
        self.exact(to_usize(count).saturating_mul(each))
    }
}

/// Reads one row.
pub(crate) fn parse<T: Owned, R: Read + Seek>(
    reader: &mut R,
    _: Endian,
    (stream, field): (Stream, Field),
) -> BinResult<T::Type> {
    let pos = reader.stream_position()?;
    let mut source = Source { reader, bytes: Vec::new() };
    T::pull(&mut source)?;
    let mut input = Reader::without_limit(stream, &source.bytes);
    let read = read_row::<T>(&mut input, field).map(T::own);
    // Reject a byte that was pulled but not decoded; otherwise it would be lost.
    let whole = read.and_then(|owned| input.finish().map(|()| owned));
    whole.map_err(|error| custom(error, pos))
}

fn read_row<'a, T: Owned>(input: &mut Reader<'a>, field: Field) -> Result<T::View<'a>, Error> {
    let (head, at) = head::<T>();
    let head = input.take(if at > 0 { field.before() } else { field }, head)?;
    T::read(input, head, field, to_usize(at))
}

/// The number of fixed bytes of a single row, including its count, and the length of the count.
const fn head<T: Owned>() -> (u32, u32) {
    match T::SIZE {
        Size::Items { .. } => (4, 4),
        size => (size.fixed(), 0),
    }
}

fn custom(error: Error, pos: u64) -> binrw::Error {
    let error = error.moved(u32::try_from(pos).unwrap_or(u32::MAX));
    binrw::Error::Custom { pos: error.offset().into(), err: Box::new(error) }
}

/// Writes one row.
pub(crate) fn emit<T: Owned, W: Write + Seek>(
    owned: &T::Type,
    writer: &mut W,
    _: Endian,
    (): (),
) -> BinResult<()> {
    let view = T::lend(owned);
    let mut bytes = alloc::vec![0; T::len(view)];
    let (head, at) = head::<T>();
    if let Some((head, rest)) = bytes.split_at_mut_checked(to_usize(head)) {
        T::write_head(view, head, to_usize(at));
        T::write(view, &mut Writer::new(rest));
    }
    writer.write_all(&bytes).map_err(Into::into)
}

/// Rejects values that a decoder would reject.
///
/// # Errors
/// Those of `encode`, except [`ErrorKind::BufferTooSmall`].
pub(crate) fn check(stream: &impl Encode) -> Result<(), Error> {
    // An empty buffer is sufficient, because `encode` checks the value before the buffer.
    match stream.encode(&mut []) {
        Err(error) if error.kind() != ErrorKind::BufferTooSmall => Err(error),
        _ => Ok(()),
    }
}

/// The error with which `encode` rejects this value; a `Mismatch` if `encode` accepts it.
pub(crate) fn error<'a, T: Encode + Decode<'a>>(stream: &T) -> Error {
    let len = to_u32(stream.encoded_len());
    let whole = Error::new(ErrorKind::Mismatch, Field::whole(T::STREAM), 0, len, len);
    check(stream).err().unwrap_or(whole)
}

/// `BinRead` and `BinWrite` for streams whose types are written by hand. `BinRead` pulls at most
/// the maximum length of the stream from the reader (one byte more for `Descriptors`), and decodes
/// the bytes.
///
/// | stream | why its type is written by hand |
/// |---|---|
/// | `AmsHeader` | an address has two rows |
/// | `DeviceInfoReply`, `Descriptor` | text of fixed length, a kind of row that only `packed` supports |
/// | `Descriptors` | a list of records without a count |
/// | `ReadReply`, `ReadWriteReply` | rows after the result may be absent if it is an error (ADS-6) |
/// | `ExtendedReply` | a reply may have no bytes |
/// | `ElementLength` | the width of the number is not documented, so the received width is kept |
/// | `DynamicValue` | values are compared by their bits |
macro_rules! by_hand {
    ($( $type:ty: $from:ident => $pull:expr; )+) => { $(
        impl binrw::meta::ReadEndian for $type {
            const ENDIAN: binrw::meta::EndianKind = binrw::meta::EndianKind::Endian(Endian::Little);
        }

        impl binrw::BinRead for $type {
            type Args<'a> = ();

            fn read_options<R: Read + Seek>(reader: &mut R, _: Endian, (): ()) -> BinResult<Self> {
                let pos = reader.stream_position()?;
                let mut $from = Source { reader, bytes: Vec::new() };
                let pulled = $pull;
                let decoded = pulled.map_err(binrw::Error::from).and_then(|()| {
                    Self::decode(&$from.bytes).map_err(|error| custom(error, pos))
                });
                // After an error, seek back, as implementations derived by binrw do.
                if decoded.is_err() {
                    reader.seek(SeekFrom::Start(pos))?;
                }
                decoded
            }
        }

        impl binrw::meta::WriteEndian for $type {
            const ENDIAN: binrw::meta::EndianKind = binrw::meta::EndianKind::Endian(Endian::Little);
        }

        impl binrw::BinWrite for $type {
            type Args<'a> = ();

            fn write_options<W: Write + Seek>(
                &self,
                writer: &mut W,
                _: Endian,
                (): (),
            ) -> BinResult<()> {
                let pos = writer.stream_position()?;
                let bytes = self.encode_to_vec().map_err(|error| custom(error, pos))?;
                writer.write_all(&bytes).map_err(Into::into)
            }
        }
    )+ };
}

/// The maximum length of a stream in bytes.
fn longest<'a, T: Decode<'a>>() -> usize {
    to_usize(T::STREAM.layout().max)
}

/// The length of a reply that ends after its result.
fn result_len() -> usize {
    to_usize(Stream::ReadReply.layout().offset("length"))
}

by_hand! {
    AmsHeader: from => from.exact(longest::<Self>());
    DeviceInfoReply: from => from.exact(longest::<Self>());
    Descriptor: from => from.exact(longest::<Self>());
    Descriptors: from => from.rest(ADS_DATA);
    ReadReply: from => from.exact(result_len()).and_then(|()| from.counted(1, ADS_DATA));
    ReadWriteReply: from => from.exact(result_len()).and_then(|()| from.counted(1, ADS_DATA));
    ExtendedReply: from => from.exact(longest::<Self>());
    ElementLength: from => from.exact(longest::<Self>());
    DynamicValue: from => from.exact(longest::<Self>());
}
