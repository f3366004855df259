//! The samples of streams and calls that are written by hand for the tests of the codec.

#![allow(dead_code, reason = "written for other tests")]

#[path = "../../../../tests/common/calls.rs"]
mod calls;
#[path = "../../../../tests/common/samples.rs"]
mod samples;
#[path = "../../../../tests/common/samples_ads.rs"]
mod samples_ads;
#[path = "../../../../tests/common/samples_elements.rs"]
mod samples_elements;

pub(crate) use calls::CALLS;
pub(crate) use samples::{SAMPLES, Sample};
