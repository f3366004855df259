//! Scenarios with the examples printed in the manuals. The suite compares the client's request with
//! the bytes of the vectors, and replies with such bytes, without the codec.

use ads_cnc_vectors::{AdsService, Direction, Vector, vector};
use serde_json::{Value, json};

use crate::client_suite::Scenario;
use crate::client_suite::literal::Literal;
use crate::client_suite::scenario::ExpectedRequest;
use crate::judge::Rule;

/// The action, the expected result and the vector of each example. The vector contains the reply
/// or, for a write, the request.
fn examples() -> Vec<(&'static str, Value, &'static str)> {
    let array = json!([123, 234, 345, 456, 567]);
    vec![
        ("parameter-name 1 P 1", json!("P1"), "dynamic-name-printed"),
        ("parameter-by-name 1 P P1", json!(4711), "dynamic-value-printed"),
        ("count-parameters 1 P", json!(1), "dynamic-count-printed"),
        ("find-instance hld 1 0", json!([0x12_3301, 0]), "address-printed-hld-channel-1"),
        ("find-instance hld 2 0", json!([0x12_3302, 0]), "address-printed-hld-channel-2"),
        (
            "find-instance hld 0 1",
            json!([0x12_3300, 0x1000]),
            "address-printed-hld-platform-axis-1",
        ),
        (
            "find-instance decoder 1 2",
            json!([0x12_2301, 0x2_0000]),
            "address-printed-decoder-axis-2",
        ),
        ("element-name hld 1 0 1", json!("feedhold.enable"), "element-name-printed"),
        ("element-type hld 1 0 1", json!("BOOLEAN"), "element-type-printed"),
        ("element-length hld 1 0 1", json!(1), "element-length-printed"),
        ("element-unit hld 1 0 1", json!("-"), "element-unit-printed"),
        ("element-writable hld 1 0 1", json!(false), "write-flag-printed"),
        ("read-element hld 1 0 1 BOOLEAN", json!(true), "content-printed-feedhold-1"),
        ("count-variables 1 V.E", json!(123), "count-printed-123"),
        (
            "describe 1 2 V.E",
            json!({"name": "V.E.Variable_3", "handle": 0x200_0002, "type": 1, "access": 1,
                "size": 2, "dimensions": [2]}),
            "description-printed-boolean-array",
        ),
        (
            "describe-extended 1 3 V.E",
            json!({"synchronisation": 2, "validity": 2}),
            "extended-printed",
        ),
        ("handle 1 V.E.vartest", json!(0x200_0004), "handle-printed"),
        ("read-by-handle 1 536945473 4 SGN32", json!(333), "value-printed-handle-element"),
        ("read-by-handle 1 33559092 - SGN32[5]", array.clone(), "value-printed-handle-array"),
        ("read-by-name 1 V.E.Testvar[3] SGN32", json!(333), "value-printed-name-element"),
        ("read-by-name 1 V.E.Testvar SGN32[5]", array, "value-printed-name-array"),
        ("axis-handle 1 2 V.A.WCS", json!(0x0102_001B), "axis-handle-printed"),
        ("read-axis 1 2 V.A.WCS REAL64", json!(1234.2), "axis-value-printed"),
        ("write-by-handle 1 33559092 4 SGN32 123", Value::Null, "handle-write-printed-element"),
        (
            "write-by-handle 1 33559092 - SGN32[5] 123,234,345,456,567",
            Value::Null,
            "handle-write-printed-array",
        ),
        ("write-by-name 1 V.E.test[4] SGN32 123", Value::Null, "name-write-printed-element"),
        (
            "write-by-name 1 V.E.test SGN32[5] 123,234,345,456,567",
            Value::Null,
            "name-write-printed-array",
        ),
        ("write-axis 1 2 V.A.WCS REAL64 123.456", Value::Null, "axis-write-printed"),
    ]
}

pub(super) fn scenarios() -> Vec<Scenario> {
    examples().into_iter().filter_map(|(action, result, id)| one(action, result, id)).collect()
}

fn one(action: &str, result: Value, id: &str) -> Option<Scenario> {
    let example = vector(id)?;
    let literal = literal(example)?;
    let rule = Rule::of(example.cited().first()?.id.as_str());
    let ask = ExpectedRequest {
        command: literal.command.into(),
        ..crate::client_suite::scenario::write(
            literal.port,
            literal.group,
            literal.offset,
            &literal.data,
        )
    };
    let mut filled = literal.data.clone();
    filled.resize(literal.padded.max(filled.len()), 0);
    let ask = ask.also(&filled);
    let scenario = Scenario::new(format!("client-printed-{id}"), example.title.clone(), action)
        .asks(ask.of(rule, rule))
        .by(rule);
    let scenario = match (literal.command, result) {
        (3, _) => scenario,
        (_, result) => scenario.gives(result),
    };
    Some(Scenario { literal: Some(literal), ..scenario })
}

/// The request and the reply of an example.
fn literal(example: &Vector) -> Option<Literal> {
    let context = &example.context;
    let is_request = example.direction == Direction::Request;
    let (command, has_request) = match context.service? {
        AdsService::Read => (2, false),
        AdsService::Write => (3, true),
        AdsService::ReadWrite => (9, true),
    };
    let request = if is_request {
        example.bytes()
    } else if has_request {
        vector(context.request.as_deref()?)?.bytes()
    } else {
        Vec::new()
    };
    let padded = match context.request.as_deref().and_then(vector).map(|one| one.stream.as_str()) {
        Some("variable-name") => 256,
        Some("dynamic-name-request") => 96,
        _ => 0,
    };
    let reply = if is_request { Vec::new() } else { example.bytes() };
    Some(Literal {
        command,
        port: 552,
        group: context.index_group?,
        offset: context.index_offset?,
        data: request,
        padded,
        reply,
    })
}

/// Printed examples without a scenario.
#[cfg(test)]
const NOT_COVERED: &[&str] = &[
    // A name with a space, which one edition prints, and the content FALSE: the other printed name
    // and the content TRUE have scenarios.
    "description-printed-table-name",
    "content-printed-feedhold-0",
    // A descriptor, which a client only receives inside a list.
    "descriptor-printed",
];

#[cfg(test)]
mod tests {
    use ads_cnc_vectors::{ProvenanceKind, vectors};

    use super::*;

    #[test]
    fn every_printed_example_has_a_scenario_or_is_listed() {
        let covered: Vec<&str> = examples().into_iter().map(|(.., id)| id).collect();
        assert_eq!(scenarios().len(), covered.len());
        for one in vectors() {
            let printed = one.provenance.kind == ProvenanceKind::Manual
                && one.context.service.is_some()
                && (one.direction == Direction::Reply
                    || one.context.service == Some(AdsService::Write));
            let id = one.id.as_str();
            assert!(!printed || covered.contains(&id) || NOT_COVERED.contains(&id), "{id}");
        }
    }
}
