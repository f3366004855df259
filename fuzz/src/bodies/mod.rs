//! The bodies of the targets. Each function documents the form of its input and the laws that it
//! checks.

pub(crate) mod bytes;
#[cfg(feature = "alloc")]
pub(crate) mod checker;
#[cfg(feature = "tools")]
pub(crate) mod ends;
pub(crate) mod frames;
pub(crate) mod input;
pub(crate) mod names;
pub(crate) mod operation;
#[cfg(feature = "tools")]
pub(crate) mod service;
pub(crate) mod shapes;
pub(crate) mod streaming;
pub(crate) mod text;
#[cfg(feature = "tools")]
pub(crate) mod tools;
#[cfg(feature = "arbitrary")]
pub(crate) mod values;

pub(crate) use bytes::Family;
