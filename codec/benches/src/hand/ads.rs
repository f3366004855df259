//! Handwritten code for the headers and services of ADS.

use super::{ByteStorage, Fault, HandWritten, at_least, at_most, exactly, room, u16_at, u32_at};

const DATA_MAX: usize = 0x40_0000;

#[derive(Clone, Copy, Debug)]
pub(crate) struct TcpHeader {
    reserved: u16,
    length: u32,
}

impl<'a> HandWritten<'a> for TcpHeader {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes: &[u8; 6] = exactly(bytes)?;
        Ok(Self { reserved: u16_at(bytes, 0), length: u32_at(bytes, 2) })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 6)?;
        out[..2].copy_from_slice(&self.reserved.to_le_bytes());
        out[2..].copy_from_slice(&self.length.to_le_bytes());
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Address {
    net_id: [u8; 6],
    port: u16,
}

impl Address {
    pub(crate) fn read(bytes: &[u8]) -> Self {
        let mut net_id = [0; 6];
        net_id.copy_from_slice(&bytes[..6]);
        Self { net_id, port: u16_at(bytes, 6) }
    }

    fn put(&self, out: &mut [u8]) {
        out[..6].copy_from_slice(&self.net_id);
        out[6..8].copy_from_slice(&self.port.to_le_bytes());
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Header {
    target: Address,
    source: Address,
    command: u16,
    state_flags: u16,
    data_length: u32,
    error: u32,
    invoke_id: u32,
}

impl Header {
    fn put(&self, out: &mut [u8]) {
        self.target.put(&mut out[..8]);
        self.source.put(&mut out[8..16]);
        out[16..18].copy_from_slice(&self.command.to_le_bytes());
        out[18..20].copy_from_slice(&self.state_flags.to_le_bytes());
        out[20..24].copy_from_slice(&self.data_length.to_le_bytes());
        out[24..28].copy_from_slice(&self.error.to_le_bytes());
        out[28..32].copy_from_slice(&self.invoke_id.to_le_bytes());
    }
}

impl<'a> HandWritten<'a> for Header {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes: &[u8; 32] = exactly(bytes)?;
        Ok(Self {
            target: Address::read(&bytes[..8]),
            source: Address::read(&bytes[8..16]),
            command: u16_at(bytes, 16),
            state_flags: u16_at(bytes, 18),
            data_length: u32_at(bytes, 20),
            error: u32_at(bytes, 24),
            invoke_id: u32_at(bytes, 28),
        })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 32)?;
        self.put(out);
        Ok(out)
    }
}

/// A frame: the AMS/TCP header, the AMS header and the data.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<'a> {
    header: Header,
    data: &'a [u8],
}

impl<'a> Frame<'a> {
    /// Splits off the first received frame, with at most `max` bytes of data. Returns the frame and
    /// its length, or `None` if the frame is not complete.
    pub(crate) fn split(received: &'a [u8], max: u32) -> Result<Option<(Self, usize)>, Fault> {
        if received.len() < 6 {
            return Ok(None);
        }
        let tcp = TcpHeader::decode(&received[..6])?;
        if tcp.reserved != 0 {
            return Err(Fault::OutOfRange { at: 0, expected: 0, found: tcp.reserved.into() });
        }
        if tcp.length < 32 {
            return Err(Fault::OutOfRange { at: 2, expected: 32, found: tcp.length });
        }
        let data_length = tcp.length - 32;
        let max = max.min(DATA_MAX as u32 + 16);
        if data_length > max {
            return Err(Fault::TooLong { max, found: data_length });
        }
        if received.len() < 38 {
            return Ok(None);
        }
        let header = Header::decode(&received[6..38])?;
        if header.data_length != data_length {
            let found = header.data_length;
            return Err(Fault::OutOfRange { at: 26, expected: data_length, found });
        }
        let len = 38 + data_length as usize;
        Ok(received.get(38..len).map(|data| (Self { header, data }, len)))
    }

    pub(crate) fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 38 + self.data.len())?;
        out[..2].copy_from_slice(&[0, 0]);
        out[2..6].copy_from_slice(&(self.header.data_length + 32).to_le_bytes());
        self.header.put(&mut out[6..38]);
        out[38..].copy_from_slice(self.data);
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct ReadRequest {
    index_group: u32,
    index_offset: u32,
    length: u32,
}

impl<'a> HandWritten<'a> for ReadRequest {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes: &[u8; 12] = exactly(bytes)?;
        Ok(Self {
            index_group: u32_at(bytes, 0),
            index_offset: u32_at(bytes, 4),
            length: u32_at(bytes, 8),
        })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 12)?;
        out[..4].copy_from_slice(&self.index_group.to_le_bytes());
        out[4..8].copy_from_slice(&self.index_offset.to_le_bytes());
        out[8..].copy_from_slice(&self.length.to_le_bytes());
        Ok(out)
    }
}

/// Returns the data after the length field at offset `at`. The data must have exactly this length.
fn data(bytes: &[u8], at: usize) -> Result<&[u8], Fault> {
    let expected = u32_at(bytes, at);
    let data = &bytes[at + 4..];
    let found = data.len() as u32;
    if found < expected {
        return Err(Fault::Truncated { at: at as u32 + 4, expected, found });
    }
    if found > expected {
        let end = at as u32 + 4;
        return Err(Fault::Trailing { expected: end + expected, found: end + found });
    }
    Ok(data)
}

#[derive(Clone, Debug)]
pub(crate) struct WriteRequest<B> {
    index_group: u32,
    index_offset: u32,
    data: B,
}

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for WriteRequest<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(12 + DATA_MAX, bytes.len())?;
        at_least(12, bytes)?;
        Ok(Self {
            index_group: u32_at(bytes, 0),
            index_offset: u32_at(bytes, 4),
            data: data(bytes, 8)?.into(),
        })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let data = self.data.as_ref();
        at_most(DATA_MAX, data.len())?;
        let out = room(buf, 12 + data.len())?;
        out[..4].copy_from_slice(&self.index_group.to_le_bytes());
        out[4..8].copy_from_slice(&self.index_offset.to_le_bytes());
        out[8..12].copy_from_slice(&(data.len() as u32).to_le_bytes());
        out[12..].copy_from_slice(data);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct ReadWriteRequest<B> {
    index_group: u32,
    index_offset: u32,
    read_length: u32,
    data: B,
}

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for ReadWriteRequest<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(16 + DATA_MAX, bytes.len())?;
        at_least(16, bytes)?;
        Ok(Self {
            index_group: u32_at(bytes, 0),
            index_offset: u32_at(bytes, 4),
            read_length: u32_at(bytes, 8),
            data: data(bytes, 12)?.into(),
        })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let data = self.data.as_ref();
        at_most(DATA_MAX, data.len())?;
        let out = room(buf, 16 + data.len())?;
        out[..4].copy_from_slice(&self.index_group.to_le_bytes());
        out[4..8].copy_from_slice(&self.index_offset.to_le_bytes());
        out[8..12].copy_from_slice(&self.read_length.to_le_bytes());
        out[12..16].copy_from_slice(&(data.len() as u32).to_le_bytes());
        out[16..].copy_from_slice(data);
        Ok(out)
    }
}

/// The reply to Read and ReadWrite; an error may have no data field.
#[derive(Clone, Debug)]
pub(crate) struct Reply<B> {
    result: u32,
    data: Option<B>,
}

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for Reply<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(8 + DATA_MAX, bytes.len())?;
        at_least(4, bytes)?;
        let result = u32_at(bytes, 0);
        if result != 0 && bytes.len() == 4 {
            return Ok(Self { result, data: None });
        }
        at_least(8, bytes)?;
        Ok(Self { result, data: Some(data(bytes, 4)?.into()) })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let Some(data) = &self.data else {
            if self.result == 0 {
                return Err(Fault::Truncated { at: 4, expected: 4, found: 0 });
            }
            let out = room(buf, 4)?;
            out.copy_from_slice(&self.result.to_le_bytes());
            return Ok(out);
        };
        let data = data.as_ref();
        at_most(DATA_MAX, data.len())?;
        let out = room(buf, 8 + data.len())?;
        out[..4].copy_from_slice(&self.result.to_le_bytes());
        out[4..8].copy_from_slice(&(data.len() as u32).to_le_bytes());
        out[8..].copy_from_slice(data);
        Ok(out)
    }
}
