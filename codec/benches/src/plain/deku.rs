//! Descriptors and descriptions declared with deku, which reads from a reader.

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

#[allow(dead_code, reason = "what is read is only looked at by the optimiser")]
#[derive(DekuRead)]
#[deku(endian = "little")]
pub(crate) struct Description {
    handle: u32,
    var_type: u32,
    access: u32,
    size: u32,
    dimension_count: u32,
    #[deku(count = "dimension_count")]
    dimensions: Vec<u32>,
    #[deku(read_all)]
    name: Vec<u8>,
}

pub(crate) fn description(bytes: &[u8]) -> Result<Description, DekuError> {
    Description::try_from(bytes)
}
