//! What the tests of all streams share: samples, the readings of each stream, and the laws that
//! hold for them. The fuzz targets hold streams to the same laws through this same file.

#![allow(dead_code, unused_imports, reason = "no test uses all of it")]
#![allow(unexpected_cfgs, reason = "the fuzz targets have not all features of the codec")]

mod calls;
mod laws;
mod samples;
mod samples_ads;
mod samples_elements;
mod subjects;
mod typed;

pub(crate) use calls::{CALLS, CallSample};
pub(crate) use laws::{
    Bend, Fault, check, check_bent, check_call, check_call_bent, check_reply, check_request,
};
#[cfg(feature = "alloc")]
pub(crate) use laws::{check_value, check_value_bent};
pub(crate) use samples::{SAMPLES, Sample, each_sample};
#[cfg(feature = "arbitrary")]
pub(crate) use subjects::made;
pub(crate) use subjects::{Reading, SUBJECTS, Subject};
pub(crate) use typed::check_typed;
