//! The behaviour of NC programs and of the streaming interface that seeded defects can change.

use std::fmt;

use ads_cnc::streaming::{Ack, Checker, LINE_END_ERROR, LineError};

use super::interface::StreamingInterface;
use super::segment::ProgramSegment;

/// The behaviour of NC programs and of the streaming interface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Policy {
    /// Creates a streaming interface.
    pub(crate) buffer: fn() -> Box<dyn Buffer>,
    /// Checks lines that were read together, and makes a segment of them.
    pub(crate) segment: fn(&mut Checker, &[u8]) -> ProgramSegment,
    /// Events that start the streaming program, in addition to an explicit start and to the events
    /// that [`Start`](super::Start) names: power-on or an NC reset.
    pub(crate) starts: &'static [ProgramEvent],
    /// Events that end the streaming program, in addition to a program end and an error: an NC
    /// reset or the execution of all lines.
    pub(crate) ends: &'static [ProgramEvent],
    /// Events that empty the streaming interface: a start, an NC reset or a program end.
    pub(crate) clears: &'static [ProgramEvent],
    /// Error number for a line without CR LF.
    pub(crate) line_end_error: u32,
    /// Whether a script, for each request, also writes REQUEST_STATE before all other variables.
    pub(crate) state_first: bool,
    /// Whether a script waits for RESPONSE_STATE before it reads RESPONSE.
    pub(crate) awaits_response: bool,
    /// Whether a script stops waiting after the maximum wait.
    pub(crate) times_out: bool,
}

/// An event of a streaming program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ProgramEvent {
    /// The channel is configured.
    PowerOn,
    Start,
    Reset,
    End,
    /// All lines that were written have been executed.
    Dry,
}

impl Policy {
    /// The correct behaviour, which the manuals document, or which is assumed.
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

/// A streaming interface, which buffers written data until it is read. Apart from
/// [`StreamingInterface`], only seeded defects implement this trait; they may deviate from the
/// descriptions of its functions.
pub(crate) trait Buffer: fmt::Debug + Send {
    /// Accepts all bytes of a write, or none.
    fn write(&mut self, data: &[u8]) -> Ack;

    /// Removes bytes from the buffer and returns them.
    ///
    /// # Errors
    /// If a line does not end in CR LF.
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
