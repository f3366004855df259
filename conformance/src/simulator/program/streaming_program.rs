//! The streaming program of a channel.

use std::time::Duration;

use ads_cnc::ads::AdsError;
use ads_cnc::streaming::{Ack, Checker};

use super::executed::Executed;
use super::pace::{LineClock, Pace};
use super::policy::{Buffer, Policy, ProgramEvent};
use super::segment::{Next, ProgramSegment};
use super::state::{Message, ProgramState, StartError};

/// The streaming configuration of a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramConfig {
    /// Name of the streaming program, P-CHAN-00158 `streaming_prog_file`. An empty name disables
    /// streaming (STM-13); this is the default of a CNC, but not of this type.
    pub name: String,
    /// The events that start the program, besides [`StreamingProgram::start`].
    pub start: Start,
    /// Speed of execution; 1000 lines/s by default (assumed).
    pub pace: Pace,
    /// Number of bytes; 1 MiB by default. When the stored executed lines would exceed twice this
    /// number, the oldest lines are removed. At least this number of bytes remains, including the
    /// newly executed line.
    pub kept: usize,
}

/// The events that start a streaming program, besides a call of [`StreamingProgram::start`]
/// (STM-14). No manual documents an ADS function that starts a streaming program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// No other event.
    ByHand,
    /// Power-on of the channel.
    #[default]
    Once,
    /// Power-on of the channel, and each program end.
    Again,
}

impl Default for ProgramConfig {
    /// A program that starts once, at power-on.
    fn default() -> Self {
        let pace = Pace::lines_per_second(1000).unwrap_or(Pace::Fast);
        Self { name: "streaming.nc".to_owned(), start: Start::Once, pace, kept: 1 << 20 }
    }
}

/// The NC program that receives its lines through the streaming interface of a channel.
///
/// - Writes are stored in the [`StreamingInterface`](super::StreamingInterface). A write that does
///   not fit now is rejected with warning 11012 (STM-3, STM-6).
/// - When the decoder has executed all its lines, it reads all bytes of the interface at once
///   (STM-12) and executes them line by line. A line has been executed when its time at the
///   [`Pace`] is over. The decoder reads nothing before the start of the program, nor after an NC
///   reset, an error, or an end without a restart. Meanwhile, writes fill the interface (assumed).
/// - If all lines are executed and the interface is empty, the program waits for the next write; a
///   real CNC also stops motion (STM-16).
/// - A line without CR LF aborts streaming when it is read; no line that was read with it is
///   executed (assumed). A loop or a backward jump aborts streaming instead of executing its line;
///   the lines before it are executed (STM-8; the time is assumed). [`Checker`] defines these
///   lines.
/// - At a program end, the lines after it that were read together with it are discarded. The bytes
///   in the interface remain for the next start (STM-10).
/// - An NC reset ends streaming mode and empties the interface (STM-11).
///
/// Apart from program ends, loops and jumps, the lines are not interpreted: they are executed in
/// order, each at most once. A line with `L`, which calls a subroutine in another file, is executed
/// like any other line: the M17 or M29 of the subroutine is in that file and does not end the
/// stream (STM-18).
///
/// The program needs memory for the interface, the same amount for read lines, the labels of the
/// [`Checker`], and the stored executed lines.
///
/// Manual: `stream-en`, sections 2.2, 2.3, 3 and 4.
#[derive(Debug)]
pub struct StreamingProgram {
    config: ProgramConfig,
    policy: Policy,
    interface: Box<dyn Buffer>,
    checker: Checker,
    phase: ProgramPhase,
    clock: LineClock,
    now: Duration,
    executed: Executed,
    busy_count: u64,
}

#[derive(Debug)]
enum ProgramPhase {
    Started(ProgramSegment),
    /// Streaming mode is not active; the state is the reason.
    Over(ProgramState),
}

impl StreamingProgram {
    /// Creates the program at power-on of the channel.
    pub fn new(config: ProgramConfig) -> Self {
        Self::with_policy(config, Policy::DEFAULT)
    }

    /// Creates the program at power-on of the channel, with another policy.
    pub(crate) fn with_policy(config: ProgramConfig, policy: Policy) -> Self {
        let mut program = Self {
            policy,
            interface: (policy.buffer)(),
            checker: Checker::new(),
            phase: ProgramPhase::Over(ProgramState::Stopped),
            clock: LineClock::default(),
            now: Duration::ZERO,
            executed: Executed::new(config.kept),
            busy_count: 0,
            config,
        };
        let starts = policy.starts.contains(&ProgramEvent::PowerOn);
        if (starts || program.config.start != Start::ByHand) && !program.config.name.is_empty() {
            program.begin();
        }
        program
    }

    /// Writes to `mc_program_stream_w`; [`result`] converts the acknowledgement to an ADS error.
    pub fn write(&mut self, data: &[u8], now: Duration) -> Ack {
        self.advance(now);
        let was_dry = self.is_dry();
        let ack = self.interface.write(data);
        match ack {
            Ack::Accepted if was_dry => {
                self.clock = LineClock::begin(self.now);
                self.run();
            }
            Ack::Busy => self.busy_count = self.busy_count.saturating_add(1),
            Ack::Accepted | Ack::Rejected => {}
        }
        ack
    }

    /// Executes lines up to this time.
    pub fn advance(&mut self, now: Duration) {
        self.now = self.now.max(now);
        self.run();
    }

    /// Starts the streaming program, as main program or global subroutine (STM-14), and counts its
    /// lines from 1 again.
    ///
    /// # Errors
    /// [`StartError`], if the program has no name, is running (also without lines to execute), or
    /// was aborted.
    pub fn start(&mut self, now: Duration) -> Result<(), StartError> {
        self.advance(now);
        if self.config.name.is_empty() {
            return Err(StartError::NoName);
        }
        match &self.phase {
            ProgramPhase::Started(_) => return Err(StartError::Running),
            ProgramPhase::Over(ProgramState::Aborted(_)) => return Err(StartError::Aborted),
            ProgramPhase::Over(_) => {}
        }
        self.clear_at(ProgramEvent::Start);
        self.begin();
        self.clock = LineClock::begin(self.now);
        self.run();
        Ok(())
    }

    /// NC reset: ends streaming mode and empties the interface (STM-11). The record of executed
    /// lines remains.
    pub fn reset(&mut self, now: Duration) {
        self.advance(now);
        self.clear_at(ProgramEvent::Reset);
        if self.policy.ends.contains(&ProgramEvent::Reset) {
            self.phase = ProgramPhase::Over(ProgramState::Stopped);
        }
        if self.policy.starts.contains(&ProgramEvent::Reset) {
            self.begin();
        }
    }

    fn clear_at(&mut self, event: ProgramEvent) {
        if self.policy.clears.contains(&event) {
            self.interface.clear();
        }
    }

    /// Changes the speed of execution, and starts the time of the current line again.
    pub fn set_pace(&mut self, pace: Pace, now: Duration) {
        self.advance(now);
        self.config.pace = pace;
        self.clock = LineClock::begin(self.now);
        self.run();
    }

    /// The state at the last access.
    pub fn state(&self) -> ProgramState {
        match &self.phase {
            ProgramPhase::Over(state) => state.clone(),
            ProgramPhase::Started(_) if self.is_dry() => ProgramState::Dry,
            ProgramPhase::Started(_) => ProgramState::Running,
        }
    }

    fn is_dry(&self) -> bool {
        let ProgramPhase::Started(segment) = &self.phase else { return false };
        self.interface.len() == 0 && matches!(segment.next(), Next::Nothing)
    }

    /// The lines executed up to the last access, including those before starts and resets, but not
    /// those before [`forget_executed`](Self::forget_executed).
    pub fn executed(&self) -> &Executed {
        &self.executed
    }

    /// Clears the record of executed lines.
    pub fn forget_executed(&mut self) {
        self.executed = Executed::new(self.config.kept);
    }

    /// Number of bytes in the streaming interface at the last access.
    pub fn buffered(&self) -> usize {
        self.interface.len()
    }

    /// Number of writes rejected as busy, each of which issues warning
    /// [11012](ads_cnc::streaming::BUSY_WARNING) (STM-6).
    pub fn busy_count(&self) -> u64 {
        self.busy_count
    }

    /// The configuration.
    pub fn config(&self) -> &ProgramConfig {
        &self.config
    }

    fn begin(&mut self) {
        self.checker = Checker::new();
        self.phase = ProgramPhase::Started(ProgramSegment::default());
    }

    fn run(&mut self) {
        while let ProgramPhase::Started(segment) = &mut self.phase {
            match segment.next() {
                _ if self.config.pace == Pace::Hold => break,
                Next::Line(line) => {
                    if !self.clock.pass(self.config.pace, line, self.now) {
                        break;
                    }
                    self.executed.push(line);
                    segment.pass();
                }
                Next::Fault(finding) => {
                    let message = Message::of_finding(&self.config.name, &finding);
                    self.phase = ProgramPhase::Over(ProgramState::Aborted(message));
                }
                Next::End(end) => {
                    self.clear_at(ProgramEvent::End);
                    match self.config.start {
                        Start::Again => self.begin(),
                        _ => self.phase = ProgramPhase::Over(ProgramState::Ended(end)),
                    }
                }
                Next::Nothing if self.interface.len() == 0 => {
                    if self.policy.ends.contains(&ProgramEvent::Dry) && self.checker.lines() > 0 {
                        self.phase = ProgramPhase::Over(ProgramState::Stopped);
                    }
                    break;
                }
                Next::Nothing => self.read(),
            }
        }
    }

    fn read(&mut self) {
        self.phase = match self.interface.read() {
            Ok(lines) => ProgramPhase::Started((self.policy.segment)(&mut self.checker, &lines)),
            Err(error) => {
                let (number, before) = (self.policy.line_end_error, self.checker.lines());
                let message = Message::of_line_end(&self.config.name, number, before, &error);
                ProgramPhase::Over(ProgramState::Aborted(message))
            }
        };
    }
}

/// The ADS error for an acknowledgement: 0 for accepted, 0x706 for busy, 0x705 for rejected (STM-6;
/// the numbers are assumed).
///
/// ```
/// use ads_cnc::streaming::Ack;
/// use ads_cnc_conformance::simulator::program::result;
///
/// for ack in [Ack::Accepted, Ack::Busy, Ack::Rejected] {
///     assert_eq!(Ack::from_result(result(ack)), ack);
/// }
/// ```
pub fn result(ack: Ack) -> AdsError {
    match ack {
        Ack::Accepted => AdsError::NO_ERROR,
        Ack::Busy => AdsError::INVALID_DATA,
        Ack::Rejected => AdsError::INVALID_SIZE,
    }
}
