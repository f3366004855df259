//! Objects as JSON.

use serde::{Serialize, Serializer};
use serde_json::Value;

use super::ListedValue;
use crate::session::Session;
use crate::text::hex;
use crate::values::{JSON_DIMENSIONS_MAX, value_of};

/// The objects of a target in the form of the JSON output; see `schema/objects.schema.json`. The
/// objects are an iterator, so that the values of all objects are not in memory at the same time.
#[derive(Clone, Debug, Serialize)]
#[serde(bound = "I: Iterator<Item = ObjectReport> + Clone")]
pub struct ObjectsReport<I> {
    pub format: u32,
    /// TCP address of the target.
    pub target: String,
    /// AMS NetId of the target.
    pub net_id: String,
    /// Whether the target is a simulated CNC that this process started.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub simulated: bool,
    #[serde(serialize_with = "in_sequence")]
    pub objects: I,
    /// Notes, for example about objects that could not be read.
    pub notes: Vec<String>,
}

fn in_sequence<S: Serializer>(
    objects: &(impl Iterator<Item = ObjectReport> + Clone),
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(objects.clone())
}

impl<I> ObjectsReport<I> {
    /// Creates the report for the target of a session.
    pub fn new(session: &Session, objects: I, notes: Vec<String>) -> Self {
        let (target, simulated) = (session.target(), session.is_simulated());
        let (target, net_id) = (target.addr.to_string(), target.net_id.to_string());
        Self { format: 1, target, net_id, simulated, objects, notes }
    }
}

#[derive(Clone, Debug, Serialize)]
pub struct ObjectReport {
    pub list: String,
    pub name: String,
    /// Name of the type.
    pub r#type: Option<String>,
    /// Number of elements in each dimension.
    pub dimensions: Vec<u32>,
    /// Size of the value in bytes.
    pub size: Option<u32>,
    pub unit: Option<String>,
    /// `R`, `RW`, or the code in the description of a variable if no manual documents the code;
    /// `None` if unknown.
    pub access: Option<String>,
    /// AMS port of the task that serves the content; `None` for a variable or a parameter.
    pub port: Option<u16>,
    /// Index group of the content; `None` for a variable or a parameter.
    pub group: Option<u32>,
    /// Index offset of the content; `None` for a variable or a parameter.
    pub offset: Option<u32>,
    /// Handle of a variable.
    pub handle: Option<u32>,
    /// The bytes of the value in hex, if they were read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hex: Option<String>,
    /// The value, if it was read and its bytes match its type.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// The reason why the value could not be read, or is not in `value`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

impl From<&ListedValue> for ObjectReport {
    fn from(object: &ListedValue) -> Self {
        let text = |text: String| Some(text).filter(|text| !text.is_empty());
        let address = object.address.content();
        Self {
            list: object.list.to_string(),
            name: object.name.to_string(),
            r#type: text(object.ty.name.clone()),
            dimensions: object.ty.dimensions.clone(),
            size: object.ty.size,
            unit: object.unit.as_ref().map(ToString::to_string),
            access: text(object.access.to_string()),
            port: address.map(|_| object.address.task().port().0),
            group: address.map(|(group, _)| group.get()),
            offset: address.map(|(_, offset)| offset.get()),
            handle: object.handle.map(|handle| handle.0),
            hex: None,
            value: None,
            error: None,
        }
    }
}

impl ObjectReport {
    /// Creates the entry of an object with the bytes of its value, or with the reason why the value
    /// could not be read.
    pub fn read(object: &ListedValue, content: &Result<Vec<u8>, String>) -> Self {
        let report = Self::from(object);
        match content {
            Ok(bytes) => {
                let (hex, value) = (Some(hex::spaced(bytes)), value_of(&object.ty, bytes));
                let count = object.ty.dimensions.len();
                let error = (count > JSON_DIMENSIONS_MAX).then(|| {
                    format!(
                        "the value has {count} dimensions; a value in JSON has at most \
                         {JSON_DIMENSIONS_MAX}"
                    )
                });
                Self { hex, value, error, ..report }
            }
            Err(error) => Self { error: Some(error.clone()), ..report },
        }
    }
}
