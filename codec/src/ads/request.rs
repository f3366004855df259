//! Requests of Read, Write and ReadWrite.

use crate::address::{IndexGroup, IndexOffset};
use crate::declare::stream;

stream! {
    /// An ADS Read request.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::address::{IndexGroup, IndexOffset};
    /// use ads_cnc::{Decode, ads::ReadRequest};
    ///
    /// let request = ReadRequest::decode(b"\x01\x01\x13\0\x10\0\0\0\x54\0\0\0")?;
    /// assert_eq!(request.index_group, IndexGroup::new(0x13_0101));
    /// assert_eq!((request.index_offset.get(), request.length), (0x10, 84));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadRequest "read-request", "ADS Read, request", "ADS-1", max 12;
    struct ReadRequest {
        @0 index_group: UNS32 as IndexGroup,   "ADS-1", "index group";
        @4 index_offset: UNS32 as IndexOffset, "ADS-1", "index offset";
        @8 length: UNS32,                      "ADS-1", "bytes to read at most";
    }
}

stream! {
    /// An ADS Write request.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, ads::WriteRequestRef};
    ///
    /// let request = WriteRequestRef::decode(b"\x01\x01\x12\0\x01\0\0\0\x01\0\0\0\x09")?;
    /// assert_eq!(request.data, [9]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    WriteRequest "write-request", "ADS Write, request", "ADS-2", max (ADS_DATA + 12);
    struct WriteRequestRef<'a> / WriteRequest {
              @0  index_group: UNS32 as IndexGroup,   "ADS-2", "index group";
              @4  index_offset: UNS32 as IndexOffset, "ADS-2", "index offset";
        count @8  length,                             "ADS-2", "bytes of data";
              @12 data: DATA,                         "ADS-2", "the data";
    }
}

stream! {
    /// An ADS ReadWrite request.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, ads::ReadWriteRequestRef};
    ///
    /// let bytes = b"\x01\x23\x12\0\x44\0\0\0\x04\0\0\0\x04\0\0\0V.E\0";
    /// let request = ReadWriteRequestRef::decode(bytes)?;
    /// assert_eq!((request.index_offset.get(), request.read_length), (0x44, 4));
    /// assert_eq!(request.data, b"V.E\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadWriteRequest "read-write-request", "ADS ReadWrite, request", "ADS-3", max (ADS_DATA + 16);
    struct ReadWriteRequestRef<'a> / ReadWriteRequest {
              @0  index_group: UNS32 as IndexGroup,   "ADS-3", "index group";
              @4  index_offset: UNS32 as IndexOffset, "ADS-3", "index offset";
              @8  read_length: UNS32,                 "ADS-3", "bytes to read at most";
        count @12 write_length,                       "ADS-3", "bytes of data";
              @16 data: DATA,                         "ADS-3", "the data";
    }
}
