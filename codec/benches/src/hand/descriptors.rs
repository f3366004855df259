//! Handwritten code for object descriptors.

use super::{Fault, HandWritten, exactly, room, u16_at, u32_at};

#[derive(Clone, Debug)]
pub(crate) struct Descriptor {
    id: u32,
    size: u32,
    write_access: u16,
    not_assigned: u16,
    index_group: u32,
    index_offset: u32,
    name: [u8; 32],
    type_name: [u8; 32],
}

const LEN: usize = 84;
const MAX: usize = 0x40_0000;

impl Descriptor {
    fn read(record: &[u8; LEN]) -> Self {
        let mut object = Self {
            id: u32_at(record, 0),
            size: u32_at(record, 4),
            write_access: u16_at(record, 8),
            not_assigned: u16_at(record, 10),
            index_group: u32_at(record, 12),
            index_offset: u32_at(record, 16),
            name: [0; 32],
            type_name: [0; 32],
        };
        object.name.copy_from_slice(&record[20..52]);
        object.type_name.copy_from_slice(&record[52..]);
        object
    }

    fn put(&self, record: &mut [u8]) {
        record[..4].copy_from_slice(&self.id.to_le_bytes());
        record[4..8].copy_from_slice(&self.size.to_le_bytes());
        record[8..10].copy_from_slice(&self.write_access.to_le_bytes());
        record[10..12].copy_from_slice(&self.not_assigned.to_le_bytes());
        record[12..16].copy_from_slice(&self.index_group.to_le_bytes());
        record[16..20].copy_from_slice(&self.index_offset.to_le_bytes());
        record[20..52].copy_from_slice(&self.name);
        record[52..].copy_from_slice(&self.type_name);
    }
}

impl<'a> HandWritten<'a> for Descriptor {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        exactly(bytes).map(Self::read)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, LEN)?;
        self.put(out);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Descriptors(Vec<Descriptor>);

impl<'a> HandWritten<'a> for Descriptors {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        if bytes.len() > MAX {
            return Err(Fault::TooLong { max: MAX as u32, found: bytes.len() as u32 });
        }
        let (records, rest) = bytes.as_chunks();
        if records.is_empty() || !rest.is_empty() {
            let (at, found) = ((bytes.len() - rest.len()) as u32, rest.len() as u32);
            return Err(Fault::Truncated { at, expected: LEN as u32, found });
        }
        Ok(Self(records.iter().map(Descriptor::read).collect()))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let needed = self.0.len() * LEN;
        if needed == 0 {
            return Err(Fault::Truncated { at: 0, expected: LEN as u32, found: 0 });
        }
        if needed > MAX {
            return Err(Fault::TooLong { max: MAX as u32, found: needed as u32 });
        }
        let out = room(buf, needed)?;
        for (object, record) in self.0.iter().zip(out.chunks_exact_mut(LEN)) {
            object.put(record);
        }
        Ok(out)
    }
}
