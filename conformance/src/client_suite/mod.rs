//! Tests clients: the suite acts as the CNC, tells a client what to do, and judges its requests and
//! its answers, also after invalid replies. A client that takes no actions is judged only by its
//! requests.
//!
//! `adapters/CLIENTS.md` specifies the protocol. [`ClientProcess`] is a client that is started by a
//! command; [`ReferenceClient`] is this project's client, optionally with one of its [`defects`].

mod action;
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
mod scenario_checks;
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
    /// Returns the client's name and the actions that it implements.
    fn hello(&mut self, cnc_address: &CncAddress) -> Result<ClientHello, ClientReaction>;

    /// Tells the client to execute an action. A process that has ended is restarted.
    fn act(&mut self, cnc_address: &CncAddress, scenario: &str, action: &Action) -> ClientReaction;

    /// Tells the client to exit, and checks its exit code.
    fn bye(&mut self) -> Result<(), String>;

    /// Lines that the client has printed in addition to its answers since the last call.
    fn unasked(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// Why the suite may send no more actions to the client; `None` if it may.
    fn over(&self) -> Option<String> {
        None
    }

    /// The end of the client's output to stderr.
    fn stderr(&self) -> String {
        String::new()
    }
}
