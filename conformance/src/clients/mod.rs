//! Clients under test: the suite acts as the CNC, tells a client what to do, and judges the
//! requests it sends and its reaction to invalid replies.
//!
//! The protocol is described in `adapters/CLIENTS.md`. [`ClientProcess`] is a client that is
//! started by a command, [`ReferenceClient`] that of this project, optionally with a defect:
//! [`defects`].

mod action;
mod findings;
mod judge;
mod literal;
mod message;
mod ordering;
mod passive;
mod process;
mod reference_client;
mod request_match;
mod requests;
mod result;
mod scenario;
#[allow(clippy::restriction)]
mod scenarios;
mod script;
mod tamper;
mod test_server;

pub use action::{Action, ActionWord, VOCABULARY};
pub use judge::{JudgedClient, judge, trial};
pub use message::{ActionResult, ClientHello, ClientReaction, CncAddress, PROTOCOL};
pub use passive::{listen, requests_case};
pub use process::ClientProcess;
pub use reference_client::{
    ClientDefect, ClientFault, ReferenceClient, answer, defects, find_defect, variants,
};
pub use scenario::Scenario;
pub use scenarios::scenarios;
pub use test_server::TestServer;

/// A client under test.
pub trait ClientUnderTest {
    /// Asks for its name and the actions it implements.
    fn hello(&mut self, place: &CncAddress) -> Result<ClientHello, ClientReaction>;

    /// Tells it to do an action; a process that has ended is started again.
    fn act(&mut self, place: &CncAddress, scenario: &str, action: &Action) -> ClientReaction;

    /// Tells it to end.
    fn bye(&mut self) -> Result<(), String>;

    /// The lines it has printed in addition to its answers since the last call.
    fn unasked(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// The reason why no further action may be sent; `None` if one may.
    fn over(&self) -> Option<String> {
        None
    }

    /// Its output to stderr.
    fn stderr(&self) -> String {
        String::new()
    }
}
