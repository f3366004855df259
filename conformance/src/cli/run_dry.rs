//! `ads-cnc run --dry-run`: lists functions, not requests, because requests depend on earlier
//! replies.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::io::{self, Write};

use ads_cnc::operation::{Effect, Function};

use crate::gate::Allowed;
use crate::profile::{Claim, Profile};

/// Lists the functions that a run requests from a device with this profile, and what it may write.
pub(super) fn list(
    profile: &Profile,
    allowed: Option<&Allowed>,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out)?;
    writeln!(
        out,
        "The suite asks what the profile claims, as often as there is something to ask for:"
    )?;
    let claimed = || Function::ALL.iter().copied().filter(|one| profile.claims(*one) != Claim::No);
    let queries = claimed().filter(|function| function.spec().effect == Effect::Query);
    for spec in queries.map(Function::spec) {
        let (service, port) = (spec.service.to_string(), spec.task.port().0);
        writeln!(out, "  {service:<9}  port {port}  {} ({})", spec.name, spec.clause)?;
    }
    writeln!(out, "  and once at each of these ports ReadDeviceInfo and ReadState")?;
    match allowed {
        None => writeln!(out, "It writes nothing without a file for --allow-write.")?,
        Some(allowed) => {
            writeln!(out, "It writes, and restores, only what the file for --allow-write names:")?;
            for entry in &allowed.entries {
                for line in entry.to_string().lines() {
                    writeln!(out, "  {line}")?;
                }
            }
        }
    }
    writeln!(
        out,
        "Which requests that makes, the device's answers decide; to see them for the simulated CNC, \
         run the\nsuite with --capture against ads-cnc serve."
    )
}
