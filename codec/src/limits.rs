//! The named maxima that every length and count is checked against.

/// Bytes of a text request with its NUL: 255 characters and the NUL (VAR-1, VAR-9).
pub const TEXT_MAX: usize = 256;
/// Characters of a variable's name, which a request ends with a NUL (VAR-9).
pub const NAME_MAX: usize = 255;
/// Bytes of an index-and-kind request (VAR-3).
pub const INDEX_KIND_MAX: usize = 260;
/// Bytes of a variable stream: description, handle header, value (VAR-4, VAR-11, VAR-14).
pub const VARIABLE_MAX: usize = 2048;
/// Bytes of a value that is written by handle (VAR-12).
pub const HANDLE_VALUE_MAX: usize = 2040;
/// Bytes of a value that is written by name (VAR-13).
pub const NAME_VALUE_MAX: usize = 2047;
/// Dimensions of a description beside a name of one NUL (VAR-24).
pub const DIMENSIONS_MAX: usize = 506;
/// Dimensions of a description without a name (VAR-24, VAR-28).
pub const NAMELESS_DIMENSIONS_MAX: usize = 507;
/// Indices of a handle header (VAR-24).
pub const INDICES_MAX: usize = 510;
/// Bytes of a dynamic parameter's name; that the NUL counts among them is assumed (DYN-6).
pub const DYNAMIC_NAME_MAX: usize = 96;
/// Bytes of a text of the Service Interface, the NUL counted, which is assumed (SVC-1).
pub const SERVICE_TEXT_MAX: usize = 128;
/// Bytes of an object descriptor (COM-2).
pub const DESCRIPTOR_LEN: usize = 84;
/// Bytes of the name and of the type in an object descriptor (COM-2).
pub const DESCRIPTOR_TEXT_LEN: usize = 32;
/// Data bytes of one ADS request or reply that this crate takes. Nobody documents a limit: assumed.
pub const ADS_DATA_MAX: usize = 0x40_0000;
/// Bytes of the AMS/TCP header (ADS-5).
pub const AMS_TCP_HEADER_LEN: usize = 6;
/// Bytes of the AMS header (ADS-5).
pub const AMS_HEADER_LEN: usize = 32;
/// Bytes of one write to the stream, MAX_PROGRAM_STREAM_INPUT_SIZE (STM-2).
pub const STREAM_PACKET_MAX: usize = 992;
/// Bytes the stream's interface holds, MAX_PROGRAM_STREAM_SIZE (STM-3).
pub const STREAM_MAX: usize = 4094;
/// Characters of a line that is streamed: a packet without CR LF (STM-20).
pub const NC_LINE_MAX: usize = 990;
