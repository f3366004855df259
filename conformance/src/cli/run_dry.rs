//! `ads-cnc run --dry-run`: lists functions, not requests, because requests depend on earlier
//! replies.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::io::{self, Write};

use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{Effect, Function};

use crate::gate::Allowed;
use crate::profile::{Claim, Profile};

/// Lists the functions that a run requests from a device with this profile, and what it may write.
/// Without a file for the profile the run asks first what there is.
pub(super) fn list(
    profile: &Profile,
    has_file: bool,
    allowed: Option<&Allowed>,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out)?;
    writeln!(
        out,
        "The suite asks what the profile claims, as often as there is something to ask for:"
    )?;
    if !has_file {
        writeln!(
            out,
            "(no --profile: it first asks by the same functions which ports, channels 1 to 255, axes \
             and\nspindles there are, and then what it found)"
        )?;
    }
    let claimed = || Function::ALL.iter().copied().filter(|one| profile.claims(*one) != Claim::No);
    let queries = claimed().filter(|function| function.spec().effect == Effect::Query);
    for spec in queries.map(Function::spec) {
        let (service, port) = (spec.service.to_string(), spec.task.port().0);
        writeln!(out, "  {service:<9}  port {port}  {} ({})", spec.name, spec.clause)?;
        // GEO has to answer too, and serves the queries of the classes.
        if spec.name == Function::FindInstance.spec().name && profile.has_port(AmsPort::GEO) {
            let port = AmsPort::GEO.0;
            writeln!(out, "  {service:<9}  port {port}  {} ({})", spec.name, spec.clause)?;
        }
    }
    let ports: Vec<String> = profile.ports.iter().map(ToString::to_string).collect();
    let ports = ports.join(", ");
    writeln!(out, "  and a few times ReadDeviceInfo and ReadState at the ports {ports}")?;
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
