//! The messages of the client protocol: lines of JSON, and environment variables.

use std::net::SocketAddr;

use ads_cnc::ads::AmsNetId;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::Action;
use crate::codec::message::Identity;
use crate::text::shorten;

pub const PROTOCOL: u32 = 1;

/// A client's answer to hello.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClientHello {
    /// Version of the client protocol that the client implements.
    pub protocol: u32,
    pub client: Identity,
    /// The names of the actions that the client implements.
    pub actions: Vec<String>,
    /// Whether the client keeps running and reads actions from stdin. If false, it is started for
    /// each action.
    #[serde(default)]
    pub stays: bool,
}

/// The address of the CNC to which a client connects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CncAddress {
    /// The IP address and TCP port of the CNC.
    pub addr: SocketAddr,
    /// The AMS NetId of the CNC.
    pub net_id: AmsNetId,
    /// The AMS port of the task that serves the action.
    pub port: u16,
}

/// The line that tells a running client to execute an action.
pub(super) fn action_command(cnc_address: &CncAddress, scenario: &str, action: &Action) -> Value {
    json!({
        "cmd": "do",
        "scenario": scenario,
        "action": action.action,
        "args": action.args,
        "address": cnc_address.addr.to_string(),
        "host": cnc_address.addr.ip().to_string(),
        "tcp_port": cnc_address.addr.port(),
        "net_id": cnc_address.net_id.to_string(),
        "port": cnc_address.port,
    })
}

/// The environment variables with which the suite starts a client: for hello and, unless the client
/// keeps running, for each action.
pub(super) fn environment(
    cnc_address: &CncAddress,
    scenario: &str,
    action: &str,
) -> [(&'static str, String); 8] {
    [
        ("ADS_CNC_PROTOCOL", PROTOCOL.to_string()),
        ("ADS_CNC_ADDRESS", cnc_address.addr.to_string()),
        ("ADS_CNC_HOST", cnc_address.addr.ip().to_string()),
        ("ADS_CNC_TCP_PORT", cnc_address.addr.port().to_string()),
        ("ADS_CNC_NET_ID", cnc_address.net_id.to_string()),
        ("ADS_CNC_PORT", cnc_address.port.to_string()),
        ("ADS_CNC_SCENARIO", scenario.to_owned()),
        ("ADS_CNC_DO", action.to_owned()),
    ]
}

/// Maximum number of characters of a client's answer in a message.
const SHOWN: usize = 200;

/// The result that this project's client returns for an action without a value.
pub(super) const DONE: Value = Value::Bool(true);

/// The result of an action in the client's answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ActionResult {
    Result(Value),
    /// The action failed: for example, the CNC rejected a request, or its reply was invalid.
    Error(String),
    /// The client does not implement the action.
    Unsupported(String),
}

/// The reaction of a client to an action.
pub type ClientReaction = crate::process::Reaction<ActionResult>;

impl std::fmt::Display for ClientReaction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Answer(ActionResult::Result(value)) => {
                write!(f, "the result {}", shorten(&value.to_string(), SHOWN))
            }
            Self::Answer(ActionResult::Error(why)) => {
                write!(f, "the error {:?}", shorten(why, SHOWN))
            }
            Self::Answer(ActionResult::Unsupported(what)) => {
                write!(f, "unsupported: {}", shorten(what, SHOWN))
            }
            Self::Garbled(what) => write!(f, "invalid answer: {what}"),
            Self::Died(how) => {
                write!(f, "it died: {}", how.strip_prefix("it ended, ").unwrap_or(how))
            }
            Self::Silent(time) => write!(f, "it hung: no answer within {} ms", time.as_millis()),
            Self::Broken(why) => f.write_str(why),
        }
    }
}
