//! The bodies: each reads an input its own way and holds what it finds to a law.

pub(crate) mod bytes;
pub(crate) mod operation;
#[cfg(feature = "arbitrary")]
pub(crate) mod values;

pub(crate) use bytes::Family;
