//! NC programs: what runs in a channel, as far as streams and services see it.
//!
//! - [`StreamingProgram`]: the streaming program. It gets its lines through the streaming interface
//!   and runs them at a settable pace.
//! - [`Script`]: a program that asks services through the Service Interface, over and over.
//! - [`StreamingInterface`], [`service`]: the interfaces themselves, and one request of a program.
//!
//! Both are without thread, clock and socket. Whoever has one tells it the time, which is since
//! any start and never goes back, before each access; it makes up for what has passed. How often
//! that is done changes nothing but how soon it shows.
//!
//! ```
//! use std::time::Duration;
//!
//! use ads_cnc::streaming::Ack;
//! use ads_cnc_conformance::simulator::program::{Pace, StreamingProgram, ProgramConfig, State};
//!
//! let at = Duration::from_millis;
//! let pace = Pace::lines_per_second(10).unwrap();
//! let mut program = StreamingProgram::new(ProgramConfig { pace, ..ProgramConfig::default() });
//! assert_eq!(program.write(b"N10 G01 X20\r\nN20 $GOTO N10\r\nN10: X2\r\n", at(0)), Ack::Accepted);
//! program.advance(at(250));
//! assert_eq!(program.executed().line_count(), 2);
//! program.advance(at(300));
//! assert_eq!(program.state(), State::Dry);
//!
//! program.write(b"N30 $GOTO N10\r\n", at(1000));
//! let State::Aborted(message) = program.state() else { panic!() };
//! assert_eq!(message.to_string(), "streaming.nc:4:5: $GOTO back to line 3");
//! ```

mod answer;
mod executed;
mod interface;
mod pace;
mod policy;
mod script;
mod segment;
pub mod service;
mod state;
mod stream;

pub use answer::{ServiceAnswer, ServiceOutcome};
pub(crate) use executed::lines;
pub use executed::{Executed, digest};
pub use interface::StreamingInterface;
pub use pace::{Pace, ParsePaceError};
pub(crate) use policy::{Buffer, Policy, ProgramEvent};
pub use script::{Repeat, Script, ScriptConfig, ScriptError, ScriptState, ServiceRequest, Wait};
pub(crate) use segment::ProgramSegment;
pub use state::{Message, StartError, State};
pub use stream::{ProgramConfig, Start, StreamingProgram, result};
