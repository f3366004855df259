//! Instances of the classes of SDA and GEO, and their elements.

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;
use serde_json::{Value, json};

use crate::clients::Scenario;
use crate::clients::scenario::{ExpectedRequest, both, read, write};

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
        instance("hld", "It finds the HLD of a channel", ("hld", 0x12_3900), [1, 0])
            .gives(json!([0x12_3301, 0])),
        instance("decoder", "It finds an axis of the decoder", ("decoder", 0x12_2900), [1, 2])
            .gives(json!([0x12_2301, 0x2_0000])),
        instance("spindle", "It finds the second spindle", ("spindle", 0x02_5900), [1, 0])
            .gives(json!([0x02_5301, 0])),
        instance("none", "It takes that there is no such instance", ("hld", 0x12_3900), [9, 0])
            .by(SDA_2)
            .gives(Value::Null),
        Scenario::new("client-count-elements", "It counts elements", "count-elements hld 1 0")
            .asks(read(552, 0x12_3301, 0, 4).of(SDA_4, SDA_4))
            .gives(2),
        one("name", "It reads an element's name", "element-name")
            .asks(element(0x100, 16, SDA_6))
            .gives("feedhold.enable"),
        one("type", "It reads its type", "element-type")
            .asks(element(0x200, 8, SDA_7))
            .gives("BOOLEAN"),
        one("length", "It reads its length", "element-length")
            .asks(element(0x300, 4, SDA_8))
            .gives(1),
        one("unit", "It reads its unit", "element-unit").asks(element(0x400, 2, SDA_6)).gives("-"),
        one("flag", "It reads whether it may be written", "element-writable")
            .asks(element(0x500, 1, SDA_9))
            .gives(false),
        one("content", "It reads its content", "read-element")
            .asks(element(0, 1, SDA_4))
            .gives(true),
        Scenario::new(
            "client-element-axis",
            "It reads an element of an axis",
            "read-element decoder 1 2 1 REAL64",
        )
        .asks(read(552, 0x12_2301, 0x2_0001, 8).of(ADR_7, ADR_7))
        .gives(20.5),
        Scenario::new(
            "client-element-spindle",
            "It reads the unit of an element of a spindle",
            "element-unit spindle 1 0 1",
        )
        .asks(read(552, 0x02_5701, 1, 6).of(SDA_6, SDA_6))
        .gives("1/min"),
        Scenario::new(
            "client-element-write",
            "It writes an element",
            "write-element interpolator 1 0 1 UNS16 500",
        )
        .asks(write(552, 0x12_1301, 1, &[0xF4, 0x01]).of(SDA_9, SDA_9)),
    ]
}
