//! deku, over its own reader.

use deku::prelude::*;

#[allow(dead_code, reason = "what is read is only looked at by the optimiser")]
#[derive(DekuRead)]
#[deku(endian = "little")]
pub(crate) struct Descriptor {
    pub(crate) id: u32,
    pub(crate) size: u32,
    pub(crate) write_access: u16,
    pub(crate) not_assigned: u16,
    pub(crate) index_group: u32,
    pub(crate) index_offset: u32,
    pub(crate) name: [u8; 32],
    pub(crate) type_name: [u8; 32],
}

#[derive(DekuRead)]
struct Descriptors {
    #[deku(read_all)]
    list: Vec<Descriptor>,
}

pub(crate) fn descriptors(bytes: &[u8]) -> Result<Vec<Descriptor>, DekuError> {
    Descriptors::try_from(bytes).map(|Descriptors { list }| list)
}
