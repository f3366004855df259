//! The data of one write to the stream.

use crate::declare::stream;

stream! {
    /// The data of one write to the program stream.
    ///
    /// Neither the decoder nor the encoder checks that the lines are complete: the CNC does when it
    /// reads them (STM-5). [`Sender`](super::Sender) returns complete lines.
    ///
    /// Manual: `stream-en`, sections 3.1, 3.2 and 4.1.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::streaming::ProgramStreamRef;
    ///
    /// assert_eq!(ProgramStreamRef::decode(b"N30 M30\r\n")?.bytes, b"N30 M30\r\n");
    /// assert_eq!(
    ///     ProgramStreamRef::decode(&[b' '; 993]).unwrap_err().to_string(),
    ///     "program-stream: stream at offset 992: too long, expected at most 992 bytes, found 993"
    /// );
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ProgramStream "program-stream", "Data streaming, request", "STM-2", max 992;
    struct ProgramStreamRef<'a> / ProgramStream {
        @0 bytes "data": REST(1, 992), "STM-4", "whole lines of NC text";
    }
}
