//! Object descriptors by hand.

use super::Fault;

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

const MAX: usize = 0x40_0000;

pub(crate) fn decode(bytes: &[u8]) -> Result<Vec<Descriptor>, Fault> {
    if bytes.len() > MAX {
        return Err(Fault::TooLong { max: MAX as u32, found: bytes.len() as u32 });
    }
    if bytes.is_empty() || !bytes.len().is_multiple_of(84) {
        let whole = bytes.len() / 84 * 84;
        let found = (bytes.len() - whole) as u32;
        return Err(Fault::Truncated { at: whole as u32, expected: 84, found });
    }
    let u16_at = |record: &[u8], at: usize| u16::from_le_bytes([record[at], record[at + 1]]);
    let u32_at = |record: &[u8], at: usize| {
        u32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]])
    };
    let mut list = Vec::with_capacity(bytes.len() / 84);
    for record in bytes.chunks_exact(84) {
        let mut object = Descriptor {
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
        object.type_name.copy_from_slice(&record[52..84]);
        list.push(object);
    }
    Ok(list)
}

pub(crate) fn encode<'b>(list: &[Descriptor], buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
    let (needed, found) = (list.len() * 84, buf.len() as u32);
    if list.is_empty() {
        return Err(Fault::Truncated { at: 0, expected: 84, found: 0 });
    }
    if needed > MAX {
        return Err(Fault::TooLong { max: MAX as u32, found: needed as u32 });
    }
    let Some(out) = buf.get_mut(..needed) else {
        return Err(Fault::BufferTooSmall { expected: needed as u32, found });
    };
    for (object, record) in list.iter().zip(out.chunks_exact_mut(84)) {
        record[0..4].copy_from_slice(&object.id.to_le_bytes());
        record[4..8].copy_from_slice(&object.size.to_le_bytes());
        record[8..10].copy_from_slice(&object.write_access.to_le_bytes());
        record[10..12].copy_from_slice(&object.not_assigned.to_le_bytes());
        record[12..16].copy_from_slice(&object.index_group.to_le_bytes());
        record[16..20].copy_from_slice(&object.index_offset.to_le_bytes());
        record[20..52].copy_from_slice(&object.name);
        record[52..84].copy_from_slice(&object.type_name);
    }
    Ok(out)
}
