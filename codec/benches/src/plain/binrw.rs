//! Descriptors and descriptions declared with binrw, which reads from a cursor.

use binrw::io::Cursor;
use binrw::{BinRead, BinResult, binread, helpers::until_eof};

#[allow(dead_code, reason = "what is read is only looked at by the optimiser")]
#[binread]
#[br(little)]
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

#[binread]
#[br(little)]
struct Descriptors {
    #[br(parse_with = until_eof)]
    list: Vec<Descriptor>,
}

pub(crate) fn descriptors(bytes: &[u8]) -> BinResult<Vec<Descriptor>> {
    Descriptors::read(&mut Cursor::new(bytes)).map(|Descriptors { list }| list)
}

#[allow(dead_code, reason = "what is read is only looked at by the optimiser")]
#[binread]
#[br(little)]
pub(crate) struct Description {
    handle: u32,
    var_type: u32,
    access: u32,
    size: u32,
    #[br(temp)]
    dimension_count: u32,
    #[br(count = dimension_count)]
    dimensions: Vec<u32>,
    #[br(parse_with = until_eof)]
    name: Vec<u8>,
}

pub(crate) fn description(bytes: &[u8]) -> BinResult<Description> {
    Description::read(&mut Cursor::new(bytes))
}
