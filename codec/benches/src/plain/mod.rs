//! Descriptors and descriptions declared with binrw and with deku, in the style of their
//! documentation, to compare their speed with that of the codec.

pub(crate) mod binrw;
pub(crate) mod deku;
