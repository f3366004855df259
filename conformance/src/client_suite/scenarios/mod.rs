//! All scenarios of a client.

mod elements;
mod objects;
mod printed;
mod reactions;
mod service;
mod streaming;
mod variables;

use super::Scenario;

/// All scenarios, in their order.
pub fn scenarios() -> Vec<Scenario> {
    let mut all = objects::scenarios();
    all.extend(variables::scenarios());
    all.extend(elements::scenarios());
    all.extend(streaming::scenarios());
    all.extend(service::scenarios());
    all.extend(printed::scenarios());
    all.extend(reactions::scenarios());
    all
}
