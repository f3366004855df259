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

/// Lists the queries that a run may send to a device with this profile, and its allowed writes.
/// `has_file`: whether --profile is given; otherwise, the run first queries the device for its
/// ports, channels, axes and spindles.
pub(super) fn list(
    profile: &Profile,
    has_file: bool,
    allowed: Option<&Allowed>,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out)?;
    writeln!(
        out,
        "The suite requests these functions of the profile, once for each item of the device:"
    )?;
    if !has_file {
        writeln!(
            out,
            "(without --profile, it first searches with the same functions for the ports, the \
             channels 1 to\n255, the axes and the spindles, and then requests what it found)"
        )?;
    }
    let claimed = || Function::ALL.iter().copied().filter(|one| profile.claims(*one) != Claim::No);
    let queries = claimed().filter(|function| function.spec().effect == Effect::Query);
    for spec in queries.map(Function::spec) {
        let (service, port) = (spec.service.to_string(), spec.task.port().0);
        writeln!(out, "  {service:<9}  port {port}  {} ({})", spec.name, spec.clause)?;
        // The cases request the address of an instance at the port of GEO too.
        if spec.name == Function::FindInstance.spec().name && profile.has_port(AmsPort::GEO) {
            let port = AmsPort::GEO.0;
            writeln!(out, "  {service:<9}  port {port}  {} ({})", spec.name, spec.clause)?;
        }
    }
    let ports: Vec<String> = profile.ports.iter().map(ToString::to_string).collect();
    let ports = ports.join(", ");
    writeln!(out, "  and sometimes ReadDeviceInfo and ReadState at the ports {ports}")?;
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
        "The requests depend on the replies of the device. To see the requests to the simulated \
         CNC, run the\nsuite with --capture against ads-cnc serve."
    )
}
