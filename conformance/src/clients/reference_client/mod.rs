//! This project's client, as an example and to try the suite with: right, or wrong on purpose.

mod actions;
mod defects;
mod error;
mod faults;
mod service;
mod streaming;
mod wire;

use std::time::Duration;

use serde_json::Value;

pub use defects::{Defect, Flaw, defects, find_defect, habits};

use super::message::{Answer, CncAddress, Hello, Identity, PROTOCOL, Reaction};
use super::{Action, Actor, VOCABULARY};
use error::Fail;
use wire::Connection;

/// This project's client, in this process.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReferenceClient {
    pub flaw: Option<Flaw>,
}

impl ReferenceClient {
    pub fn hello() -> Hello {
        Hello {
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

impl Actor for ReferenceClient {
    fn hello(&mut self, _: &CncAddress) -> Result<Hello, Reaction> {
        Ok(Self::hello())
    }

    fn act(&mut self, place: &CncAddress, _: &str, action: &Action) -> Reaction {
        answer(self.flaw, place, action)
    }

    fn bye(&mut self) -> Result<(), String> {
        Ok(())
    }
}

/// What comes of an action; a death and a hang are only told, so that it can be done in a process
/// that goes on.
pub fn answer(flaw: Option<Flaw>, place: &CncAddress, action: &Action) -> Reaction {
    if flaw == Some(Flaw::Garbles) {
        return Reaction::Garbled("done!".to_owned());
    }
    let done =
        Connection::connect(place, flaw).and_then(|mut wire| actions::act(&mut wire, action));
    match done {
        Ok(value) => Reaction::Answer(Answer::Result(value)),
        Err(Fail::Said(why)) => Reaction::Answer(Answer::Error(why)),
        Err(Fail::Refused(error)) => {
            Reaction::Answer(Answer::Error(format!("the CNC refuses it, ADS error {error:#x}")))
        }
        Err(Fail::Dies) => Reaction::Died("it would have ended here".to_owned()),
        Err(Fail::Hangs) => Reaction::Silent(Duration::MAX),
    }
}

/// Nothing to say but that it is done.
const DONE: Value = Value::Bool(true);
