//! Values that a run changed and did not restore.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A value that was changed and could not be restored.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnrestoredValue {
    /// The name of the value.
    pub name: String,
    /// The original value in hex.
    pub was: String,
    /// The last value read or written, in hex; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub is: Option<String>,
    /// Why no write was sent to restore the value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
}

/// The text in every format of the report.
impl fmt::Display for UnrestoredValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, was, is, refused } = self;
        let is = is.as_deref().unwrap_or("not known");
        write!(f, "LEFT CHANGED: {name}, was {was}, is {is}")?;
        match refused {
            Some(why) => write!(f, " (not restored: {why})"),
            None => Ok(()),
        }
    }
}
