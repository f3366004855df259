//! Scenarios with the objects of the COM task.

use ads_cnc::operation::{ObjectList, ReadDescriptors};
use ads_cnc::{Decode as _, DescriptorsRef};
use ads_cnc_vectors::ids::*;
use serde_json::{Value, json};

use crate::client_suite::Scenario;
use crate::client_suite::scenario::{ExpectedAnswer, ExpectedRequest, ReadLength, read, write};
use crate::client_suite::script::ScenarioScript;

/// Number of objects in the list of channel 1 in the default model: 19 objects of the channel, 2 of
/// the platform, and 3 for each of three axes.
const COUNT: u32 = 30;

fn content(offset: u32, size: u32) -> ExpectedRequest {
    read(553, 0x12_0101, offset, size).of(COM_5, COM_5)
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let count = |group| read(553, group, 0, 4).of(COM_1, COM_1);
    let descriptors =
        ExpectedRequest { length: ReadLength::Times(84), ..read(553, 0x13_0101, 1, 84) };
    vec![
        Scenario::new(
            "client-count-objects",
            "The client reads the number of objects",
            "count-objects 1",
        )
        .asks(count(0x13_0101))
        .gives(COUNT),
        Scenario::new(
            "client-count-objects-6",
            "The client reads the number of objects of channel 6",
            "count-objects 6",
        )
        .asks(count(0x13_0106))
        .gives(12),
        Scenario::new("client-list-objects", "The client lists the objects", "list-objects 1")
            .asks(descriptors.of(COM_2, COM_2))
            .by(COM_2)
            .expect(ExpectedAnswer::Asked(list)),
        Scenario::new(
            "client-read-object",
            "The client reads an object at the address in its descriptor",
            "read-object 1 example_lreal_w",
        )
        .asks(content(0x1A, 8))
        .gives(1234.5678),
        Scenario::new(
            "client-read-object-unsigned",
            "The client reads a DWORD as an unsigned number",
            "read-object 1 example_dword_r",
        )
        .asks(content(0x15, 4))
        .gives(0xDEAD_BEEF_u32),
        Scenario::new(
            "client-read-object-long",
            "The client reads a LINT of eight bytes",
            "read-object 1 example_lint_w",
        )
        .asks(content(0x18, 8))
        .gives(i64::MIN),
        Scenario::new(
            "client-read-object-text",
            "The client reads a STRING as CP1252",
            "read-object 1 example_string_r",
        )
        .asks(content(0x1B, 21))
        .by(GEN_3)
        .gives("Länge 5€"),
        Scenario::new(
            "client-read-object-full-name",
            "The client finds an object with a name of 32 bytes",
            "read-object 1 example_name_of_32_characters__r",
        )
        .asks(content(0x1C, 1))
        .gives(false),
        Scenario::new(
            "client-write-object",
            "The client writes an object at the address in its descriptor",
            "write-object 1 mc_command_single_block_w TRUE",
        )
        .asks(write(553, 0x12_0101, 1, &[1]).of(COM_5, COM_5)),
        Scenario::new(
            "client-write-object-real",
            "The client writes an LREAL",
            "write-object 1 example_lreal_w -2.5",
        )
        .asks(write(553, 0x12_0101, 0x1A, &[0, 0, 0, 0, 0, 0, 0x04, 0xC0]).of(COM_5, GEN_1)),
        Scenario::new(
            "client-write-object-signed",
            "The client writes a negative INT",
            "write-object 1 example_int_w -2",
        )
        .asks(write(553, 0x12_0101, 0x14, &[0xFE, 0xFF]).of(COM_5, GEN_1)),
    ]
}

/// The expected list of objects, according to the descriptors of the simulated CNC.
pub(super) fn list(script: &ScenarioScript) -> Option<Value> {
    let channel = ads_cnc::address::Channel::new(1).ok()?;
    let read = ReadDescriptors::new(ObjectList::from(channel), 1, COUNT).ok()?;
    let reply = script.ask(read)?;
    let each = DescriptorsRef::decode(&reply).ok()?;
    let object = each.iter().map(|object| {
        json!({
            "name": object.name().to_string(),
            "type": object.type_name().to_string(),
            "size": object.size(),
            "writable": object.write_access().0 != 0,
            "group": object.index_group().get(),
            "offset": object.index_offset().get(),
        })
    });
    Some(object.collect())
}
