//! Clients under test: the suite is the CNC, tells a client what to do, judges the bytes it sends,
//! and sees what it makes of replies that are not what they should be.
//!
//! The protocol is described in `adapters/CLIENTS.md`. [`Process`] is a client that is started by a
//! command, [`Own`] this project's, which can be told to be wrong: [`defects`].

mod action;
mod asked;
mod findings;
mod judge;
mod knob;
mod literal;
mod message;
mod own;
mod passive;
mod process;
mod requests;
mod result;
mod scenario;
mod scenarios;
mod script;
mod stage;
mod watch;

pub use action::{Action, VOCABULARY, Word};
pub use judge::{Judged, judge, trial};
pub use message::{Answer, Hello, Identity, PROTOCOL, Place, Reaction};
pub use own::{Defect, Flaw, Own, answer, defects, find_defect, habits};
pub use passive::{listen, requests_case};
pub use process::Process;
pub use scenario::Scenario;
pub use scenarios::scenarios;
pub use stage::Stage;

/// Who is put through scenarios.
pub trait Actor {
    /// Asks who it is and what it knows.
    ///
    /// # Errors
    /// Whatever it did instead of saying so.
    fn hello(&mut self, place: &Place) -> Result<Hello, Reaction>;

    /// Tells it to do something; one that has ended before is started anew.
    fn act(&mut self, place: &Place, scenario: &str, action: &Action) -> Reaction;

    /// Lets it end.
    ///
    /// # Errors
    /// How it ended otherwise than it should.
    fn bye(&mut self) -> Result<(), String>;

    /// The lines it has said beyond its answers since this was asked last.
    fn unasked(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// Why it is not to be told any more.
    fn over(&self) -> Option<String> {
        None
    }

    /// What it had to say beside its answers.
    fn stderr(&self) -> String {
        String::new()
    }
}
