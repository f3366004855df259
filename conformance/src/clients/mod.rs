//! Clients under test: the suite is the CNC, tells a client what to do, judges the bytes it sends,
//! and sees what it makes of replies that are not what they should be.
//!
//! The protocol is described in `adapters/CLIENTS.md`. [`ClientProcess`] is a client that is started
//! by a command, [`ReferenceClient`] this project's, which can be told to be wrong: [`defects`].

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
    ClientDefect, Flaw, ReferenceClient, answer, defects, find_defect, habits,
};
pub use scenario::Scenario;
pub use scenarios::scenarios;
pub use test_server::TestServer;

/// Who is put through scenarios.
pub trait Actor {
    /// Asks who it is and what it knows.
    fn hello(&mut self, place: &CncAddress) -> Result<ClientHello, ClientReaction>;

    /// Tells it to do something; one that has ended before is started anew.
    fn act(&mut self, place: &CncAddress, scenario: &str, action: &Action) -> ClientReaction;

    /// Lets it end.
    fn bye(&mut self) -> Result<(), String>;

    /// The lines it has sent beyond its answers since the last call.
    fn unasked(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// The reason why no further action may be sent; `None` if one may.
    fn over(&self) -> Option<String> {
        None
    }

    /// What it had to say beside its answers.
    fn stderr(&self) -> String {
        String::new()
    }
}
