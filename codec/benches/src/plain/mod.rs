//! Declarations of streams as the documentation of binrw and deku shows them, without the codec.

pub(crate) mod binrw;
pub(crate) mod deku;
