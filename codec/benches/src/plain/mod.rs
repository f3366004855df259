//! Declarations as the libraries' own documentation has them, without anything of ours.

pub(crate) mod binrw;
pub(crate) mod deku;
