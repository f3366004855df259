//! Checks of a request and its reply, alone and together with earlier exchanges, by the manuals'
//! clauses.
//!
//! `ads-cnc check` applies these checks to captured traffic. `ads-cnc run` applies the checks of
//! replies to every reply that a case receives from a target with `Probe::call`, if the frame of
//! the reply violates no rule of AMS/TCP. With `--client` or `--client-listen`, it applies the
//! checks of requests to the requests of a client. A `RuleBook` records the checks by `Topic`.

mod book;
mod elements;
mod knowledge;
mod objects;
mod observation;
mod parameters;
mod replies;
mod requests;
mod service;
mod streaming;
mod topic;
mod values;
mod variables;

use ads_cnc::ads::Command;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

pub(crate) use self::book::RuleBook;
pub(crate) use self::elements::{
    check_group, check_length, check_offset, check_type, element_type,
};
pub(crate) use self::knowledge::TargetVariable;
pub(crate) use self::objects::check_descriptor;
pub(crate) use self::observation::Observation;
pub(crate) use self::requests::function_at;
pub(crate) use self::topic::{Topic, captured_cases, reply_cases};
pub(crate) use self::variables::{check_description, check_extended, element_count};
use crate::ads_service;

/// The requirement of the service with this command; ADS-5 for a command of another service.
pub(crate) fn service_clause(command: Command) -> ClauseId {
    ads_service::service_of(command).map_or(ADS_5, ads_service::clause)
}
