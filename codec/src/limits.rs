//! Maximum lengths and counts, and fixed lengths. Most are taken from the declarations of the
//! streams.

use crate::ads::{AmsTcpHeader, HeaderLayout};
use crate::bytes::to_usize;
use crate::com::DescriptorLayout;
use crate::dynamic::DynamicNameRef;
use crate::layout::{ADS_DATA, Declared};
use crate::streaming::ProgramStreamRef;
use crate::{
    DescriptionByNameRef, DescriptionRef, HandleReadRef, HandleWriteRef, NameWriteRef, ValueRef,
    VariableIndexKindRef, VariableNameRef,
};

/// The maximum length of a stream in bytes.
pub(crate) const fn length<T: Declared>() -> usize {
    to_usize(T::LAYOUT.max)
}

/// The maximum length of a field in bytes, or number of items of a list.
pub(crate) const fn most<T: Declared>(field: &str) -> usize {
    to_usize(T::LAYOUT.most(field))
}

/// Maximum number of bytes of the name or kind of a variable in a request: 255 characters and the
/// NUL (VAR-1, VAR-9).
pub const TEXT_MAX: usize = length::<VariableNameRef<'_>>();
/// Maximum number of characters of the name of a variable in a request, without the NUL (VAR-9).
pub const NAME_MAX: usize = TEXT_MAX.saturating_sub(1);
/// Maximum number of bytes of a request with index and kind (VAR-3).
pub const INDEX_KIND_MAX: usize = length::<VariableIndexKindRef<'_>>();
/// Maximum number of bytes of a stream with a description, a handle and indices, or a value (VAR-4,
/// VAR-11, VAR-14).
pub const VARIABLE_MAX: usize = length::<ValueRef<'_>>();
/// Maximum number of bytes of a value written by handle (VAR-12).
pub const HANDLE_VALUE_MAX: usize = most::<HandleWriteRef<'_>>("value");
/// Maximum number of bytes of a value written by name (VAR-13).
pub const NAME_VALUE_MAX: usize = most::<NameWriteRef<'_>>("value");
/// Maximum number of dimensions of a description by index, which also contains a name field of at
/// least one byte (VAR-24).
pub const DIMENSIONS_MAX: usize = most::<DescriptionRef<'_>>("dimensions");
/// Maximum number of dimensions of a description by name, which contains no name (VAR-24, VAR-28).
pub const NAMELESS_DIMENSIONS_MAX: usize = most::<DescriptionByNameRef<'_>>("dimensions");
/// Maximum number of indices after a handle (VAR-24).
pub const INDICES_MAX: usize = most::<HandleReadRef<'_>>("indices");
/// Maximum number of bytes of the name of a dynamic parameter, including the NUL if there is one
/// (assumed, DYN-6).
pub const DYNAMIC_NAME_MAX: usize = length::<DynamicNameRef<'_>>();
/// Maximum number of bytes of a text of the Service Interface, including the NUL (assumed, SVC-1).
pub const SERVICE_TEXT_MAX: usize = 128;
/// Number of bytes of an object descriptor (COM-2).
pub const DESCRIPTOR_LEN: usize = length::<DescriptorLayout>();
/// Number of bytes of the name, and of the type, in an object descriptor (COM-2).
pub const DESCRIPTOR_TEXT_LEN: usize = most::<DescriptorLayout>("name");
/// Maximum number of data bytes of an ADS request or reply. The manuals document no limit; this value is
/// assumed.
pub const ADS_DATA_MAX: usize = to_usize(ADS_DATA);
/// Number of bytes of the AMS/TCP header (ADS-5).
pub const AMS_TCP_HEADER_LEN: usize = length::<AmsTcpHeader>();
/// Number of bytes of the AMS header (ADS-5).
pub const AMS_HEADER_LEN: usize = length::<HeaderLayout>();
/// Maximum number of bytes of one write to the program stream, MAX_PROGRAM_STREAM_INPUT_SIZE (STM-2).
pub const STREAM_PACKET_MAX: usize = length::<ProgramStreamRef<'_>>();
/// Maximum number of bytes that are written to the program stream but not read by the CNC yet,
/// MAX_PROGRAM_STREAM_SIZE (assumed, STM-3).
pub const STREAM_MAX: usize = 4094;
/// Maximum number of characters of a line in the program stream: a packet without CR LF (STM-20).
pub const NC_LINE_MAX: usize = STREAM_PACKET_MAX.saturating_sub(2);
