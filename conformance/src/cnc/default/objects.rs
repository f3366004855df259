//! COM objects of the default model.

use ads_cnc::address::{
    Access, Addressing, AxisStride, ComGroup, ComTable, IndexGroup, IndexOffset,
};
use ads_cnc::{Descriptor, Descriptors, Error, WriteAccess};

/// Name, type, bytes, whether writable, element.
type Row = (&'static str, &'static str, u32, bool, u32);

/// The sixteenth is the printed descriptor, the one behind it the other printed name.
const CHANNEL_1: &[Row] = &[
    ("example_bool_r", "BOOL", 1, false, 0x10),
    ("example_byte_r", "BYTE", 1, false, 0x11),
    ("example_sint_w", "SINT", 1, true, 0x12),
    ("example_word_r", "WORD", 2, false, 0x13),
    ("example_int_w", "INT", 2, true, 0x14),
    ("example_dword_r", "DWORD", 4, false, 0x15),
    ("example_dint_w", "DINT", 4, true, 0x16),
    ("example_lword_r", "LWORD", 8, false, 0x17),
    ("example_lint_w", "LINT", 8, true, 0x18),
    ("example_real_r", "REAL", 4, false, 0x19),
    ("example_lreal_w", "LREAL", 8, true, 0x1A),
    ("example_string_r", "STRING", 21, false, 0x1B),
    // All 32 bytes of the name, so no NUL behind it.
    ("example_name_of_32_characters__r", "BOOL", 1, false, 0x1C),
    // A STRING of another length than the one above.
    ("example_long_string_w", "STRING", 128, true, 0x1D),
    ("example_L\u{e4}nge_r", "LREAL", 8, false, 0x1E),
    ("mc_active_single_block_r", "BOOL", 1, false, 0x3),
    ("mc_command_single_block_w", "BOOL", 1, true, 0x1),
];

const CHANNEL: &[Row] = &[
    ("mc_active_single_block_r", "BOOL", 1, false, 0x3),
    ("mc_command_single_block_w", "BOOL", 1, true, 0x1),
];

const PLATFORM: &[Row] = &[
    ("example_platform_cycle_time_r", "DWORD", 4, false, 0x251),
    ("example_platform_channels_r", "WORD", 2, false, 0x252),
];

const AXIS: &[Row] =
    &[("example_position_r", "LREAL", 8, false, 1), ("example_enable_w", "BOOL", 1, true, 2)];

/// Makes descriptors of rows, with IDs from `id` on.
fn list(
    id: u32,
    rows: &'static [Row],
    at: impl Fn(u32) -> Result<(IndexGroup, IndexOffset), Error>,
) -> impl Iterator<Item = Result<Descriptor, Error>> {
    (id..).zip(rows).map(move |(id, &(name, type_name, size, writable, element))| {
        let (group, offset) = at(element)?;
        let access = if writable { WriteAccess::WRITABLE } else { WriteAccess::READ_ONLY };
        Ok(Descriptor::new(name, type_name)?
            .with_id(id)
            .with_size(size)
            .with_write_access(access)
            .with_content(group, offset))
    })
}

/// The group of the content of a channel, of the platform (0), or of the platform's axes.
fn content(table: ComTable, instance: u8) -> IndexGroup {
    let (addressing, access) = (Addressing::Logical, Access::Element);
    ComGroup { addressing, access, table, instance }.index_group()
}

/// Objects of a channel and, behind them, of its three axes.
pub(super) fn of_channel(number: u8) -> Result<Descriptors, Error> {
    let group = content(ComTable::Channel, number);
    // The printed ID of the sixteenth object of channel 1 is 82.
    let (rows, id) = match number {
        1 => (CHANNEL_1, 67),
        _ => (CHANNEL, u32::from(number).saturating_mul(1000)),
    };
    let own = list(id, rows, move |element| Ok((group, IndexOffset::new(element))));
    let axes = (1_u32..=3).flat_map(move |axis| {
        let id = id.saturating_add(axis.saturating_mul(100));
        list(id, AXIS, move |element| Ok((group, axis_offset(axis, element)?)))
    });
    own.chain(axes).collect()
}

pub(super) fn of_platform() -> Result<Descriptors, Error> {
    let group = content(ComTable::Channel, 0);
    list(10_000, PLATFORM, move |element| Ok((group, IndexOffset::new(element)))).collect()
}

/// Their content is at 0x120200 with the axis in the offset, as the example has it, not the
/// table (E-04).
pub(super) fn of_platform_axis(axis: u32) -> Result<Descriptors, Error> {
    let group = content(ComTable::Axis, 0);
    let id = axis.saturating_mul(100).saturating_add(20_000);
    list(id, AXIS, move |element| Ok((group, axis_offset(axis, element)?))).collect()
}

fn axis_offset(axis: u32, element: u32) -> Result<IndexOffset, Error> {
    IndexOffset::of_axis(AxisStride::X10000, axis, element)
}
