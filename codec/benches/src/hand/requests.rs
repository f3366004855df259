//! Handwritten code for the requests of a client: every function with its address and data.

use super::{Fault, room};

const SDA: u16 = 552;
const COM: u16 = 553;
const DECODER: u32 = 0x12_2300;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Service {
    Read = 2,
    Write = 3,
    ReadWrite = 9,
}

/// An encoded call. A client would send its data unchanged.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(not(test), expect(dead_code, reason = "nothing here sends it"))]
pub(crate) struct Call<'b> {
    pub(crate) port: u16,
    pub(crate) service: Service,
    pub(crate) index_group: u32,
    pub(crate) index_offset: u32,
    pub(crate) read_length: u32,
    pub(crate) data: &'b [u8],
}

/// A request. Requests for objects, elements and instances have an index group; all other requests
/// have a channel number instead.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Request<'a> {
    CountObjects { group: u32 },
    ReadDescriptors { group: u32, first: u32, read_length: u32 },
    CountVariables { channel: u8, kind: &'a [u8] },
    DescribeByIndex { channel: u8, index: u32, kind: &'a [u8] },
    HandleByName { channel: u8, name: &'a [u8] },
    ReadByHandle { channel: u8, handle: u32, indices: &'a [u32] },
    ReadByName { channel: u8, name: &'a [u8] },
    WriteByHandle { channel: u8, handle: u32, indices: &'a [u32], value: &'a [u8] },
    WriteByName { channel: u8, name: &'a [u8], value: &'a [u8] },
    DescribeExtended { channel: u8, index: u32, kind: &'a [u8] },
    DescribeByName { channel: u8, name: &'a [u8] },
    AxisHandleByName { channel: u8, axis: u16, name: &'a [u8] },
    AxisReadByName { channel: u8, axis: u16, name: &'a [u8] },
    AxisWriteByName { channel: u8, axis: u16, name: &'a [u8], value: &'a [u8] },
    CountDynamic { channel: u8, kind: u8 },
    DynamicNameByIndex { channel: u8, kind: u8, index: u32 },
    DynamicValueByName { channel: u8, kind: u8, name: &'a [u8] },
    DynamicValueByIndex { channel: u8, kind: u8, index: u32 },
    FindInstance { group: u32, channel: u32, axis: u32 },
    CountElements { group: u32, offset: u32 },
    ReadElement { group: u32, offset: u32, length: u32 },
    WriteElement { group: u32, offset: u32, content: &'a [u8] },
    ReadElementName { group: u32, offset: u32 },
    ReadElementType { group: u32, offset: u32 },
    ReadElementLength { group: u32, offset: u32 },
    ReadElementUnit { group: u32, offset: u32 },
    ReadElementWriteFlag { group: u32, offset: u32 },
    WriteProgramStream { channel: u8, packet: &'a [u8] },
    ReadObject { group: u32, offset: u32, length: u32 },
    WriteObject { group: u32, offset: u32, content: &'a [u8] },
}

impl Request<'_> {
    pub(crate) fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<Call<'b>, Fault> {
        use Request::*;
        use Service::*;
        let decoder = |channel: u8| DECODER | u32::from(channel);
        let of_axis = |axis: u16, element: u32| u32::from(axis) << 16 | element;
        let of_kind = |kind: u8, first: u32| first + 3 * u32::from(kind);
        let (port, service, index_group, index_offset, read_length, data) = match *self {
            CountObjects { group } => (COM, Read, group, 0, 4, &[][..]),
            ReadDescriptors { group, first, read_length } => {
                (COM, Read, group, first, read_length, &[][..])
            }
            CountVariables { channel, kind } => {
                (SDA, ReadWrite, decoder(channel), 0x44, 4, text(kind, 256, buf)?)
            }
            DescribeByIndex { channel, index, kind } => {
                (SDA, ReadWrite, decoder(channel), 0x45, 2048, index_kind(index, kind, buf)?)
            }
            HandleByName { channel, name } => {
                (SDA, ReadWrite, decoder(channel), 0x46, 4, text(name, 256, buf)?)
            }
            ReadByHandle { channel, handle, indices } => (
                SDA,
                ReadWrite,
                decoder(channel),
                0x47,
                2048,
                of_handle(handle, indices, &[], buf)?,
            ),
            ReadByName { channel, name } => {
                (SDA, ReadWrite, decoder(channel), 0x48, 2048, text(name, 256, buf)?)
            }
            WriteByHandle { channel, handle, indices, value } => {
                (SDA, Write, decoder(channel), 0x49, 0, of_handle(handle, indices, value, buf)?)
            }
            WriteByName { channel, name, value } => {
                (SDA, Write, decoder(channel), 0x4A, 0, text_value(name, value, buf)?)
            }
            DescribeExtended { channel, index, kind } => {
                (SDA, ReadWrite, decoder(channel), 0x4B, 2048, index_kind(index, kind, buf)?)
            }
            DescribeByName { channel, name } => {
                (SDA, ReadWrite, decoder(channel), 0x4C, 2048, text(name, 256, buf)?)
            }
            AxisHandleByName { channel, axis, name } => {
                (SDA, ReadWrite, decoder(channel), of_axis(axis, 4), 4, text(name, 256, buf)?)
            }
            AxisReadByName { channel, axis, name } => {
                (SDA, ReadWrite, decoder(channel), of_axis(axis, 5), 2048, text(name, 256, buf)?)
            }
            AxisWriteByName { channel, axis, name, value } => {
                (SDA, Write, decoder(channel), of_axis(axis, 6), 0, text_value(name, value, buf)?)
            }
            CountDynamic { channel, kind } => {
                (SDA, Read, decoder(channel), 2 + u32::from(kind), 4, &[][..])
            }
            DynamicNameByIndex { channel, kind, index } => {
                (SDA, ReadWrite, decoder(channel), of_kind(kind, 0x1B), 96, from_one(index, buf)?)
            }
            DynamicValueByName { channel, kind, name } => {
                (SDA, ReadWrite, decoder(channel), of_kind(kind, 0x1C), 8, text(name, 96, buf)?)
            }
            DynamicValueByIndex { channel, kind, index } => {
                (SDA, ReadWrite, decoder(channel), of_kind(kind, 0x1D), 8, from_one(index, buf)?)
            }
            FindInstance { group, channel, axis } => {
                let out = room(buf, 8)?;
                out[..4].copy_from_slice(&channel.to_le_bytes());
                out[4..].copy_from_slice(&axis.to_le_bytes());
                (SDA, ReadWrite, group, 0, 8, &out[..])
            }
            CountElements { group, offset } => (SDA, Read, group, offset, 4, &[][..]),
            ReadElement { group, offset, length } => (SDA, Read, group, offset, length, &[][..]),
            WriteElement { group, offset, content } => {
                (SDA, Write, group, offset, 0, bytes(content, 0, 0x40_0000, buf)?)
            }
            ReadElementName { group, offset } => (SDA, Read, group, offset, 256, &[][..]),
            ReadElementType { group, offset } => (SDA, Read, group, offset, 256, &[][..]),
            ReadElementLength { group, offset } => (SDA, Read, group, offset, 4, &[][..]),
            ReadElementUnit { group, offset } => (SDA, Read, group, offset, 256, &[][..]),
            ReadElementWriteFlag { group, offset } => (SDA, Read, group, offset, 1, &[][..]),
            WriteProgramStream { channel, packet } => {
                let group = 0x12_0100 | u32::from(channel);
                (COM, Write, group, 0x90, 0, bytes(packet, 1, 992, buf)?)
            }
            ReadObject { group, offset, length } => (COM, Read, group, offset, length, &[][..]),
            WriteObject { group, offset, content } => {
                (COM, Write, group, offset, 0, bytes(content, 0, 0x40_0000, buf)?)
            }
        };
        Ok(Call { port, service, index_group, index_offset, read_length, data })
    }
}

fn at_most(len: usize, max: usize) -> Result<usize, Fault> {
    match len > max {
        true => Err(Fault::TooLong { max: max as u32, found: len as u32 }),
        false => Ok(len),
    }
}

fn bytes<'b>(bytes: &[u8], min: usize, max: usize, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
    if bytes.len() < min {
        return Err(Fault::Truncated { at: 0, expected: min as u32, found: 0 });
    }
    let out = room(buf, at_most(bytes.len(), max)?)?;
    out.copy_from_slice(bytes);
    Ok(out)
}

fn text<'b>(text: &[u8], max: usize, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
    let out = room(buf, at_most(text.len() + 1, max)?)?;
    out[..text.len()].copy_from_slice(text);
    out[text.len()] = 0;
    Ok(out)
}

fn index_kind<'b>(index: u32, kind: &[u8], buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
    let out = room(buf, 4 + at_most(kind.len() + 1, 256)?)?;
    out[..4].copy_from_slice(&index.to_le_bytes());
    out[4..][..kind.len()].copy_from_slice(kind);
    out[4 + kind.len()] = 0;
    Ok(out)
}

fn of_handle<'b>(
    handle: u32,
    indices: &[u32],
    value: &[u8],
    buf: &'b mut [u8],
) -> Result<&'b [u8], Fault> {
    let values = 8 + 4 * indices.len();
    let out = room(buf, at_most(values + value.len(), 2048)?)?;
    out[..4].copy_from_slice(&handle.to_le_bytes());
    out[4..8].copy_from_slice(&(indices.len() as u32).to_le_bytes());
    for (number, out) in indices.iter().zip(out[8..].chunks_exact_mut(4)) {
        out.copy_from_slice(&number.to_le_bytes());
    }
    out[values..].copy_from_slice(value);
    Ok(out)
}

fn text_value<'b>(text: &[u8], value: &[u8], buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
    at_most(text.len() + 1, 256)?;
    let out = room(buf, at_most(text.len() + 1 + value.len(), 2048)?)?;
    out[..text.len()].copy_from_slice(text);
    out[text.len()] = 0;
    out[text.len() + 1..].copy_from_slice(value);
    Ok(out)
}

fn from_one(number: u32, buf: &mut [u8]) -> Result<&[u8], Fault> {
    if number == 0 {
        return Err(Fault::OutOfRange { at: 0, expected: 1, found: 0 });
    }
    let out = room(buf, 4)?;
    out.copy_from_slice(&number.to_le_bytes());
    Ok(out)
}
