//! Device information.

use std::fmt;

use ads_cnc::ads::{AdsState, DeviceInfoReply};
use serde::{Deserialize, Serialize};

use crate::text::escape;

/// The device information that a device returns.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeviceReport {
    pub name: String,
    /// The version: three numbers separated by dots.
    pub version: String,
    /// ADS state: `RUN`, `STOP`, `CONFIG` or a number; `None` if the device does not return it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

impl DeviceReport {
    /// Creates the report from the replies.
    pub fn new(info: &DeviceInfoReply, state: Option<AdsState>) -> Self {
        let DeviceInfoReply { major, minor, build, .. } = info;
        let version = format!("{major}.{minor}.{build}");
        let state = state.map(|state| match state {
            AdsState::RUN => "RUN".to_owned(),
            AdsState::STOP => "STOP".to_owned(),
            AdsState::CONFIG => "CONFIG".to_owned(),
            AdsState(number) => number.to_string(),
        });
        Self { name: info.name().to_string(), version, state }
    }
}

impl fmt::Display for DeviceReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Escaped, because the device may send control characters.
        write!(f, "\"{}\" {}", escape(&self.name), self.version)?;
        self.state.iter().try_for_each(|state| write!(f, ", state {state}"))
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::ads::AdsError;

    use super::*;

    #[test]
    fn a_device_is_shown_with_its_state() {
        let name = *b"CNC\x1B[2J\0and more";
        let result = AdsError::NO_ERROR;
        let info = DeviceInfoReply { result, major: 3, minor: 1, build: 4024, name };
        let shown = |state| DeviceReport::new(&info, state).to_string();
        assert_eq!(shown(None), r#""CNC\u{1b}[2J" 3.1.4024"#);
        assert_eq!(shown(Some(AdsState::CONFIG)), r#""CNC\u{1b}[2J" 3.1.4024, state CONFIG"#);
        assert_eq!(shown(Some(AdsState(11))), r#""CNC\u{1b}[2J" 3.1.4024, state 11"#);
    }
}
