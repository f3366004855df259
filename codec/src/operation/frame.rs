//! Calls in AMS frames.

use super::{AdsService, Call};
use crate::ads::{Command, FrameRef, ReadRequest, ReadWriteRequestRef, WriteRequestRef};
use crate::error::Error;
use crate::stream::{Decode, Encode};

impl<'a> Call<'a> {
    /// The call in a frame; `None` if the command of the frame is not Read, Write or ReadWrite. The
    /// state flags are not checked, so a response is decoded as if it were a request.
    ///
    /// ```
    /// use ads_cnc::Encode;
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef};
    /// use ads_cnc::operation::{Call, CountVariables, Request};
    /// use ads_cnc::Kind;
    ///
    /// let request = Request::from(CountVariables::new(Channel::new(1)?, Kind::V_E));
    /// let mut buf = [0; 64];
    /// let call = request.encode(&mut buf)?;
    ///
    /// let target = AmsAddr { net_id: AmsNetId([192, 0, 2, 7, 1, 1]), port: call.port };
    /// let source = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };
    /// let header = AmsHeader::request(target, source, call.service.command(), 1);
    /// let mut data = [0; 64];
    /// let frame = FrameRef::new(header, call.encode(&mut data)?)?;
    ///
    /// assert_eq!(frame.data()[16..], *b"V.E\0");
    /// assert_eq!(Call::from_frame(&frame)?, Some(call));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the decoders of the requests, such as [`ReadRequest`].
    pub fn from_frame(frame: &FrameRef<'a>) -> Result<Option<Self>, Error> {
        let port = frame.header().target.port;
        let (service, index_group, index_offset, read_length, data) = match frame.header().command {
            Command::READ => {
                let read = ReadRequest::decode(frame.data())?;
                (AdsService::Read, read.index_group, read.index_offset, read.length, &[][..])
            }
            Command::WRITE => {
                let write = WriteRequestRef::decode(frame.data())?;
                (AdsService::Write, write.index_group, write.index_offset, 0, write.data)
            }
            Command::READ_WRITE => {
                let both = ReadWriteRequestRef::decode(frame.data())?;
                let (group, offset) = (both.index_group, both.index_offset);
                (AdsService::ReadWrite, group, offset, both.read_length, both.data)
            }
            _ => return Ok(None),
        };
        Ok(Some(Self { port, service, index_group, index_offset, read_length, data }))
    }
}

/// Encodes the request of the service: the data of a frame to the port of the call.
///
/// The encoder rejects a Read with data with [`Trailing`](crate::ErrorKind::Trailing), like
/// [`dispatch`](Call::dispatch). The read length of a Write is not encoded.
impl Encode for Call<'_> {
    fn encoded_len(&self) -> usize {
        match self.service {
            AdsService::Read => self.read_request().encoded_len(),
            AdsService::Write => self.write_request().encoded_len(),
            AdsService::ReadWrite => self.read_write_request().encoded_len(),
        }
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        match self.service {
            AdsService::Read if !self.data.is_empty() => Err(self.read_with_data()),
            AdsService::Read => self.read_request().encode(buf),
            AdsService::Write => self.write_request().encode(buf),
            AdsService::ReadWrite => self.read_write_request().encode(buf),
        }
    }
}

impl<'a> Call<'a> {
    const fn read_request(&self) -> ReadRequest {
        let Self { index_group, index_offset, read_length, .. } = *self;
        ReadRequest { index_group, index_offset, length: read_length }
    }

    const fn write_request(&self) -> WriteRequestRef<'a> {
        let Self { index_group, index_offset, data, .. } = *self;
        WriteRequestRef { index_group, index_offset, data }
    }

    const fn read_write_request(&self) -> ReadWriteRequestRef<'a> {
        let Self { index_group, index_offset, read_length, data, .. } = *self;
        ReadWriteRequestRef { index_group, index_offset, read_length, data }
    }
}
