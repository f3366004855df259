//! Declarations as in the documentation of the libraries, without code of this project.

pub(crate) mod binrw;
pub(crate) mod deku;
