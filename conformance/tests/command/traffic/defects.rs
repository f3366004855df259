//! In captured traffic, each defect of a CNC or client that these tests name makes the violated
//! requirement fail.

use ads_cnc::ads::FrameRef;
use ads_cnc::layout::Stream;
use ads_cnc::operation::Call;
use ads_cnc_conformance::faults::FieldDefect;
use ads_cnc_conformance::judge::Verdict;

use super::maker::{Link, Message, Side, checked, passes, pcap, segments, with};
use super::talk::{a_little, conversation, everything, recorded};

/// The requirements that fail for the captured traffic of a CNC with this defect.
fn failing(id: &str) -> Vec<String> {
    let defect = FieldDefect::by_id(id).unwrap();
    // A defect of a header makes every reply invalid, so a short conversation suffices.
    let is_header = id.starts_with("ams-") || id.starts_with("read-");
    let talk = if is_header { a_little } else { everything };
    let checked = checked(&recorded(Some(&defect), talk));
    assert_eq!(with(&checked, Verdict::HarnessError), [""; 0], "{id}");
    with(&checked, Verdict::Fail)
}

#[test]
fn defects_of_a_cnc_fail_their_requirement() {
    for (defect, requirement) in [
        ("variable-description.type.invert", "VAR-5"),
        ("variable-description.access.invert", "VAR-6"),
        ("variable-description.size.invert", "VAR-8"),
        ("variable-description.dimension_count.invert", "VAR-4"),
        ("variable-description.dimensions.invert", "VAR-8"),
        ("variable-description.name.invert", "VAR-3"),
        ("variable-count.count.zero", "VAR-2"),
        ("variable-count.count.flip", "VAR-1"),
        ("variable-extended-description.validity.invert", "VAR-15"),
        ("object-descriptor.size.flip", "COM-5"),
        ("object-descriptor.id.zero", "COM-2"),
        ("object-count.count.zero", "COM-2"),
        ("element-length.length.invert", "GEN-5"),
        ("object-address.index_group.invert", "ADR-5"),
        ("dynamic-count.count.zero", "DYN-5"),
        ("dynamic-name.name.invert", "DYN-2"),
        ("ams-header.invoke_id.flip", "ADS-5"),
        ("ams-header.state_flags.zero", "ADS-5"),
        ("ams-header.command.flip", "ADS-5"),
        ("ams-header.source_port.flip", "ADS-5"),
        ("ams-header.data_length.flip", "ADS-5"),
        ("ams-tcp-header.length.flip", "ADS-5"),
        ("ams-tcp-header.reserved.invert", "ADS-5"),
        ("ams-tcp-header.reserved.flip", "ADS-5"),
        ("read-reply.length.flip", "ADS-1"),
        ("read-write-reply.length.flip", "ADS-3"),
    ] {
        let failed = failing(defect);
        let named = |one: &&String| {
            one.starts_with("cap-cnc-") && one.ends_with(&format!(" {requirement}"))
        };
        assert!(failed.iter().any(|one| named(&one)), "{defect}: {failed:?}");
        assert!(failed.iter().all(|one| one.starts_with("cap-cnc-")), "{defect}: {failed:?}");
    }
}

/// The messages with the defect applied to each request that has the field.
fn spoilt(all: &[Message], defect: &FieldDefect) -> Vec<Message> {
    let spoil = |bytes: &[u8]| -> Option<Vec<u8>> {
        let (frame, _) = FrameRef::split(bytes, u32::MAX).ok()??;
        let touched = |name: &str| defect.stream.layout().name == name;
        let change = |from: usize, to: usize| {
            let mut changed = bytes.to_vec();
            changed.splice(from..to, defect.apply(&bytes[from..to]));
            Some(changed)
        };
        match () {
            () if touched("ams-tcp-header") => return change(0, 6),
            () if touched("ams-header") => return change(6, 38),
            () if touched("read-request") || touched("read-write-request") => {
                let length =
                    if frame.data().len() == 12 { "read-request" } else { "read-write-request" };
                return if touched(length) { change(38, bytes.len()) } else { None };
            }
            () => {}
        }
        let call = Call::from_frame(&frame).ok()??;
        let stream = call.dispatch().ok()?.function().spec().request?;
        let from = bytes.len() - call.data.len();
        if defect.touches(stream) { change(from, bytes.len()) } else { None }
    };
    let each = |(side, bytes): &Message| match side {
        Side::Client => (*side, spoil(bytes).unwrap_or_else(|| bytes.clone())),
        Side::Cnc => (*side, bytes.clone()),
    };
    all.iter().map(each).collect()
}

#[test]
fn defects_of_a_client_fail_their_requirement() {
    let all = conversation(None, everything);
    for (defect, requirement) in [
        ("ams-header.state_flags.invert", "ADS-5"),
        ("ams-header.data_length.flip", "ADS-5"),
        ("ams-tcp-header.length.flip", "ADS-5"),
        ("ams-tcp-header.reserved.flip", "ADS-5"),
        ("read-write-request.write_length.flip", "ADS-3"),
        ("variable-handle-read.index_count.invert", "VAR-24"),
        ("variable-handle-read.index_count.flip", "VAR-11"),
        ("variable-name.name.invert", "VAR-9"),
        ("variable-kind.kind.invert", "VAR-1"),
        ("dynamic-index.index.zero", "DYN-5"),
    ] {
        let id = FieldDefect::by_id(defect).unwrap();
        let checked = checked(&pcap(&segments(&spoilt(&all, &id), 1460, (1, 1)), Link::Raw));
        assert_eq!(with(&checked, Verdict::HarnessError), [""; 0], "{defect}");
        let failed = with(&checked, Verdict::Fail);
        let named = |one: &String| {
            one.starts_with("cap-client-") && one.ends_with(&format!(" {requirement}"))
        };
        assert!(failed.iter().any(named), "{defect}: {failed:?}");
    }
}

/// Requests and replies that the manuals print, put into frames, are judged as captured traffic without a
/// failure. Examples without a printed reply are not tried.
#[test]
fn printed_examples_pass() {
    // Each example is a separate conversation, because one example contradicts another.
    let mut judged = 0;
    for reply in ads_cnc_vectors::vectors() {
        let context = &reply.context;
        let (Some(request), Some(group), Some(offset)) = (
            context.request.as_deref().and_then(ads_cnc_vectors::vector),
            context.index_group,
            context.index_offset,
        ) else {
            continue;
        };
        if reply.provenance.kind != ads_cnc_vectors::ProvenanceKind::Manual || !reply.is_accepted()
        {
            continue;
        }
        let read = context.service == Some(ads_cnc_vectors::AdsService::Read);
        let (data, answer) = (if read { Vec::new() } else { request.bytes() }, reply.bytes());
        let length = Stream::by_name(&reply.stream).unwrap().layout().max;
        let length = if read { u32::try_from(answer.len()).unwrap() } else { length };
        let com = group & 0xF00 == 0x100 && group & 0xF000 == 0
            || group & 0xF00 == 0x200 && group & 0x0F_F000 == 0x2_0000;
        let port = if com { 553_u16 } else { 552 };
        let mut asked = words(&[group, offset, length]);
        if !read {
            asked.extend(u32::try_from(data.len()).unwrap().to_le_bytes());
            asked.extend(&data);
        }
        let mut answered = words(&[0, u32::try_from(answer.len()).unwrap()]);
        answered.extend(&answer);
        let talk = exchange(if read { 2 } else { 9 }, port, &asked, &answered);
        let checked = checked(&pcap(&segments(&talk, 1460, (1, 1)), Link::Vlan));
        assert!(passes(&checked) >= 8, "{}: {:?}", reply.id, checked.tally.lines());
        judged += 1;
    }
    assert!(judged >= 20, "{judged}");
}

/// A write to the program stream or the variables of channel 1, and the reply with this result.
pub(crate) fn written(offset: u32, data: &[u8], result: u32) -> [Message; 2] {
    let (group, port) = if offset == 0x90 { (0x12_0101_u32, 553_u16) } else { (0x12_2301, 552) };
    let mut request = words(&[group, offset, u32::try_from(data.len()).unwrap()]);
    request.extend(data);
    exchange(3, port, &request, &result.to_le_bytes())
}

fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// The frames of a request of an ADS command and of its reply, built without the codec.
fn exchange(command: u8, port: u16, request: &[u8], reply: &[u8]) -> [Message; 2] {
    let frame = |is_reply: bool, payload: &[u8]| {
        let mut out = vec![0, 0];
        let length = u32::try_from(payload.len()).unwrap();
        out.extend((length + 32).to_le_bytes());
        let ends = [([127, 0, 0, 1, 1, 1], port), ([10, 0, 0, 9, 1, 1], 0x8001)];
        for (id, port) in if is_reply { [ends[1], ends[0]] } else { ends } {
            out.extend(id);
            out.extend(port.to_le_bytes());
        }
        out.extend([command, 0, if is_reply { 5 } else { 4 }, 0]);
        out.extend(length.to_le_bytes());
        out.extend([0, 0, 0, 0, 7, 0, 0, 0]);
        out.extend(payload);
        out
    };
    [(Side::Client, frame(false, request)), (Side::Cnc, frame(true, reply))]
}

/// The number of parameters may change, because a program may create a parameter between two requests.
#[test]
fn a_parameter_may_be_created_after_the_count() {
    let count =
        |number: u32| exchange(2, 552, &words(&[0x12_2301, 0x2, 4]), &words(&[0, 4, number]));
    let second = exchange(
        9,
        552,
        &words(&[0x12_2301, 0x1D, 8, 4, 2]),
        &[&words(&[0, 8])[..], &2.5_f64.to_le_bytes()].concat(),
    );
    let failing = |last: u32| {
        let talk = [count(1), second.clone(), count(last)].concat();
        with(&checked(&pcap(&segments(&talk, 1460, (1, 1)), Link::Sll2)), Verdict::Fail)
    };
    assert_eq!(failing(2), [""; 0]);
    assert_eq!(failing(1), ["cap-cnc-dyn DYN-5"]);
}

fn failing_writes(writes: &[(u32, &[u8], u32)]) -> Vec<String> {
    let talk: Vec<Message> =
        writes.iter().flat_map(|(offset, data, result)| written(*offset, data, *result)).collect();
    let checked = checked(&pcap(&segments(&talk, 1460, (1, 1)), Link::Sll2));
    assert_eq!(with(&checked, Verdict::HarnessError), [""; 0]);
    with(&checked, Verdict::Fail)
}

#[test]
fn streams_are_judged() {
    let stream = |requirement: &str| vec![format!("cap-client-stream {requirement}")];
    let none: [&str; 0] = [];
    // The client sends a rejected packet again, as it should.
    let again: [(u32, &[u8], u32); 3] =
        [(0x90, b"N10 X1\r\n", 0), (0x90, b"N20 X2\r\n", 0x706), (0x90, b"N20 X2\r\n", 0)];
    assert_eq!(failing_writes(&again), none);
    let other: [(u32, &[u8], u32); 2] = [(0x90, b"N10 X1\r\n", 0x706), (0x90, b"N20 X2\r\n", 0)];
    assert_eq!(failing_writes(&other), stream("STM-6"));
    assert_eq!(failing_writes(&[(0x90, b"N10 X1", 0)]), stream("STM-4"));
    assert_eq!(failing_writes(&[(0x90, b"N10 X1\nN20 X2\r\n", 0)]), stream("STM-4"));
    assert_eq!(failing_writes(&[(0x90, b"N10 X\xE4\r\n", 0)]), stream("STM-7"));
    assert_eq!(failing_writes(&[(0x90, b"N10 $WHILE 1\r\n", 0)]), stream("STM-8"));
    // A loop word is allowed in a comment that began in the previous packet.
    let comment: [(u32, &[u8], u32); 2] =
        [(0x90, b"#COMMENT BEGIN\r\n", 0), (0x90, b"$WHILE 1\r\n#COMMENT END\r\n", 0)];
    assert_eq!(failing_writes(&comment), none);
    let long = [&[b'X'; 1000][..], b"\r\n"].concat();
    assert_eq!(failing_writes(&[(0x90, &long, 0x705)]), stream("STM-2"));
}

#[test]
fn services_are_judged() {
    let of = |requirement: &str| format!("cap-client-service {requirement}");
    let response: (u32, &[u8], u32) = (0x4A, b"V.G.SERVICE.RESPONSE\x001.732051\0", 0);
    let state: (u32, &[u8], u32) = (0x4A, b"V.G.SERVICE.RESPONSE_STATE\0\x01\0\0\0", 0);
    let zero: (u32, &[u8], u32) = (0x4A, b"V.G.SERVICE.RESPONSE_STATE\0\0\0\0\0", 0);
    // The client writes a response without having read a request; its writes are correct otherwise.
    assert_eq!(failing_writes(&[response, state]), [of("SVC-2")]);
    assert_eq!(failing_writes(&[state]), [of("SVC-2"), of("SVC-5")]);
    assert_eq!(failing_writes(&[response, zero]), [of("SVC-5")]);
    let asked: (u32, &[u8], u32) = (0x4A, b"V.G.SERVICE.REQUEST_STATE\0\x01\0\0\0", 0);
    assert_eq!(failing_writes(&[asked]), [of("SVC-12")]);
    let long = [b"V.G.SERVICE.RESPONSE\0".as_slice(), &[b'x'; 129]].concat();
    assert_eq!(failing_writes(&[(0x4A, &long, 0)]), [of("SVC-1")]);
    let short: (u32, &[u8], u32) = (0x4A, b"V.G.SERVICE.REQUEST_STATE\0\0\0", 0);
    assert_eq!(failing_writes(&[short]), [of("SVC-1")]);
}
