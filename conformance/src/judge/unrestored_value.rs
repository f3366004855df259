//! Values that a run changed and did not restore.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A value that was changed and could not be restored.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnrestoredValue {
    /// The name of the value.
    pub name: String,
    /// The original value in hex, with a space between two bytes.
    pub was: String,
    /// The value after the last access, in the same format; `None` if the value could not be read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub is: Option<String>,
    /// Why the gate rejected the last write that should restore the value; `None` if the gate did
    /// not reject it.
    #[serde(rename = "refused", default, skip_serializing_if = "Option::is_none")]
    pub rejected: Option<String>,
}

/// The text on the console and in the formats HTML, JUnit and Markdown.
impl fmt::Display for UnrestoredValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, was, is, rejected } = self;
        let is = is.as_deref().unwrap_or("not known");
        write!(f, "LEFT CHANGED: {name}, was {was}, is {is}")?;
        match rejected {
            Some(why) => write!(f, " (not restored: {why})"),
            None => Ok(()),
        }
    }
}
