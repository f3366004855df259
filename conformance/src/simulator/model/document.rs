//! The structure of a model file, with positions (`Spanned`) for error messages.

use serde::Deserialize;
use toml::{Spanned, Value};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Document {
    pub(super) edition: Option<Spanned<String>>,
    pub(super) cnc_version: Option<Spanned<String>>,
    pub(super) spindles: Option<Spanned<u32>>,
    #[serde(default)]
    pub(super) axis: Vec<AxisTable>,
    #[serde(default)]
    pub(super) channel: Vec<ChannelTable>,
    #[serde(default)]
    pub(super) platform: ObjectTable,
    #[serde(default)]
    pub(super) platform_axis: ObjectTable,
    #[serde(default)]
    pub(super) channel_axis: ChannelAxisTable,
    #[serde(default)]
    pub(super) class: ClassesTable,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisTable {
    pub(super) name: Spanned<String>,
    pub(super) number: Option<Spanned<u32>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ChannelTable {
    pub(super) number: Spanned<u32>,
    pub(super) active: Option<bool>,
    #[serde(default)]
    pub(super) places: Vec<Spanned<u32>>,
    #[serde(default)]
    pub(super) objects: Vec<ObjectRow>,
    #[serde(default)]
    pub(super) variables: Vec<VariableRow>,
    #[serde(default)]
    pub(super) parameters: Vec<ParameterRow>,
    #[serde(default)]
    pub(super) streaming: StreamingTable,
    pub(super) service: Option<Spanned<ServiceTable>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StreamingTable {
    pub(super) file: Option<String>,
    pub(super) start: Option<Spanned<String>>,
    pub(super) pace: Option<Spanned<Value>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ServiceTable {
    pub(super) times: Option<Spanned<u32>>,
    pub(super) pause: Option<Spanned<String>>,
    pub(super) cycle: Option<Spanned<String>>,
    pub(super) requests: Spanned<Vec<RequestRow>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RequestRow {
    pub(super) uuid: Spanned<String>,
    pub(super) request: Spanned<String>,
    pub(super) state: Option<Spanned<u32>>,
    pub(super) wait: Option<Spanned<WaitTable>>,
}

/// Parameters of the cycle SysServiceWait.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "UPPERCASE")]
pub(super) struct WaitTable {
    pub(super) p1: Option<u32>,
    pub(super) p2: Option<u32>,
    pub(super) p3: Option<u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectTable {
    #[serde(default)]
    pub(super) objects: Vec<ObjectRow>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ChannelAxisTable {
    #[serde(default)]
    pub(super) objects: Vec<ObjectRow>,
    #[serde(default)]
    pub(super) variables: Vec<VariableRow>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct ClassesTable {
    #[serde(default)]
    pub(super) position_controller: AxisOnly,
    #[serde(default)]
    pub(super) interpolator: ClassTable,
    #[serde(default)]
    pub(super) decoder: ClassTable,
    #[serde(default)]
    pub(super) hld: ClassTable,
    #[serde(default)]
    pub(super) path_preparation: ClassTable,
    #[serde(default)]
    pub(super) spindle: SpindleOnly,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClassTable {
    #[serde(default)]
    pub(super) channel: ElementTable,
    #[serde(default)]
    pub(super) axis: ElementTable,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisOnly {
    #[serde(default)]
    pub(super) axis: ElementTable,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpindleOnly {
    #[serde(default)]
    pub(super) each: ElementTable,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ElementTable {
    pub(super) name: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) elements: Vec<ElementRow>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectRow {
    pub(super) name: Spanned<String>,
    pub(super) r#type: Spanned<String>,
    pub(super) offset: Spanned<u32>,
    pub(super) id: Option<Spanned<u32>>,
    pub(super) size: Option<Spanned<u32>>,
    #[serde(default)]
    pub(super) writable: bool,
    pub(super) value: Option<Spanned<Value>>,
    pub(super) values: Option<Spanned<Vec<Value>>>,
    pub(super) is: Option<Spanned<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ElementRow {
    pub(super) name: Spanned<String>,
    pub(super) r#type: Spanned<String>,
    pub(super) unit: Option<Spanned<String>>,
    pub(super) size: Option<Spanned<u32>>,
    #[serde(default)]
    pub(super) writable: bool,
    pub(super) value: Option<Spanned<Value>>,
    pub(super) values: Option<Spanned<Vec<Value>>>,
    pub(super) is: Option<Spanned<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VariableRow {
    pub(super) name: Spanned<String>,
    pub(super) r#type: Spanned<String>,
    pub(super) handle: Option<Spanned<u32>>,
    pub(super) dimensions: Option<Spanned<Vec<u32>>>,
    pub(super) size: Option<Spanned<u32>>,
    #[serde(default)]
    pub(super) writable: bool,
    pub(super) value: Option<Spanned<Value>>,
    pub(super) values: Option<Spanned<Vec<Value>>>,
    pub(super) synchronisation: Option<Spanned<String>>,
    pub(super) validity: Option<Spanned<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ParameterRow {
    pub(super) name: Spanned<String>,
    #[serde(default)]
    pub(super) value: f64,
    pub(super) r#while: Option<Spanned<String>>,
    pub(super) comes: Option<Spanned<String>>,
    pub(super) goes: Option<Spanned<String>>,
    pub(super) period: Option<Spanned<String>>,
}
