//! Malformed requests: the CNC must reply to each, and must not return data with a success. A
//! success without data is accepted as a rejection.
//!
//! For some of these requests, no manual states that a CNC rejects them, so their checks are
//! `assumed`: returned data does not fail a device, but a missing reply does. The other checks have
//! the level of their clause, such as ADS-4: a result of 0 means success.

use ads_cnc::address::{Class, IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{
    AdsService, CountObjects, CountVariables, DescribeByIndex, Function, GroupRule, HandleByName,
    ObjectList, ReadByHandle, ReadByName, ReadDescriptors, Request,
};
use ads_cnc::{Kind, TextRef, U32List};
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, RawCall};
use super::row::{CaseRow, case};
use crate::judge::{Needs, OrStop as _, Rules, Step, assumed};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("bad-kind", &[VAR_1], Needs::Malformed, bad_kind,
        "A kind with a final dot, without NUL, unknown or too long returns an error"),
    case("bad-index-kind", &[VAR_3], Needs::Malformed, bad_index_kind,
        "A truncated request by index returns an error"),
    case("bad-name", &[VAR_9], Needs::Malformed, bad_name,
        "A name without NUL, with bytes after it or too long returns an error"),
    case("bad-handle-header", &[VAR_11, VAR_24], Needs::Malformed, bad_handle_header,
        "A truncated handle header, or one with a wrong index count, returns an error"),
    case("bad-address", &[ADS_4], Needs::Malformed, bad_address,
        "An unknown index group, index offset or port returns an error"),
    case("bad-service", &[ADS_4], Needs::Malformed, bad_service,
        "A function that is called by a wrong service returns an error"),
    case("bad-read-length", &[COM_3, ADS_3], Needs::Malformed, bad_read_length,
        "A read length shorter than the reply returns an error"),
];

/// A valid request. The methods send variants of it that must be rejected.
struct MalformedRequest<'p, 's> {
    probe: &'p mut Probe<'s>,
    valid: RawCall,
}

impl<'p, 's> MalformedRequest<'p, 's> {
    fn new<'a>(probe: &'p mut Probe<'s>, request: impl Into<Request<'a>>) -> Step<Self> {
        Ok(Self { probe, valid: RawCall::new(request)? })
    }

    /// Sends the request with other data.
    fn data(&mut self, rules: impl Rules, what: &str, data: &[u8]) -> Step {
        self.call(rules, what, |call| call.data = data.to_vec())
    }

    /// Sends data whose length contradicts its count of indices or exceeds the maximum.
    fn of_other_length(&mut self, what: &str, data: &[u8]) -> Step {
        self.data([VAR_24, VAR_11], what, data)
    }

    /// Sends the request as changed by `spoil`, for example with another address, service or
    /// length.
    fn call(&mut self, rules: impl Rules, what: &str, spoil: impl FnOnce(&mut RawCall)) -> Step {
        self.probe.rejects(rules, what, self.valid.with(spoil), &self.valid)
    }
}

fn bad_kind(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let mut malformed = MalformedRequest::new(probe, CountVariables::new(channel, Kind::V_E))?;
    let long = [b"V.E".as_slice(), &[0; 254]].concat();
    for (what, data) in [
        ("a kind with a final dot", &b"V.E.\0"[..]),
        ("a kind without NUL", b"V.E"),
        ("bytes after the NUL", b"V.E\0x"),
        ("an unknown kind", b"V.X\0"),
        ("a kind in lower case", b"v.e\0"),
        ("a kind of 257 bytes", &long),
    ] {
        malformed.data(assumed(VAR_1), what, data)?;
    }
    Ok(())
}

fn bad_index_kind(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let mut malformed = MalformedRequest::new(probe, DescribeByIndex::new(channel, 0, Kind::V_E))?;
    let valid = malformed.valid.data.clone();
    for len in 0..valid.len() {
        let what = format!("the request cut to {}", plural(len, "byte"));
        malformed.data(assumed(VAR_3), &what, valid.get(..len).unwrap_or_default())?;
    }
    let with_dot = [valid.get(..7).unwrap_or_default(), &b".\0"[..]].concat();
    malformed.data(assumed(VAR_3), "a kind with a final dot", &with_dot)?;
    malformed.data(assumed(VAR_3), "an empty kind", b"\0\0\0\0\0")
}

fn bad_name(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let known = variables.first().or_inconclusive("no variable")?;
    let text = known.name.text.as_cnc_str();
    let field = TextRef::from(text);
    let requests: [Request<'_>; 2] =
        [HandleByName { channel, name: field }.into(), ReadByName { channel, name: field }.into()];
    for request in requests {
        let mut malformed = MalformedRequest::new(probe, request)?;
        let valid = malformed.valid.data.clone();
        let open = valid.split_last().map(|(_, open)| open.to_vec()).unwrap_or_default();
        let with_tail = [&valid, &b"x"[..]].concat();
        let long = [&valid[..], &vec![0; 257_usize.saturating_sub(valid.len())]].concat();
        for (what, data) in [
            ("no data", Vec::new()),
            ("a name without NUL", open),
            ("bytes after the NUL", with_tail),
            ("a name of 257 bytes", long),
        ] {
            malformed.data(assumed(VAR_9), what, &data)?;
        }
    }
    // This name has 256 characters, more than any variable can have in its name, and begins with an
    // existing name.
    let longest = variables.iter().max_by_key(|one| one.name.text.as_bytes().len());
    for known in [Some(known), longest].into_iter().flatten() {
        let field = TextRef::from(known.name.text.as_cnc_str());
        let requests: [Request<'_>; 2] = [
            HandleByName { channel, name: field }.into(),
            ReadByName { channel, name: field }.into(),
        ];
        for request in requests {
            let mut malformed = MalformedRequest::new(probe, request)?;
            let mut long = known.name.text.as_bytes().to_vec();
            long.resize(256, b'q');
            long.push(0);
            malformed.data(VAR_9, "a name of 256 characters", &long)?;
        }
    }
    Ok(())
}

fn bad_handle_header(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let array = variables.iter().find(|variable| variable.dimensions.len() == 1);
    let array = array.or_not_applicable("no variable is an array")?;
    let request = ReadByHandle::new(channel, array.handle, U32List::from(&[0]));
    let mut malformed = MalformedRequest::new(probe, request)?;
    let valid = malformed.valid.data.clone();
    for len in 0..valid.len() {
        let what = format!("the header cut to {}", plural(len, "byte"));
        let data = valid.get(..len).unwrap_or_default();
        if len < 8 {
            malformed.data(assumed(VAR_11), &what, data)?;
        } else {
            malformed.of_other_length(&what, data)?;
        }
    }
    let handle = valid.get(..4).unwrap_or_default();
    for (count, indices) in [
        (2_u32, 1_usize),
        (0, 1),
        (0, 2),
        (1, 2),
        (0x101, 1),
        (0x1_0001, 1),
        (0x100_0001, 1),
        (0x4000_0001, 1),
        (0x8000_0001, 1),
        (u32::MAX, 1),
        (511, 511),
    ] {
        let mut data = handle.to_vec();
        data.extend(count.to_le_bytes());
        data.resize(indices.saturating_mul(4).saturating_add(8), 0);
        malformed.of_other_length(
            &format!("a count of {count} with {}", plural(indices, "index")),
            &data,
        )?;
    }
    for more in 1..4 {
        let mut data = valid.clone();
        data.extend((0..more).map(|_| 0));
        malformed
            .of_other_length(&format!("{} after the last index", plural(more, "byte")), &data)?;
    }
    Ok(())
}

fn bad_address(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let mut malformed = MalformedRequest::new(probe, CountVariables::new(channel, Kind::V_E))?;
    for group in [0, 0xF005, 0x2301, 0x12_2300, 0x12_2F01, 0x12_F301, 0x112_2301, u32::MAX] {
        malformed.call(ADS_4, &format!("the group {group:#x}"), |call| {
            call.index_group = IndexGroup::new(group);
        })?;
    }
    let is_free = |offset: &u32| {
        let offset = IndexOffset::new(*offset);
        let mut specs = Function::ALL.iter().map(|function| function.spec());
        let group = GroupRule::ChannelOf(Class::Decoder);
        !specs.any(|spec| spec.group == group && spec.offset.contains(offset))
    };
    let free = (0x44..).filter(is_free).take(2);
    for offset in [0, 0x43].into_iter().chain(free).chain([0x144, 0x1_0044, u32::MAX]) {
        malformed.call(ADS_4, &format!("the offset {offset:#x}"), |call| {
            call.index_offset = IndexOffset::new(offset);
        })?;
    }
    for port in [0, 1, 550, 554, u16::MAX] {
        malformed.call(ADS_4, &format!("the port {port}"), |call| call.port = AmsPort(port))?;
    }
    malformed.call(ADS_4, "the port of another task", |call| call.port = AmsPort::COM)?;
    let mut malformed = MalformedRequest::new(probe, CountObjects::new(channel))?;
    for group in [0x13_0000, 0x13_0300, 0x13_1101, 0x14_0101] {
        malformed.call(ADS_4, &format!("the group {group:#x}"), |call| {
            call.index_group = IndexGroup::new(group);
        })?;
    }
    malformed.call(ADS_4, "the port of another task", |call| call.port = AmsPort::SDA)
}

fn bad_service(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let mut malformed = MalformedRequest::new(probe, CountVariables::new(channel, Kind::V_E))?;
    for service in [AdsService::Read, AdsService::Write] {
        malformed.call(ADS_4, &format!("{service} at 0x44"), |call| {
            call.service = service;
            // A Read has no data.
            if service == AdsService::Read {
                call.data.clear();
            }
        })?;
    }
    let mut malformed = MalformedRequest::new(probe, CountObjects::new(channel))?;
    for service in [AdsService::ReadWrite, AdsService::Write] {
        malformed
            .call(ADS_4, &format!("{service} of descriptors"), |call| call.service = service)?;
    }
    Ok(())
}

fn bad_read_length(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let list = ObjectList::from(channel);
    let mut malformed = MalformedRequest::new(probe, ReadDescriptors::new(list, 1, 1)?)?;
    for length in [0, 4, 83] {
        let what = format!("a read length of {length} for a descriptor");
        malformed.call(assumed(COM_3), &what, |call| call.read_length = length)?;
    }
    let mut malformed = MalformedRequest::new(probe, CountVariables::new(channel, Kind::V_E))?;
    for length in [0, 3] {
        let what = format!("a read length of {length} for a number");
        malformed.call(assumed(ADS_3), &what, |call| call.read_length = length)?;
    }
    let mut malformed = MalformedRequest::new(probe, DescribeByIndex::new(channel, 0, Kind::V_E))?;
    malformed.call(assumed(ADS_3), "a read length of 20 for a description", |call| {
        call.read_length = 20;
    })
}
