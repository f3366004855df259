//! NC programs: the part of their execution that is visible to data streaming and services.
//!
//! - [`StreamingProgram`]: the streaming program. It receives its lines through the streaming
//!   interface and executes them at a configured pace.
//! - [`Script`]: a program that sends a list of requests to services through the Service Interface,
//!   once or repeatedly.
//! - [`StreamingInterface`], [`service`]: the two interfaces, and a single request of a program to
//!   a service.
//!
//! The programs use no threads or sockets, and not the clock of the system. Before each access, the
//! caller passes the time since any fixed point, which must never decrease, and the program
//! executes the steps that are due. The result does not depend on the number of these calls, unless
//! more steps of a [`Script`] are due than one call executes.
//!
//! ```
//! use std::time::Duration;
//!
//! use ads_cnc::streaming::Ack;
//! use ads_cnc_conformance::simulator::program::{Pace, StreamingProgram, ProgramConfig, ProgramState};
//!
//! let at = Duration::from_millis;
//! let pace = Pace::lines_per_second(10).unwrap();
//! let mut program = StreamingProgram::new(ProgramConfig { pace, ..ProgramConfig::default() });
//! assert_eq!(program.write(b"N10 G01 X20\r\nN20 $GOTO N10\r\nN10: X2\r\n", at(0)), Ack::Accepted);
//! program.advance(at(250));
//! assert_eq!(program.executed().line_count(), 2);
//! program.advance(at(300));
//! assert_eq!(program.state(), ProgramState::Dry);
//!
//! program.write(b"N30 $GOTO N10\r\n", at(1000));
//! let ProgramState::Aborted(message) = program.state() else { panic!() };
//! assert_eq!(message.to_string(), "streaming.nc:4:5: $GOTO back to line 3");
//! ```

mod completed_request;
mod executed;
mod interface;
mod pace;
mod policy;
mod script;
mod segment;
pub mod service;
mod state;
mod streaming_program;

pub use completed_request::{CompletedRequest, ServiceOutcome};
pub use executed::Executed;
pub(crate) use executed::lines;
pub use interface::StreamingInterface;
pub use pace::{Pace, ParsePaceError};
pub(crate) use policy::{Buffer, Policy, ProgramEvent};
pub use script::{Repeat, Script, ScriptConfig, ScriptError, ScriptState, ServiceRequest, Wait};
pub(crate) use segment::ProgramSegment;
pub use state::{Message, ProgramState, StartError};
pub use streaming_program::{ProgramConfig, Start, StreamingProgram, result};
