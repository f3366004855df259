//! What NC programs, and what gives them their lines, could do in more than one way.

use std::fmt;

use ads_cnc::streaming::{Ack, Checker, LINE_END_ERROR, LineError};

use super::interface::StreamingInterface;
use super::segment::ProgramSegment;

/// How NC programs go about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Policy {
    /// A new streaming interface.
    pub(crate) buffer: fn() -> Box<dyn Buffer>,
    /// Checks lines that were read at once.
    pub(crate) segment: fn(&mut Checker, &[u8]) -> ProgramSegment,
    /// What starts the streaming program besides a start.
    pub(crate) starts: &'static [ProgramEvent],
    /// What ends it besides a program end.
    pub(crate) ends: &'static [ProgramEvent],
    /// What empties the interface.
    pub(crate) clears: &'static [ProgramEvent],
    /// Number of the error of a line without CR LF.
    pub(crate) line_end_error: u32,
    /// Whether a script writes the request state before anything else, too.
    pub(crate) state_first: bool,
    /// Whether a script reads the response state before the response.
    pub(crate) awaits_response: bool,
    /// Whether a script gives up after its longest wait.
    pub(crate) times_out: bool,
}

/// What happens to a streaming program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ProgramEvent {
    /// The channel is set up.
    PowerOn,
    Start,
    Reset,
    End,
    /// All lines were run.
    Dry,
}

impl Policy {
    /// As the manuals have it.
    pub(crate) const DEFAULT: Self = Self {
        buffer: || Box::new(StreamingInterface::new()),
        segment: ProgramSegment::new,
        starts: &[],
        ends: &[ProgramEvent::Reset],
        clears: &[ProgramEvent::Reset],
        line_end_error: LINE_END_ERROR,
        state_first: false,
        awaits_response: true,
        times_out: true,
    };
}

/// A streaming interface: what was written and not read yet.
pub(crate) trait Buffer: fmt::Debug + Send {
    /// Takes all of a write or nothing of it.
    fn write(&mut self, data: &[u8]) -> Ack;

    /// Takes lines out.
    ///
    /// # Errors
    /// A line without CR LF.
    fn read(&mut self) -> Result<Vec<u8>, LineError>;

    fn len(&self) -> usize;

    fn clear(&mut self);
}

impl Buffer for StreamingInterface {
    fn write(&mut self, data: &[u8]) -> Ack {
        Self::write(self, data)
    }

    fn read(&mut self) -> Result<Vec<u8>, LineError> {
        Self::read(self).map(<[u8]>::to_vec)
    }

    fn len(&self) -> usize {
        Self::len(self)
    }

    fn clear(&mut self) {
        self.reset();
    }
}
