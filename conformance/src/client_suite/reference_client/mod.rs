//! This project's client, optionally with a defect. It is an example of the client protocol, and
//! the self-test tests the suite with it.

mod actions;
mod apply_defect;
mod connection;
mod defects;
mod error;
mod service;
mod streaming;

use std::time::Duration;

pub use defects::{ClientDefect, ClientFault, defects, find_defect, variants};

use super::message::{ActionResult, ClientHello, ClientReaction, CncAddress, PROTOCOL};
use super::{Action, ClientUnderTest, VOCABULARY};
use crate::codec::message::Identity;
use connection::Connection;
use error::ActionError;

/// This project's client, run in this process.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReferenceClient {
    pub fault: Option<ClientFault>,
}

impl ReferenceClient {
    pub fn hello() -> ClientHello {
        ClientHello {
            protocol: PROTOCOL,
            client: Identity {
                name: "ads-cnc".to_owned(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
                language: "Rust".to_owned(),
            },
            actions: VOCABULARY.iter().map(|word| word.name.to_owned()).collect(),
            stays: true,
        }
    }
}

impl ClientUnderTest for ReferenceClient {
    fn hello(&mut self, _: &CncAddress) -> Result<ClientHello, ClientReaction> {
        Ok(Self::hello())
    }

    fn act(&mut self, cnc_address: &CncAddress, _: &str, action: &Action) -> ClientReaction {
        answer(self.fault, cnc_address, action)
    }

    fn bye(&mut self) -> Result<(), String> {
        Ok(())
    }
}

/// Executes an action. If a defect makes the client crash or hang, only the returned value says so,
/// and this process continues.
pub fn answer(
    fault: Option<ClientFault>,
    cnc_address: &CncAddress,
    action: &Action,
) -> ClientReaction {
    if fault == Some(ClientFault::Garbles) {
        return ClientReaction::Garbled("done!".to_owned());
    }
    let done = Connection::connect(cnc_address, fault)
        .and_then(|mut wire| actions::act(&mut wire, action));
    match done {
        Ok(value) => ClientReaction::Answer(ActionResult::Result(value)),
        Err(ActionError::Error(why)) => ClientReaction::Answer(ActionResult::Error(why)),
        Err(ActionError::Rejected(error)) => ClientReaction::Answer(ActionResult::Error(format!(
            "the CNC returned ADS error {error:#x}"
        ))),
        Err(ActionError::Dies) => ClientReaction::Died("it crashed".to_owned()),
        Err(ActionError::Hangs) => ClientReaction::Silent(Duration::MAX),
    }
}
