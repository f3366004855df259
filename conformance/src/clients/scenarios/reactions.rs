//! Replies that are sent otherwise than at once, and replies that are wrong: the right value or an
//! error, never another value, never the end of the client.

use ads_cnc::operation::Function;
use serde_json::{Value, json};

use crate::clients::Scenario;
use crate::clients::knob::{Knob, Lie, Place};
use crate::clients::scenario::Expect;
use crate::judge::{CLIENT, Rule, assumed};

/// What a client is told while its replies are tampered with.
struct Told {
    id: &'static str,
    action: &'static str,
    function: Function,
    /// The requirement of the service, of the data, and its result.
    service: &'static str,
    data: &'static str,
    result: fn() -> Value,
}

const NAME: Told = Told {
    id: "name",
    action: "read-by-name 1 V.E.Testvar SGN32[5]",
    function: Function::ReadByName,
    service: "ADS-3",
    data: "VAR-14",
    result: || json!([123, 234, 345, 456, 567]),
};

const COUNT: Told = Told {
    id: "count",
    action: "count-objects 1",
    function: Function::CountObjects,
    service: "ADS-1",
    data: "COM-1",
    result: || json!(30),
};

const WRITE: Told = Told {
    id: "write",
    action: "write-by-name 1 V.E.test[4] SGN32 123",
    function: Function::WriteByName,
    service: "ADS-2",
    data: "VAR-17",
    result: || Value::Null,
};

impl Told {
    fn scenario(&self, id: &str, what: &str, knob: Knob) -> Scenario {
        let title = format!("{}: {what}", self.action);
        Scenario::new(format!("client-{}-{id}", self.id), title, self.action)
            .with(self.function, knob)
    }

    /// The reply is right, if not as usual.
    fn right(&self, id: &str, what: &str, knob: Knob) -> Scenario {
        let scenario = self.scenario(id, what, knob).by("ADS-5");
        match (self.result)() {
            Value::Null => scenario.expect(Expect::Done),
            result => scenario.gives(result),
        }
    }

    fn wrong(&self, id: &str, what: &str, knob: Knob, rule: impl Into<Rule>) -> Scenario {
        self.scenario(id, what, knob).expect(Expect::Error).by(rule)
    }
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let mut all = Vec::new();
    for told in [&NAME, &COUNT, &WRITE] {
        all.extend(ways(told));
        all.extend(lies(told));
        all.extend(errors(told));
        all.extend(ends(told));
    }
    for told in [&NAME, &COUNT] {
        all.extend(amounts(told));
    }
    all.extend(streams());
    all.extend(lists());
    all
}

fn ways(told: &Told) -> Vec<Scenario> {
    vec![
        told.right("bytewise", "one byte at a time", Knob::Bytewise),
        told.right("pieces-header", "in two pieces, cut in the header", Knob::Pieces(20)),
        told.right("pieces-data", "in two pieces, cut behind the headers", Knob::Pieces(39)),
        // That a client goes on after a reply to nobody is not said; that it takes none is.
        Scenario {
            expect: match (told.result)() {
                Value::Null => Expect::DoneOrError,
                result => Expect::ResultOrError(result),
            },
            ..told.right("foreign", "behind a reply to another invoke ID", Knob::Foreign)
        },
        told.right("twice", "twice in one piece", Knob::Twice),
        told.wrong("other-id", "to another invoke ID only", Knob::OtherInvokeId, "ADS-5"),
        told.wrong(
            "other-command",
            "as the answer to another command",
            Knob::OtherCommand,
            "ADS-5",
        ),
        told.wrong("request", "marked as a request", Knob::Request, "ADS-5"),
    ]
}

fn lies(told: &Told) -> Vec<Scenario> {
    let mut all = Vec::new();
    for (place, name, rule) in [
        (Place::AmsTcp, "AMS/TCP length", "ADS-5"),
        (Place::Ams, "AMS data length", "ADS-5"),
        (Place::Data, "length before the data", told.service),
    ] {
        if place == Place::Data && told.function == Function::WriteByName {
            continue;
        }
        for (lie, how) in [
            (Lie::Longer, "one more"),
            (Lie::Shorter, "one less"),
            (Lie::Zero, "0"),
            (Lie::Huge, "0xFFFFFFFF"),
        ] {
            let field = match place {
                Place::AmsTcp => "tcp-length",
                Place::Ams => "ams-length",
                Place::Data => "data-length",
            };
            let lies = match lie {
                Lie::Longer => "longer",
                Lie::Shorter => "shorter",
                Lie::Zero => "zero",
                Lie::Huge => "huge",
            };
            let what = format!("the {name} says {how}");
            all.push(told.wrong(&format!("{field}-{lies}"), &what, Knob::Lie(place, lie), rule));
        }
    }
    all
}

fn errors(told: &Told) -> Vec<Scenario> {
    let mut all = vec![
        // What is no payload is known from help pages; that an error is one is not.
        told.wrong("ams-error", "an AMS error without payload", Knob::AmsError, "ADS-5")
            .by("ADS-6"),
        told.wrong(
            "bare-result",
            "an error as result, and nothing behind it",
            Knob::BareResult,
            "ADS-4",
        )
        .by("ADS-6"),
    ];
    if told.function != Function::WriteByName {
        all.extend([
            told.wrong("empty-result", "an error as result, length 0", Knob::EmptyResult, "ADS-4"),
            told.wrong(
                "result-data",
                "an error as result, with data",
                Knob::ResultWithData,
                "ADS-4",
            ),
        ]);
    }
    all
}

fn ends(told: &Told) -> Vec<Scenario> {
    let mut all = vec![
        told.wrong("closed", "closed without a reply", Knob::CutAt(0), "ADS-5"),
        told.wrong("closed-header", "closed within the headers", Knob::CutAt(20), "ADS-5"),
        told.wrong("closed-data", "closed before the last byte", Knob::CutEnd, "ADS-5"),
    ];
    // Each takes as long as the client waits.
    if told.function == Function::ReadByName {
        all.push(told.wrong("silence", "no reply at all", Knob::Silence, CLIENT));
    }
    all
}

fn amounts(told: &Told) -> Vec<Scenario> {
    let wrong = |id: &str, what: &str, knob| told.wrong(id, what, knob, told.data);
    vec![
        wrong("more", "four bytes more than there should be", Knob::More(4)),
        wrong("one-more", "one byte more", Knob::More(1)),
        wrong("less", "one byte less", Knob::Less(1)),
        wrong("none", "no data at all", Knob::Only(0)),
    ]
}

/// Streams that are too short, too long, or say something new.
fn streams() -> Vec<Scenario> {
    let describe = |id: &str, what: &str, knob| {
        let title = format!("describe 1 2 V.E: {what}");
        let scenario = Scenario::new(format!("client-describe-{id}"), title, "describe 1 2 V.E");
        scenario.with(Function::DescribeByIndex, knob)
    };
    let as_is = |ty: u32, access: u32| {
        json!({"name": "V.E.Variable_3", "handle": 0x200_0002, "type": ty, "access": access,
            "size": 2, "dimensions": [2]})
    };
    let short = |id: &str, action: &str, function, rule: &'static str, len| {
        let title = format!("{action}: {len} bytes of data");
        Scenario::new(format!("client-{id}-short"), title, action)
            .with(function, Knob::Only(len))
            .expect(Expect::Error)
            .by(rule)
    };
    vec![
        describe("open", "the name ends with the reply", Knob::Open)
            .gives(as_is(1, 1))
            .by(assumed("VAR-4")),
        describe("padded", "the name is padded to 256 bytes", Knob::Padded(24))
            .gives(as_is(1, 1))
            .by(assumed("VAR-4")),
        describe("type", "a type that nobody knows", Knob::Patch(4, [77, 0, 0, 0]))
            .gives(as_is(77, 1))
            .by(assumed("VAR-23")),
        describe("access", "an access that nobody knows", Knob::Patch(8, [9, 0, 0, 0]))
            .gives(as_is(1, 9))
            .by(assumed("VAR-23")),
        describe(
            "dimensions",
            "more dimensions than there is room for",
            Knob::Patch(16, [0xFF; 4]),
        )
        .expect(Expect::Error)
        .by("VAR-24"),
        describe("short", "it ends within the dimensions", Knob::Only(22))
            .expect(Expect::Error)
            .by("VAR-4"),
        describe("empty", "it is empty", Knob::Only(0)).expect(Expect::Error).by("VAR-4"),
        short("handle", "handle 1 V.E.vartest", Function::HandleByName, "VAR-10", 3),
        short("count-variables", "count-variables 1 V.E", Function::CountVariables, "VAR-2", 2),
        short("parameters", "count-parameters 1 P", Function::CountDynamic, "DYN-1", 1),
        short("parameter", "parameter-by-name 1 P P1", Function::DynamicValueByName, "DYN-3", 7),
        short("instance", "find-instance hld 1 0", Function::FindInstance, "SDA-1", 4),
        short("extended", "describe-extended 1 3 V.E", Function::DescribeExtended, "VAR-15", 6),
        short("element", "count-elements hld 1 0", Function::CountElements, "SDA-4", 3),
        short("axis", "read-axis 1 2 V.A.WCS REAL64", Function::AxisReadByName, "VAR-14", 7),
    ]
}

fn lists() -> Vec<Scenario> {
    let list = |id: &str, what: &str, knob| {
        let title = format!("list-objects 1: {what}");
        Scenario::new(format!("client-list-{id}"), title, "list-objects 1")
            .with(Function::ReadDescriptors, knob)
    };
    let right = |scenario: Scenario| scenario.expect(Expect::Asked(super::objects::list));
    vec![
        right(list("bytewise", "one byte at a time", Knob::Bytewise)).by("ADS-5"),
        right(list("late", "behind the reply to the request before", Knob::Late))
            .by(assumed("ADS-5")),
        right(list("twice", "twice in one piece", Knob::Twice)).by(assumed("ADS-5")),
        // It asks on, or says that it did not get them; it has not all of them.
        list("fewer", "fewer descriptors than it asks for", Knob::Descriptors(5))
            .expect(Expect::AskedOrError(super::objects::list))
            .by(assumed("COM-3")),
        list("torn", "the last descriptor is not whole", Knob::Less(1))
            .expect(Expect::Error)
            .by("COM-2"),
        list("none", "no descriptors", Knob::Only(0)).expect(Expect::Error).by("COM-2"),
    ]
}
