//! Scenarios with the instances of the classes of SDA and GEO, and their elements.

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;
use serde_json::{Value, json};

use crate::client_suite::Scenario;
use crate::client_suite::scenario::{ExpectedRequest, both, read, write};

fn element(attribute: u32, least: u32, rule: ClauseId) -> ExpectedRequest {
    read(552, 0x12_3301 + attribute, 1, least).of(rule, rule)
}

fn instance(id: &str, title: &str, class: (&str, u32), at: [u8; 2]) -> Scenario {
    let [channel, axis] = at;
    let action = format!("find-instance {} {channel} {axis}", class.0);
    Scenario::new(format!("client-instance-{id}"), title, action)
        .asks(both(class.1, 0, &[channel, 0, 0, 0, axis, 0, 0, 0], 8).of(SDA_1, SDA_1))
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let one = |id: &str, title: &str, word: &str| {
        let ty = if word == "read-element" { " BOOLEAN" } else { "" };
        let action = format!("{word} hld 1 0 1{ty}");
        Scenario::new(format!("client-element-{id}"), title, action)
    };
    vec![
        instance("hld", "The client finds the HLD of a channel", ("hld", 0x12_3900), [1, 0])
            .gives(json!([0x12_3301, 0])),
        instance(
            "decoder",
            "The client finds an axis of the decoder",
            ("decoder", 0x12_2900),
            [1, 2],
        )
        .gives(json!([0x12_2301, 0x2_0000])),
        instance("spindle", "The client finds the second spindle", ("spindle", 0x02_5900), [1, 0])
            .gives(json!([0x02_5301, 0])),
        instance(
            "none",
            "The client accepts that an instance does not exist",
            ("hld", 0x12_3900),
            [9, 0],
        )
        .by(SDA_2)
        .gives(Value::Null),
        Scenario::new(
            "client-count-elements",
            "The client reads the number of elements",
            "count-elements hld 1 0",
        )
        .asks(read(552, 0x12_3301, 0, 4).of(SDA_4, SDA_4))
        .gives(2),
        one("name", "The client reads the name of an element", "element-name")
            .asks(element(0x100, 16, SDA_6))
            .gives("feedhold.enable"),
        one("type", "The client reads the type of an element", "element-type")
            .asks(element(0x200, 8, SDA_7))
            .gives("BOOLEAN"),
        one("length", "The client reads the length of an element", "element-length")
            .asks(element(0x300, 4, SDA_8))
            .gives(1),
        one("unit", "The client reads the unit of an element", "element-unit")
            .asks(element(0x400, 2, SDA_6))
            .gives("-"),
        one("flag", "The client reads the write flag of an element", "element-writable")
            .asks(element(0x500, 1, SDA_9))
            .gives(false),
        one("content", "The client reads the content of an element", "read-element")
            .asks(element(0, 1, SDA_4))
            .gives(true),
        Scenario::new(
            "client-element-axis",
            "The client reads an element of an axis",
            "read-element decoder 1 2 1 REAL64",
        )
        .asks(read(552, 0x12_2301, 0x2_0001, 8).of(ADR_7, ADR_7))
        .gives(20.5),
        Scenario::new(
            "client-element-spindle",
            "The client reads the unit of an element of a spindle",
            "element-unit spindle 1 0 1",
        )
        .asks(read(552, 0x02_5701, 1, 6).of(SDA_6, SDA_6))
        .gives("1/min"),
        Scenario::new(
            "client-element-write",
            "The client writes an element",
            "write-element interpolator 1 0 1 UNS16 500",
        )
        .asks(write(552, 0x12_1301, 1, &[0xF4, 0x01]).of(SDA_9, SDA_9)),
    ]
}
