//! The data of one write to the stream (STM-2).

use crate::bytes_stream::bytes_stream;
use crate::layout::field::program_stream::DATA;
use crate::limits::STREAM_PACKET_MAX;

bytes_stream! {
    #[doc = include_str!("../../doc/program-stream.md")]
    ///
    /// Whether its lines are whole, the CNC says when it reads them (STM-5); what
    /// [`Sender`](super::Sender) hands out is.
    ///
    /// Manual: `stream-en`, sections 3.1, 3.2 and 4.1.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::streaming::ProgramStreamRef;
    ///
    /// assert_eq!(ProgramStreamRef::decode(b"N30 M30\r\n")?.bytes, b"N30 M30\r\n");
    /// assert_eq!(
    ///     ProgramStreamRef::decode(&[b' '; 993]).unwrap_err().to_string(),
    ///     "program-stream: stream at offset 992: too long, at most 992 bytes expected, 993 there"
    /// );
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ProgramStreamRef, ProgramStream, ProgramStream {
        /// The text; one line at least (STM-4).
        bytes: DATA, 1 to STREAM_PACKET_MAX
    }
}
