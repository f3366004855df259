//! Tests the records that the gate makes of replies: handles, descriptions and lists of objects.

use ads_cnc::operation::{
    AxisHandleByName, CountObjects, DescribeByIndex, DescribeByName, HandleByName, ObjectList,
    ReadDescriptors, WriteByHandle,
};
use ads_cnc::{
    Description, DescriptionByName, Descriptor, Handle, Kind, U32List, VariableAccess, VariableType,
};

use super::*;

fn observe<'a>(gate: &mut Gate, request: impl Into<Request<'a>>, reply: &[u8]) {
    let request = request.into();
    let mut buf = vec![0; request.encoded_len()];
    gate.observe(&request.encode(&mut buf).unwrap(), reply);
}

fn by_handle(handle: u32) -> Vec<u8> {
    request(WriteByHandle::new(channel(1), Handle(handle), U32List::from(&[4]), &[1][..]))
}

fn give_handle(gate: &mut Gate, name: &str, handle: u32) {
    observe(gate, HandleByName::new(channel(1), name).unwrap(), &handle.to_le_bytes());
}

/// Lets the gate observe a reply to DescribeByIndex, which contains this name and handle.
fn describe(gate: &mut Gate, name: &str, handle: u32) {
    let description = Description {
        handle: Handle(handle),
        var_type: VariableType::UNS32,
        access: VariableAccess::READ_WRITE,
        size: 4,
        dimensions: Vec::new(),
        name: name.parse().unwrap(),
    };
    observe(
        gate,
        DescribeByIndex::new(channel(1), 0, Kind::V_E),
        &description.encode_to_vec().unwrap(),
    );
}

fn ambiguity(gate: &Gate, frame: &[u8]) -> Option<Ambiguity> {
    match gate.check(frame, now()) {
        Err(GateRejection { reason: Reason::Ambiguous(_, ambiguity), .. }) => Some(ambiguity),
        _ => None,
    }
}

#[test]
fn a_handle_allows_writes_to_its_variable() {
    let mut gate = gate(
        "[[variable]]\nchannel = 1\nname = \"V.E.a\"\n\
                         [[variable]]\nchannel = 1\nname = \"V.E.b[1]\"",
    );
    let rejection = gate.check(&by_handle(7), now()).unwrap_err();
    assert!(rejection.advice().contains("handle"), "{}", rejection.advice());
    for (name, handle) in [("V.E.a", 7_u32), ("V.E.other", 8), ("V.E.b[1]", 9)] {
        give_handle(&mut gate, name, handle);
    }
    let unconfirmed = || Some(Ambiguity::Unconfirmed("V.E.a".parse().unwrap()));
    assert_eq!(ambiguity(&gate, &by_handle(7)), unconfirmed());
    for (name, handle) in [("V.E.a", 7_u32), ("V.E.other", 8), ("V.E.b", 9)] {
        describe(&mut gate, name, handle);
    }
    assert!(gate.check(&by_handle(7), now()).is_ok());
    // `V.E.other` has no entry. `V.E.b` has only an entry for one element, but a handle gives
    // access to all elements.
    assert!(matches!(gate.check(&by_handle(8), now()).unwrap_err().reason, Reason::NoEntry(_)));
    assert!(matches!(gate.check(&by_handle(9), now()).unwrap_err().reason, Reason::NoEntry(_)));
    gate.forget();
    assert!(gate.check(&by_handle(7), now()).is_err());
    describe(&mut gate, "V.E.a", 7);
    assert_eq!(ambiguity(&gate, &by_handle(7)), unconfirmed());
}

/// A write by a handle is rejected if a reply of the same channel contained the handle for a
/// variable that is not in the file.
#[test]
fn a_handle_with_several_names_is_rejected() {
    let table = "[[variable]]\nchannel = 1\nname = \"V.E.a\"\n\
                 [[variable]]\nchannel = 1\nname = \"V.A.p.X\"";
    let confirmed = |name: &str| {
        let mut gate = gate(table);
        give_handle(&mut gate, name, 7);
        describe(&mut gate, name, 7);
        assert!(gate.check(&by_handle(7), now()).is_ok(), "{name}");
        gate
    };
    let shared = |name: &str| Some(Ambiguity::Shared(name.parse().unwrap()));
    let mut by_name = confirmed("V.E.a");
    give_handle(&mut by_name, "V.E.b", 7);
    assert_eq!(ambiguity(&by_name, &by_handle(7)), shared("V.E.b"));

    let mut by_index = confirmed("V.E.a");
    describe(&mut by_index, "V.E.b", 7);
    assert_eq!(ambiguity(&by_index, &by_handle(7)), shared("V.E.b"));

    let mut described = confirmed("V.E.a");
    let reply = DescriptionByName {
        handle: Handle(7),
        var_type: VariableType::UNS32,
        access: VariableAccess::READ_WRITE,
        size: 4,
        dimensions: Vec::new(),
    };
    let reply = reply.encode_to_vec().unwrap();
    observe(&mut described, DescribeByName::new(channel(1), "V.E.b").unwrap(), &reply);
    assert_eq!(ambiguity(&described, &by_handle(7)), shared("V.E.b"));

    // Equal handles in different channels are different handles.
    let mut other = confirmed("V.E.a");
    let of_other = HandleByName::new(channel(2), "V.E.b").unwrap();
    observe(&mut other, of_other, &7_u32.to_le_bytes());
    assert!(other.check(&by_handle(7), now()).is_ok());

    // Two names in the file may have the same handle, but one name must not have several handles.
    let mut both = confirmed("V.E.a");
    give_handle(&mut both, "V.A.p.X", 7);
    assert!(both.check(&by_handle(7), now()).is_ok());
    give_handle(&mut both, "V.E.a", 8);
    assert_eq!(ambiguity(&both, &by_handle(7)), Some(Ambiguity::Several("V.E.a".parse().unwrap())));
    assert_eq!(ambiguity(&both, &by_handle(8)), Some(Ambiguity::Several("V.E.a".parse().unwrap())));

    // In a request to the axis interface, the name does not contain the axis.
    let of_axis = |gate: &mut Gate, axis: u32, name: &str| {
        let axis = ChannelAxis::new(axis).unwrap();
        let ask = AxisHandleByName::new(channel(1), axis, name).unwrap();
        observe(gate, ask, &7_u32.to_le_bytes());
    };
    let mut axis = confirmed("V.A.p.X");
    of_axis(&mut axis, 1, "V.A.p");
    assert!(axis.check(&by_handle(7), now()).is_ok());
    of_axis(&mut axis, 2, "V.A.p");
    assert_eq!(ambiguity(&axis, &by_handle(7)), shared("V.A.p"));
    let mut axis = confirmed("V.A.p.X");
    of_axis(&mut axis, 1, "V.A.q");
    assert_eq!(ambiguity(&axis, &by_handle(7)), shared("V.A.q"));
}

/// After the limit of stored names was exceeded, the gate rejects every write by handle.
#[test]
fn the_number_of_observations_is_limited() {
    let table = "[[variable]]\nchannel = 1\nname = \"V.E.a\"\n\
                 [[object]]\nchannel = 1\nname = \"b_w\"";
    let mut gate = gate(table);
    give_handle(&mut gate, "V.E.a", 7);
    describe(&mut gate, "V.E.a", 7);
    let kept = u32::try_from(rejection::OBSERVATIONS_MAX).unwrap();
    for handle in 100..98 + kept {
        give_handle(&mut gate, "V.E.other", handle);
    }
    assert!(gate.check(&by_handle(7), now()).is_ok());
    for _ in 0..2 {
        give_handle(&mut gate, "V.E.other", 1);
        assert_eq!(ambiguity(&gate, &by_handle(7)), Some(Ambiguity::TooMuch));
    }
    assert!(gate.check(&by_name("V.E.a"), now()).is_ok());
    assert!(gate.knows_handle(channel(1), Handle(2)));
    // Writes by handle remain rejected on another connection, because the names that were not
    // stored are unknown there, too.
    gate.forget();
    describe(&mut gate, "V.E.a", 7);
    give_handle(&mut gate, "V.E.a", 7);
    assert!(gate.check(&by_handle(7), now()).is_err());
}

/// On a new connection, replies must confirm a handle again, but the names that are not in the file
/// remain known.
#[test]
fn a_new_connection_discards_permissions() {
    let confirm = |gate: &mut Gate, handle| {
        give_handle(gate, "V.E.a", handle);
        describe(gate, "V.E.a", handle);
    };
    let mut gate = gate("[[variable]]\nchannel = 1\nname = \"V.E.a\"");
    give_handle(&mut gate, "V.E.other", 8);
    confirm(&mut gate, 7);
    assert!(gate.check(&by_handle(7), now()).is_ok());
    gate.forget();
    assert!(gate.check(&by_handle(7), now()).is_err());
    confirm(&mut gate, 7);
    assert!(gate.check(&by_handle(7), now()).is_ok());
    gate.forget();
    confirm(&mut gate, 8);
    assert_eq!(
        ambiguity(&gate, &by_handle(8)),
        Some(Ambiguity::Shared("V.E.other".parse().unwrap()))
    );
}

#[test]
fn a_named_object_needs_the_whole_list() {
    let object = |name: &str, offset| {
        let at = (IndexGroup::new(0x12_0101), IndexOffset::new(offset));
        Descriptor::new(name, "BOOL").unwrap().with_content(at.0, at.1).encode_to_vec().unwrap()
    };
    let list = |names: [(&str, u32); 3]| names.map(|(name, offset)| object(name, offset)).concat();
    let write = |offset| {
        let (group, offset) = (IndexGroup::new(0x12_0101), IndexOffset::new(offset));
        request(WriteObject::new(group, offset, &[1][..]).unwrap())
    };
    let three = [3, 0, 0, 0];
    let ask = |first, count| ReadDescriptors::new(channel(1), first, count).unwrap();
    let table = "[[object]]\nchannel = 1\nname = \"b_w\"";

    let mut known = gate(table);
    observe(&mut known, CountObjects::new(channel(1)), &three);
    observe(&mut known, ask(2, 1), &object("b_w", 2));
    // The list was not read completely: an unread object may have the same name.
    assert!(known.check(&write(2), now()).is_err());
    observe(&mut known, ask(1, 3), &list([("a_w", 1), ("b_w", 2), ("c_w", 3)]));
    assert!(known.check(&write(2), now()).is_ok());
    assert!(known.check(&write(1), now()).is_err() && known.check(&write(3), now()).is_err());

    let mut twice = gate(table);
    observe(&mut twice, CountObjects::new(channel(1)), &three);
    observe(&mut twice, ask(1, 3), &list([("a_w", 1), ("b_w", 2), ("b_w", 3)]));
    assert!(twice.check(&write(2), now()).is_err() && twice.check(&write(3), now()).is_err());

    // A descriptor for an index after the last does not complete the list.
    let mut beyond = gate(table);
    observe(&mut beyond, CountObjects::new(channel(1)), &three);
    observe(&mut beyond, ask(2, 3), &list([("b_w", 2), ("c_w", 3), ("d_w", 4)]));
    assert!(beyond.check(&write(2), now()).is_err());

    // Two names have the same address, in one list or in two.
    let shared = Some(Ambiguity::Shared("c_w".parse().unwrap()));
    let mut same = gate(table);
    observe(&mut same, CountObjects::new(channel(1)), &three);
    observe(&mut same, ask(1, 3), &list([("c_w", 2), ("b_w", 2), ("a_w", 3)]));
    assert_eq!(ambiguity(&same, &write(2)), shared);
    let mut other = known.clone();
    observe(
        &mut other,
        ReadDescriptors::new(ObjectList::PLATFORM, 1, 1).unwrap(),
        &object("c_w", 2),
    );
    assert_eq!(ambiguity(&other, &write(2)), shared);

    // The descriptor in the list of channel 2 contains an address of channel 1.
    let mut elsewhere = gate(&table.replace("channel = 1", "channel = 2"));
    observe(&mut elsewhere, CountObjects::new(channel(2)), &[1, 0, 0, 0]);
    let of_other = ReadDescriptors::new(channel(2), 1, 1).unwrap();
    observe(&mut elsewhere, of_other, &object("b_w", 2));
    assert_eq!(
        ambiguity(&elsewhere, &write(2)),
        Some(Ambiguity::Elsewhere("b_w".parse().unwrap()))
    );
}
