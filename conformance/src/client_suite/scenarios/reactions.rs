//! Scenarios with replies that are split, repeated, late, missing, unusual or invalid: the client
//! must return the right value or an error, as the scenario says, and must not crash.

use ads_cnc::operation::Function;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;
use serde_json::{Value, json};

use crate::client_suite::Scenario;
use crate::client_suite::scenario::ExpectedAnswer;
use crate::client_suite::tamper::{LengthField, Tamper, WrongLength};
use crate::judge::{Rule, assumed};
use crate::text::plural;

/// An action whose replies are changed.
struct ReactionScenario {
    id: &'static str,
    action: &'static str,
    function: Function,
    /// The requirement of the ADS service.
    service: ClauseId,
    /// The requirement of the data in the reply.
    data: ClauseId,
    result: fn() -> Value,
}

const NAME: ReactionScenario = ReactionScenario {
    id: "name",
    action: "read-by-name 1 V.E.Testvar SGN32[5]",
    function: Function::ReadByName,
    service: ADS_3,
    data: VAR_14,
    result: || json!([123, 234, 345, 456, 567]),
};

const COUNT: ReactionScenario = ReactionScenario {
    id: "count",
    action: "count-objects 1",
    function: Function::CountObjects,
    service: ADS_1,
    data: COM_1,
    result: || json!(30),
};

const WRITE: ReactionScenario = ReactionScenario {
    id: "write",
    action: "write-by-name 1 V.E.test[4] SGN32 123",
    function: Function::WriteByName,
    service: ADS_2,
    data: VAR_17,
    result: || Value::Null,
};

impl ReactionScenario {
    fn scenario(&self, id: &str, what: &str, tamper: Tamper) -> Scenario {
        let title = format!("{}: {what}", self.action);
        Scenario::new(format!("client-{}-{id}", self.id), title, self.action)
            .with(self.function, tamper)
    }

    /// A scenario with a valid, but unusual reply.
    fn valid_reply(&self, id: &str, what: &str, tamper: Tamper) -> Scenario {
        let scenario = self.scenario(id, what, tamper).by(ADS_5);
        match (self.result)() {
            Value::Null => scenario.expect(ExpectedAnswer::Done),
            result => scenario.gives(result),
        }
    }

    fn invalid_reply(
        &self,
        id: &str,
        what: &str,
        tamper: Tamper,
        rule: impl Into<Rule>,
    ) -> Scenario {
        self.scenario(id, what, tamper).expect(ExpectedAnswer::Error).by(rule)
    }
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let mut all = Vec::new();
    for scenario in [&NAME, &COUNT, &WRITE] {
        all.extend(sent_otherwise(scenario));
        all.extend(wrong_lengths(scenario));
        all.extend(errors(scenario));
        all.extend(closed(scenario));
    }
    for scenario in [&NAME, &COUNT] {
        all.extend(wrong_amounts(scenario));
    }
    all.extend(streams());
    all.extend(lists());
    all
}

fn sent_otherwise(scenario: &ReactionScenario) -> Vec<Scenario> {
    vec![
        scenario.valid_reply("bytewise", "one byte at a time", Tamper::Bytewise),
        scenario.valid_reply(
            "pieces-header",
            "in two pieces, cut in the header",
            Tamper::Pieces(20),
        ),
        scenario.valid_reply(
            "pieces-data",
            "in two pieces, cut after the headers",
            Tamper::Pieces(39),
        ),
        // A client must not accept a reply to another request. Whether the client then continues to
        // wait for its own reply is not specified.
        Scenario {
            or_error: true,
            ..scenario.valid_reply("foreign", "after a reply to another invoke ID", Tamper::Foreign)
        },
        scenario.valid_reply("twice", "twice in one piece", Tamper::Twice),
        scenario.invalid_reply(
            "other-id",
            "to another invoke ID only",
            Tamper::OtherInvokeId,
            ADS_5,
        ),
        scenario.invalid_reply(
            "other-command",
            "as the reply to another command",
            Tamper::OtherCommand,
            ADS_5,
        ),
        scenario.invalid_reply("request", "marked as a request", Tamper::Request, ADS_5),
    ]
}

fn wrong_lengths(scenario: &ReactionScenario) -> Vec<Scenario> {
    let mut all = Vec::new();
    for (place, field, name, rule) in [
        (LengthField::AmsTcp, "tcp-length", "AMS/TCP length", ADS_5),
        (LengthField::Ams, "ams-length", "AMS data length", ADS_5),
        (LengthField::Data, "data-length", "ADS data length", scenario.service),
    ] {
        if place == LengthField::Data && scenario.function == Function::WriteByName {
            continue;
        }
        for (length, kind, how) in [
            (WrongLength::Longer, "longer", "one too large"),
            (WrongLength::Shorter, "shorter", "one too small"),
            (WrongLength::Zero, "zero", "0"),
            (WrongLength::Huge, "huge", "0xFFFFFFFF"),
        ] {
            let what = format!("the {name} is {how}");
            all.push(scenario.invalid_reply(
                &format!("{field}-{kind}"),
                &what,
                Tamper::Length(place, length),
                rule,
            ));
        }
    }
    all
}

fn errors(scenario: &ReactionScenario) -> Vec<Scenario> {
    let mut all = vec![
        // An AMS error without service data is documented online; how a client reports the error is
        // not specified.
        scenario
            .invalid_reply("ams-error", "an AMS error without payload", Tamper::AmsError, ADS_5)
            .by(ADS_6),
        scenario
            .invalid_reply(
                "bare-result",
                "an error as result without further fields",
                Tamper::BareResult,
                ADS_4,
            )
            .by(ADS_6),
    ];
    if scenario.function != Function::WriteByName {
        all.extend([
            scenario.invalid_reply(
                "empty-result",
                "an error as result with data length 0",
                Tamper::EmptyResult,
                ADS_4,
            ),
            scenario.invalid_reply(
                "result-data",
                "an error as result with data",
                Tamper::ResultWithData,
                ADS_4,
            ),
        ]);
    }
    all
}

fn closed(scenario: &ReactionScenario) -> Vec<Scenario> {
    let mut all = vec![
        scenario.invalid_reply("closed", "closed without a reply", Tamper::CutAt(0), ADS_5),
        scenario.invalid_reply(
            "closed-header",
            "closed within the headers",
            Tamper::CutAt(20),
            ADS_5,
        ),
        scenario.invalid_reply("closed-data", "closed before the last byte", Tamper::CutEnd, ADS_5),
    ];
    // A scenario without a reply lasts as long as the timeout of the client, so only this function
    // has such a scenario.
    if scenario.function == Function::ReadByName {
        all.push(scenario.invalid_reply(
            "silence",
            "no reply at all",
            Tamper::Silence,
            Rule::CLIENT,
        ));
    }
    all
}

fn wrong_amounts(scenario: &ReactionScenario) -> Vec<Scenario> {
    let wrong =
        |id: &str, what: &str, tamper| scenario.invalid_reply(id, what, tamper, scenario.data);
    vec![
        wrong("more", "four bytes too many", Tamper::More(4)),
        wrong("one-more", "one byte too many", Tamper::More(1)),
        wrong("less", "one byte too few", Tamper::Less(1)),
        wrong("none", "no data", Tamper::Only(0)),
    ]
}

/// Scenarios with streams that are too short or too long, or with values that no edition defines.
fn streams() -> Vec<Scenario> {
    let describe = |id: &str, what: &str, tamper| {
        let title = format!("describe 1 2 V.E: {what}");
        let scenario = Scenario::new(format!("client-describe-{id}"), title, "describe 1 2 V.E");
        scenario.with(Function::DescribeByIndex, tamper)
    };
    let as_is = |ty: u32, access: u32| {
        json!({"name": "V.E.Variable_3", "handle": 0x200_0002, "type": ty, "access": access,
            "size": 2, "dimensions": [2]})
    };
    let short = |id: &str, action: &str, function, rule: ClauseId, len| {
        let title = format!("{action}: {} of data", plural(len, "byte"));
        Scenario::new(format!("client-{id}-short"), title, action)
            .with(function, Tamper::Only(len))
            .expect(ExpectedAnswer::Error)
            .by(rule)
    };
    vec![
        describe("open", "the name ends with the reply", Tamper::Open)
            .gives(as_is(1, 1))
            .by(assumed(VAR_4)),
        describe("padded", "the name is padded to 256 bytes", Tamper::Padded(24))
            .gives(as_is(1, 1))
            .by(assumed(VAR_4)),
        describe("type", "an unknown type", Tamper::Patch(4, [77, 0, 0, 0]))
            .gives(as_is(77, 1))
            .by(assumed(VAR_23)),
        describe("access", "an unknown access", Tamper::Patch(8, [9, 0, 0, 0]))
            .gives(as_is(1, 9))
            .by(assumed(VAR_23)),
        describe(
            "dimensions",
            "more dimensions than the reply can hold",
            Tamper::Patch(16, [0xFF; 4]),
        )
        .expect(ExpectedAnswer::Error)
        .by(VAR_24),
        describe("short", "the reply ends within the dimensions", Tamper::Only(22))
            .expect(ExpectedAnswer::Error)
            .by(VAR_4),
        describe("empty", "the reply is empty", Tamper::Only(0))
            .expect(ExpectedAnswer::Error)
            .by(VAR_4),
        short("handle", "handle 1 V.E.vartest", Function::HandleByName, VAR_10, 3),
        short("count-variables", "count-variables 1 V.E", Function::CountVariables, VAR_2, 2),
        short("parameters", "count-parameters 1 P", Function::CountDynamic, DYN_1, 1),
        short("parameter", "parameter-by-name 1 P P1", Function::DynamicValueByName, DYN_3, 7),
        short("instance", "find-instance hld 1 0", Function::FindInstance, SDA_1, 4),
        short("extended", "describe-extended 1 3 V.E", Function::DescribeExtended, VAR_15, 6),
        short("element", "count-elements hld 1 0", Function::CountElements, SDA_4, 3),
        short("axis", "read-axis 1 2 V.A.WCS REAL64", Function::AxisReadByName, VAR_14, 7),
    ]
}

fn lists() -> Vec<Scenario> {
    let list = |id: &str, what: &str, tamper| {
        let title = format!("list-objects 1: {what}");
        Scenario::new(format!("client-list-{id}"), title, "list-objects 1")
            .with(Function::ReadDescriptors, tamper)
    };
    let right = |scenario: Scenario| scenario.expect(ExpectedAnswer::Asked(super::objects::list));
    vec![
        right(list("bytewise", "one byte at a time", Tamper::Bytewise)).by(ADS_5),
        right(list("late", "after the reply to the previous request", Tamper::Late))
            .by(assumed(ADS_5)),
        right(list("twice", "twice in one piece", Tamper::Twice)).by(assumed(ADS_5)),
        // The client requests the rest, or reports an error because the list is incomplete.
        Scenario {
            or_error: true,
            ..right(list("fewer", "fewer descriptors than requested", Tamper::Descriptors(5)))
        }
        .by(assumed(COM_3)),
        list("torn", "the last descriptor is truncated", Tamper::Less(1))
            .expect(ExpectedAnswer::Error)
            .by(COM_2),
        list("none", "no descriptors", Tamper::Only(0)).expect(ExpectedAnswer::Error).by(COM_2),
    ]
}
