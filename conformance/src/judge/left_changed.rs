//! What a run left changed.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A value that was changed and could not be restored.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeftChanged {
    /// What it is the value of.
    pub name: String,
    /// What it was, in hex.
    pub was: String,
    /// What it is, in hex, as it was read or written last; none if that is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub is: Option<String>,
    /// Why the suite sent no write that restores it, if it sent none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
}

/// As every form of a report says it.
impl fmt::Display for LeftChanged {
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
