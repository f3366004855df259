//! The IDs of all requirements and of their parts, as constants.
//!
//! A program that cites a requirement that does not exist fails to compile:
//!
//! ```
//! use ads_cnc_vectors::{clause, ids};
//!
//! let cited = clause(ids::VAR_9_1.as_str()).unwrap();
//! assert_eq!((cited.id(), cited.requirement.id.as_str()), ("VAR-9.1", "VAR-9"));
//! ```
//!
//! ```compile_fail,E0425
//! let cited = ads_cnc_vectors::ids::VAR_99;
//! ```

use crate::catalogue::ClauseId;

include!(concat!(env!("OUT_DIR"), "/ids.rs"));
