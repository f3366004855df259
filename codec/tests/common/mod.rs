//! Common code of the tests, such as samples, the types of the streams, and laws: functions that
//! check properties for given inputs. The crate of the fuzz targets includes this file, so that the
//! fuzz targets can check the same laws.

#![allow(dead_code, unused_imports, reason = "no test uses all of it")]
#![allow(unexpected_cfgs, reason = "the fuzz targets have not all features of the codec")]

mod calls;
#[cfg(feature = "alloc")]
pub(crate) mod checker;
mod faults;
#[cfg(feature = "alloc")]
pub(crate) mod findings;
mod frames;
mod laws;
pub(crate) mod machines;
pub(crate) mod names;
mod operations;
mod samples;
mod samples_ads;
mod samples_elements;
pub(crate) mod shapes;
pub(crate) mod streaming;
mod subjects;
pub(crate) mod text;
mod typed;

pub(crate) use calls::{CALLS, CallSample};
pub(crate) use faults::{Fault, fault, fault_of};
pub(crate) use frames::{
    Frames, SPLIT, Split, check_frames, check_split, check_verdicts_stay, frame, frame_header,
};
pub(crate) use laws::{
    Mutation, check, check_bent, check_call, check_call_bent, check_reply, check_reply_bent,
    check_request,
};
#[cfg(feature = "alloc")]
pub(crate) use laws::{check_value, check_value_bent};
pub(crate) use operations::{Parameters, check_made, check_operation};
pub(crate) use samples::{SAMPLES, Sample, each_sample};
#[cfg(feature = "arbitrary")]
pub(crate) use subjects::made;
pub(crate) use subjects::{SUBJECTS, StreamType, Subject};
pub(crate) use typed::check_typed;
