//! Frames on a TCP stream: AMS/TCP header, AMS header, data.

use zerocopy::IntoBytes as _;

use super::header::HeaderLayout;
use super::{AmsHeader, AmsTcpHeader, ReadWriteRequestRef};
use crate::bytes::{Writer, to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::{Declared as _, Field, Stream, Subject};
use crate::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN, length};
use crate::stream::{Decode, Encode};

/// A frame: an AMS header and its data.
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// ```
/// use ads_cnc::Encode;
/// use ads_cnc::ads::{
///     AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef, StateFlags,
/// };
///
/// let end = AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 1]), port: AmsPort::SDA };
/// let header = AmsHeader {
///     target: end, source: end, command: Command::WRITE, state_flags: StateFlags::RESPONSE,
///     data_length: 4, error: AdsError::NO_ERROR, invoke_id: 1,
/// };
/// let mut buf = [0; 64];
/// let bytes = FrameRef::new(header, &[0; 4])?.encode(&mut buf)?;
///
/// // TCP delivers bytes in pieces; `split` returns a frame when it is complete.
/// assert_eq!(FrameRef::split(&bytes[..40], 1024)?, None);
/// let (frame, len) = FrameRef::split(bytes, 1024)?.unwrap();
/// assert_eq!((frame.header(), frame.data(), len), (header, &[0; 4][..], 42));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRef<'a> {
    header: AmsHeader,
    data: &'a [u8],
}

impl<'a> FrameRef<'a> {
    /// The length of the two headers before the data, in bytes.
    pub const HEADERS_LEN: usize = AMS_TCP_HEADER_LEN + AMS_HEADER_LEN;

    /// The maximum length of a frame in bytes.
    #[cfg(feature = "alloc")]
    pub(crate) const LEN_MAX: usize = Self::HEADERS_LEN + DATA_MAX;

    /// A frame with this data. Sets `data_length` in the header.
    ///
    /// # Errors
    /// [`ErrorKind::TooLong`] for more than [`ADS_DATA_MAX`](crate::limits::ADS_DATA_MAX) + 16
    /// bytes of data, the maximum length of a ReadWrite request.
    pub fn new(header: AmsHeader, data: &'a [u8]) -> Result<Self, Error> {
        let data_length = to_u32(data.len());
        check(data_length, u32::MAX)?;
        Ok(Self { header: AmsHeader { data_length, ..header }, data })
    }

    /// The AMS header.
    pub const fn header(&self) -> AmsHeader {
        self.header
    }

    /// The bytes after the AMS header.
    pub const fn data(&self) -> &'a [u8] {
        self.data
    }

    /// The first frame in `received`, and its length in bytes; `None` if the frame is not complete yet.
    ///
    /// # Errors
    /// As soon as the header with the fault is complete: [`ErrorKind::Mismatch`] for a field
    /// `reserved` that is not 0 and for two lengths that disagree; [`ErrorKind::OutOfRange`] for a
    /// length that is less than that of the AMS header; [`ErrorKind::TooLong`] for more than
    /// `max_data` bytes of data, or more than [`new`](Self::new) accepts. Offsets count from the
    /// start of the frame. After an error, close the connection: this function cannot find the next
    /// frame.
    pub fn split(received: &'a [u8], max_data: u32) -> Result<Option<(Self, usize)>, Error> {
        let Some((tcp, rest)) = received.split_at_checked(AMS_TCP_HEADER_LEN) else {
            return Ok(None);
        };
        let tcp = AmsTcpHeader::decode(tcp)?;
        if tcp.reserved != 0 {
            let field = const { Field::of::<AmsTcpHeader>("reserved") };
            return Err(Error::new(ErrorKind::Mismatch, field, 0, 0, tcp.reserved.into()));
        }
        let Some(data_length) = tcp.length.checked_sub(to_u32(AMS_HEADER_LEN)) else {
            let least = to_u32(AMS_HEADER_LEN);
            return Err(Error::new(ErrorKind::OutOfRange, LENGTH, LENGTH_AT, least, tcp.length));
        };
        check(data_length, max_data)?;
        let Some((header, rest)) = rest.split_at_checked(AMS_HEADER_LEN) else {
            return Ok(None);
        };
        let header = AmsHeader::decode(header)?;
        if header.data_length != data_length {
            let field = const { Field::of::<HeaderLayout>("data_length") };
            // Offsets in this function count from the start of the frame.
            let at = const { HeaderLayout::LAYOUT.offset("data_length") };
            let (at, found) = (at.saturating_add(to_u32(AMS_TCP_HEADER_LEN)), header.data_length);
            return Err(Error::new(ErrorKind::Mismatch, field, at, data_length, found));
        }
        Ok(rest.get(..to_usize(data_length)).map(|data| {
            let len = Self::HEADERS_LEN.saturating_add(data.len());
            (Self { header, data }, len)
        }))
    }
}

impl Encode for FrameRef<'_> {
    fn encoded_len(&self) -> usize {
        Self::HEADERS_LEN.saturating_add(self.data.len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        // `new` limits the data; `min` proves to the compiler that no sum of lengths overflows.
        let data_length = to_u32(self.data.len().min(DATA_MAX));
        let length = data_length.saturating_add(to_u32(AMS_HEADER_LEN));
        Writer::fill(Subject::Stream(Stream::AmsTcpHeader), self.encoded_len(), buf, |out| {
            out.stream(&AmsTcpHeader { reserved: 0, length });
            out.put(self.header.layout().as_bytes());
            out.put(self.data);
        })
    }
}

/// The field with the number of bytes after the AMS/TCP header, for errors.
const LENGTH: Field = Field::of::<AmsTcpHeader>("length");
const LENGTH_AT: u32 = AmsTcpHeader::LAYOUT.offset("length");

/// The maximum length of the data of a frame in bytes: that of a ReadWrite request, the longest
/// request or reply of an ADS service in this crate.
const DATA_MAX: usize = length::<ReadWriteRequestRef<'_>>();

fn check(data_length: u32, max: u32) -> Result<(), Error> {
    let max = max.min(to_u32(DATA_MAX));
    if data_length <= max {
        return Ok(());
    }
    let limit = max.saturating_add(to_u32(AMS_HEADER_LEN));
    let found = data_length.saturating_add(to_u32(AMS_HEADER_LEN));
    Err(Error::new(ErrorKind::TooLong, LENGTH, LENGTH_AT, limit, found))
}
