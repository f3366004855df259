//! Cases of index groups and ports, and of the frames that carried all others.

use ads_cnc::Kind;
use ads_cnc::address::Channel;
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{Call, CountObjects, CountVariables, Request};

use super::case::{Case, Step, Stop, assumed};
use super::declare;
use super::probe::{Probe, harness};

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "adr-com-object-access",
            "Each channel's object list is at 0x130100 + channel, on the port of COM",
            ["ADR-3", "ADR-4", "GEN-4"],
            Queries,
            com_object_access
        ),
        declare!(
            "adr-decoder-group",
            "Each channel's variables are at 0x122300 + channel, on the port of SDA",
            ["ADR-5", "GEN-4", "GEN-6"],
            Queries,
            decoder_group
        ),
        declare!(
            "adr-logical-and-by-index",
            "A channel answers the same by its number and by its rank",
            ["ADR-1", "ADR-12"],
            Queries,
            logical_and_by_index
        ),
        declare!(
            "adr-rank-among-active",
            "By index, channels are counted without gaps",
            ["ADR-11"],
            Queries,
            rank_among_active
        ),
        declare!(
            "adr-geo-answers-too",
            "GEO and SDA both answer for a class of the CNC",
            ["ADR-10"],
            Queries,
            geo_answers_too
        ),
        declare!(
            "adr-absent-channel",
            "A channel that is not configured is answered by an error",
            ["ADS-4", "GEN-6"],
            Queries,
            absent_channel
        ),
    ]
}

pub(super) fn frame_cases() -> Vec<Case> {
    vec![declare!(
        "ads-every-frame",
        "Every frame of this run has the header and the length its request asks for",
        ["ADS-1", "ADS-3", "ADS-5"],
        Queries,
        every_frame
    )]
}

fn com_object_access(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let data = probe.ask("ADR-4", CountObjects::new(channel))?;
        probe.check("ADR-3", !data.is_empty(), "the number of the channel's objects", "no byte");
        probe.check("GEN-4", true, "", "");
    }
    Ok(())
}

fn decoder_group(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let data = probe.ask("ADR-5", CountVariables::new(channel, Kind::V_E))?;
        probe.check("GEN-6", !data.is_empty(), "the number of the channel's variables", "no byte");
        // That SDA has 552 is online knowledge; the group itself is stated.
        probe.check("GEN-4", true, "", "");
    }
    Ok(())
}

/// Rank and number of each claimed channel.
fn ranks(probe: &Probe<'_>) -> Step<Vec<(Channel, Channel)>> {
    let channels = probe.channels()?;
    (1..)
        .zip(channels)
        .map(|(rank, channel)| Ok((Channel::by_index(rank).map_err(harness)?, channel)))
        .collect()
}

fn same_by_rank(probe: &mut Probe<'_>, rule: &'static str, rank: Channel, number: Channel) -> Step {
    let name = format!("the answer of channel {}", number.number());
    let pairs: [[Request<'_>; 2]; 2] = [
        [CountObjects::new(number).into(), CountObjects::new(rank).into()],
        [
            CountVariables::new(number, Kind::ALL).into(),
            CountVariables::new(rank, Kind::ALL).into(),
        ],
    ];
    for [logical, by_index] in pairs {
        let logical = probe.ask(rule, logical)?;
        let by_index = probe.ask(rule, by_index)?;
        let found = format!("{by_index:02x?}");
        probe.check(rule, by_index == logical, format!("{name}, {logical:02x?}"), found);
    }
    Ok(())
}

fn logical_and_by_index(probe: &mut Probe<'_>) -> Step {
    for (rank, number) in ranks(probe)? {
        same_by_rank(probe, "ADR-1", rank, number)?;
        probe.check("ADR-12", true, "", "");
    }
    Ok(())
}

fn rank_among_active(probe: &mut Probe<'_>) -> Step {
    let ranks = ranks(probe)?;
    let gap = ranks.iter().find(|(rank, number)| rank.number() != number.number());
    let Some(&(rank, number)) = gap else {
        let why = "every channel's number is its rank";
        return Err(Stop::NotApplicable(why.to_owned()));
    };
    same_by_rank(probe, "ADR-11", rank, number)?;
    // Its number is no rank: there are not so many channels.
    let beyond = Channel::by_index(number.number().into()).map_err(harness)?;
    probe.refuses(
        "ADR-11",
        "a rank beyond the last channel",
        CountVariables::new(beyond, Kind::V_E),
        CountVariables::new(rank, Kind::V_E),
    )
}

fn geo_answers_too(probe: &mut Probe<'_>) -> Step {
    let request = Request::from(CountVariables::new(probe.channel()?, Kind::V_E));
    let mut buf = [0; 256];
    let sda = request.encode(&mut buf).map_err(harness)?;
    let geo = Call { port: AmsPort::GEO, ..sda };
    let by_sda = probe.call(&sda)?;
    let by_geo = probe.call(&geo)?;
    let data = by_sda.answer().and_then(|answer| answer.data.clone());
    let same = by_geo.answer().and_then(|answer| answer.data.clone()) == data && data.is_some();
    probe.check(assumed("ADR-10"), same, by_sda.result(), by_geo.result());
    Ok(())
}

fn absent_channel(probe: &mut Probe<'_>) -> Step {
    let Some(number) = probe.session.profile.absent_channel else {
        let why = "no channel is known to be absent";
        return Err(Stop::NotApplicable(why.to_owned()));
    };
    let absent = Channel::new(number).map_err(harness)?;
    let present = probe.channel()?;
    let what = format!("channel {number}, which is not configured");
    probe.refuses(
        "ADS-4",
        &what,
        CountVariables::new(absent, Kind::V_E),
        CountVariables::new(present, Kind::V_E),
    )?;
    probe.refuses("ADS-4", &what, CountObjects::new(absent), CountObjects::new(present))?;
    probe.check("GEN-6", true, "", "");
    Ok(())
}

fn every_frame(probe: &mut Probe<'_>) -> Step {
    if probe.session.frames == 0 {
        return Err(Stop::Inconclusive("no frame was exchanged".to_owned()));
    }
    let violations = std::mem::take(&mut probe.session.violations);
    for requirement in ["ADS-1", "ADS-3", "ADS-5"] {
        let mut broken = violations
            .iter()
            .filter(|(violation, _)| violation.requirement == requirement)
            .peekable();
        if broken.peek().is_none() {
            probe.check(requirement, true, "", "");
        }
        for (violation, evidence) in broken {
            probe.show(Some(evidence.clone()));
            probe.check(requirement, false, "a frame as required", &violation.what);
        }
    }
    Ok(())
}
