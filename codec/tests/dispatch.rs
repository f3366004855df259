//! Tests of dispatch: which request a server gets from the call of a client, and which error.

use std::collections::{BTreeMap, BTreeSet};

use ads_cnc::ErrorKind;
use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::*;
use proptest::prelude::*;

use super::common::{CALLS, check_call};
use super::kept;

/// Each sample of a call is dispatched to its function, and its request encodes to a call with the
/// same address and data. Every function occurs in a sample.
#[test]
fn calls_are_dispatched_to_their_functions() {
    let mut reached = BTreeSet::new();
    for sample in CALLS {
        let request = sample.call.dispatch();
        assert_eq!(
            request.map(|request| request.function()),
            Ok(sample.function),
            "{}",
            sample.slug
        );
        assert_eq!(check_call(&sample.call), Ok(()), "{}", sample.slug);
        reached.insert(sample.function);
    }
    assert_eq!(reached, Function::ALL.iter().copied().collect());
}

fn error_of(change: impl FnOnce(&mut Call<'_>)) -> DispatchError {
    let sample = CALLS.iter().find(|sample| sample.slug == "handle-printed").unwrap();
    let mut call = sample.call;
    change(&mut call);
    call.dispatch().unwrap_err()
}

/// The dispatch error of a call with one fault names this fault, and has the ADS error for the
/// response.
#[test]
fn a_call_with_one_fault_is_rejected_for_it() {
    let group = IndexGroup::new;
    let offset = IndexOffset::new;
    let cases = [
        (error_of(|call| call.port = AmsPort(851)), DispatchError::Port(AmsPort(851)), 0x6),
        // The task COM does not serve classes, the task SDA does not serve objects.
        (error_of(|call| call.port = AmsPort::COM), DispatchError::Group(group(0x12_2301)), 0x702),
        (
            error_of(|call| call.index_group = group(0x13_0101)),
            DispatchError::Group(group(0x13_0101)),
            0x702,
        ),
        // Channel 0 has no variables, but may have elements.
        (
            error_of(|call| call.index_group = group(0x12_2300)),
            DispatchError::Offset(offset(0x46)),
            0x703,
        ),
        (
            error_of(|call| call.index_group = group(0x12_2401)),
            DispatchError::Service { expected: AdsService::Read, found: AdsService::ReadWrite },
            0x701,
        ),
        // The group of a query of object addresses has no channel (SDA-1).
        (
            error_of(|call| call.index_group = group(0x12_3901)),
            DispatchError::Group(group(0x12_3901)),
            0x702,
        ),
        (
            error_of(|call| call.index_group = group(0xF005)),
            DispatchError::Group(group(0xF005)),
            0x702,
        ),
        (
            error_of(|call| call.index_offset = offset(0x4D)),
            DispatchError::Offset(offset(0x4D)),
            0x703,
        ),
        (
            error_of(|call| call.index_offset = offset(0x1_0046)),
            DispatchError::Offset(offset(0x1_0046)),
            0x703,
        ),
        (
            error_of(|call| call.service = AdsService::Write),
            DispatchError::Service { expected: AdsService::ReadWrite, found: AdsService::Write },
            0x701,
        ),
    ];
    for (rejected, wanted, number) in cases {
        assert_eq!((rejected, rejected.ads_error()), (wanted, AdsError(number)));
    }
    let DispatchError::Stream(error) = error_of(|call| call.data = b"V.E.vartest") else {
        panic!()
    };
    assert_eq!((error.kind(), error.field().name()), (ErrorKind::MissingNul, "name"));
    assert_eq!(DispatchError::Stream(error).ads_error(), AdsError::INVALID_SIZE);
}

/// The name of the function that serves a call to this address, or a text for the dispatch error.
fn reached(port: AmsPort, service: AdsService, group: u32, offset: u32) -> String {
    let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
    let mut reached = String::new();
    for data in [&[][..], b"\x01\0\0\0", b"\x01\0\0\0\0\0\0\0", b"V.E\0", b"\x01\0\0\0V.E\0"] {
        let call = Call { port, service, index_group, index_offset, read_length: 84, data };
        reached = match call.dispatch() {
            Ok(request) => return request.function().spec().name.to_owned(),
            // The data is not valid for the function at this address: try the next data.
            Err(DispatchError::Stream(_)) => continue,
            Err(DispatchError::Port(_)) => "no port".to_owned(),
            Err(DispatchError::Group(_)) => "no group".to_owned(),
            Err(DispatchError::Offset(_)) => "no offset".to_owned(),
            Err(DispatchError::Service { expected, .. }) => format!("takes {expected}"),
            Err(other) => panic!("{other}"),
        };
        break;
    }
    assert_ne!(reached, "", "no function takes this data: {service} {group:#x} {offset:#x}");
    reached
}

/// A snapshot lists the functions that Read, Write and ReadWrite reach at groups and offsets of all
/// functions and at other numbers near them. Ports and groups with equal results are combined, and
/// so are consecutive offsets with equal results.
#[test]
#[cfg_attr(miri, ignore = "too many numbers for an interpreter")]
fn dispatch_reaches_the_same_functions() {
    let tables = (0..0x70_u32).filter(|table| table & 0x0F < 0x0B);
    let highs = [0x12, 0x13, 0x02, 0x03, 0x22, 0x112];
    let groups = tables.flat_map(|table| highs.map(|high| (high << 16) | (table << 8)));
    let groups = groups.flat_map(|group| [group, group | 1]);
    let near = [0x8F, 0x90, 0x91, 0x92, 0xFFFF, 0x8000_0000, u32::MAX];
    let of_axes =
        [1, 2, 0xFFFF_u32].into_iter().flat_map(|axis| (0..9).map(move |of| axis << 16 | of));
    let mut offsets: Vec<u32> = (0..0x50).chain(near).chain(of_axes).collect();
    offsets.sort_unstable();

    let mut alike: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for group in groups {
        for port in [AmsPort(550), AmsPort::GEO, AmsPort::SDA, AmsPort::COM] {
            let mut all = String::new();
            let mut last = [const { String::new() }; 3];
            for &offset in &offsets {
                let services = [AdsService::Read, AdsService::Write, AdsService::ReadWrite];
                let found = services.map(|service| reached(port, service, group, offset));
                if found != last {
                    all.push_str(&format!("    from {offset:#x} on: {}\n", found.join(", ")));
                    last = found;
                }
            }
            alike.entry(all).or_default().push(format!("{}:{group:#x}", port.0));
        }
    }
    let mut alike: Vec<_> = alike.into_iter().collect();
    alike.sort_by(|(_, one), (_, two)| one.cmp(two));
    let shown: String = alike
        .into_iter()
        .map(|(all, groups)| match all.contains("no group") || all.contains("no port") {
            true => format!("{} others\n{all}", groups.len()),
            false => format!("{}\n{all}", groups.join(" ")),
        })
        .collect();
    insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!("dispatch", shown);
    });
}

/// A read length of less than one descriptor, 84 bytes, is rejected. A read length of k × 84
/// requests k descriptors, at most [`ReadDescriptors::COUNT_MAX`]; any other length from 84 on
/// requests one (COM-3).
#[test]
fn read_lengths_of_descriptors() {
    let sample = CALLS.iter().find(|sample| sample.slug == "descriptor-printed").unwrap();
    for (read_length, count) in [
        (0, None),
        (83, None),
        (84, Some(1)),
        (85, Some(1)),
        (167, Some(1)),
        (168, Some(2)),
        (420, Some(5)),
    ] {
        let call = Call { read_length, ..sample.call };
        match (call.dispatch(), count) {
            (Ok(Request::ReadDescriptors(read)), Some(count)) => {
                assert_eq!((read.count(), read.first()), (count, 0x10));
            }
            (Err(error_of), None) => assert_eq!(error_of.ads_error(), AdsError::INVALID_SIZE),
            (other, _) => panic!("{read_length}: {other:?}"),
        }
    }
}

proptest! {
    #![proptest_config(kept::cases(256, file!()))]

    /// Any call is rejected, or dispatched to a request that encodes to a call with the same
    /// address and data. The calls are samples with changed parts, so that some of them are
    /// accepted.
    #[test]
    fn any_call_is_rejected_or_encodes_to_itself(
        sample in prop::sample::select(CALLS.iter().map(|sample| sample.call).collect::<Vec<_>>()),
        port in 550..=554_u16,
        group in prop::option::of((0..24_u32, 0..24_u32)),
        offset in prop::option::of(0..0x50_u32),
        read_length in prop::option::of(any::<u32>()),
        data in prop::option::of(prop::collection::vec(any::<u8>(), 0..24)),
    ) {
        let mut call = sample;
        call.port = AmsPort(port);
        if let Some((one, two)) = group {
            call.index_group = IndexGroup::new(call.index_group.get() ^ (1 << one) ^ (1 << two));
        }
        call.index_offset = offset.map_or(call.index_offset, IndexOffset::new);
        call.read_length = read_length.unwrap_or(call.read_length);
        if let Some(data) = data.as_deref().filter(|_| call.service != AdsService::Read) {
            call.data = data;
        }
        let _ = check_call(&call);
    }
}

/// A reply with more descriptors than the request asks for is rejected.
#[test]
fn replies_with_too_many_descriptors_are_rejected() {
    let sample = CALLS.iter().find(|sample| sample.slug == "descriptor-printed").unwrap();
    let request = sample.call.dispatch().unwrap();
    let error = request.decode_reply(&[0; 168]).unwrap_err();
    assert_eq!((error.kind(), error.expected(), error.found()), (ErrorKind::TooMany, 1, 2));
}
