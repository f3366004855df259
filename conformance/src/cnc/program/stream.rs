//! The streaming program of a channel.

use std::time::Duration;

use ads_cnc::ads::AdsError;
use ads_cnc::streaming::{Ack, Checker};

use super::executed::{Executed, lines};
use super::habit::Habit;
use super::interface::StreamingInterface;
use super::pace::{Clock, Pace};
use super::segment::{Next, Segment};
use super::state::{Message, StartError, State};

/// How a channel is set up for streaming.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramConfig {
    /// Name of the streaming program, P-CHAN-00158 `streaming_prog_file`. If it is empty, there
    /// is no streaming (STM-13): that is a CNC's default, and not the one here.
    pub name: String,
    /// Whether the program is started.
    pub start: Start,
    /// How fast lines are run; 1000 lines/s by default (assumed).
    pub pace: Pace,
    /// So many bytes of the lines that were run can be read back, and not many more; 1 MiB by
    /// default.
    pub kept: usize,
}

/// When a streaming program is started (STM-14). Nothing that starts one is documented for ADS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// By [`Program::start`].
    ByHand,
    /// At the beginning, once.
    #[default]
    Once,
    /// At the beginning, and again when it has come to its end.
    Again,
}

impl Default for ProgramConfig {
    /// Set up and started.
    fn default() -> Self {
        let pace = Pace::lines_per_second(1000).unwrap_or(Pace::Fast);
        Self { name: "streaming.nc".to_owned(), start: Start::Once, pace, kept: 1 << 20 }
    }
}

/// The program that gets its lines through the streaming interface of a channel.
///
/// - Writes go to the [`StreamingInterface`]; what it cannot take now is refused, with warning 11012
///   (STM-3, STM-6).
/// - The decoder, when it has run all lines it has, reads everything that is there at once
///   (STM-12), and runs it line by line. A line counts as run when its time at the [`Pace`] is
///   over. Before the decoder was started, and behind an end or an error, nothing is read: writes
///   fill the interface (assumed).
/// - If there is nothing to read, motion stands still until the next write (STM-16).
/// - A line without CR LF aborts when it is read; nothing of what was read with it is run
///   (assumed). A word of a loop and a jump back abort in place of their line; the lines above are
///   run (STM-8; the moment is assumed). See [`Checker`] for what those are.
/// - Behind a program end, what was read with it is discarded; what is still in the interface
///   stays for the next start (STM-10).
/// - An NC reset ends streaming mode and empties the interface (STM-11).
///
/// The lines are not interpreted: branches are not taken and jumps not followed, each line is run
/// once, in its order. `L` calls a subroutine, which is a file with its own M17 or M29: the call
/// returns at once and the stream goes on (STM-18).
///
/// Memory: the interface, as much again for what was read, the labels that a [`Checker`] knows and
/// the lines that are kept.
///
/// Manual: `stream-en`, sections 2.2, 2.3, 3 and 4.
#[derive(Clone, Debug)]
pub struct Program {
    config: ProgramConfig,
    interface: StreamingInterface,
    checker: Checker,
    phase: Phase,
    clock: Clock,
    now: Duration,
    executed: Executed,
    refusals: u64,
    habit: Option<Habit>,
    /// What was written and not read, for a habit that needs it.
    written: Vec<Vec<u8>>,
}

#[derive(Clone, Debug)]
enum Phase {
    Started(Segment),
    /// As the state says.
    Over(State),
}

impl Program {
    /// A channel that was switched on.
    pub fn new(config: ProgramConfig) -> Self {
        let mut program = Self {
            interface: StreamingInterface::new(),
            checker: Checker::new(),
            phase: Phase::Over(State::Stopped),
            clock: Clock::default(),
            now: Duration::ZERO,
            executed: Executed::new(config.kept),
            refusals: 0,
            habit: None,
            written: Vec::new(),
            config,
        };
        if program.config.start != Start::ByHand && !program.config.name.is_empty() {
            program.begin();
        }
        program
    }

    /// The same with a seeded defect.
    pub(crate) fn with_habit(mut self, habit: Option<Habit>) -> Self {
        self.habit = habit;
        if habit == Some(Habit::StartsItself) && !self.config.name.is_empty() {
            self.begin();
        }
        self
    }

    /// Writes to `mc_program_stream_w`; [`result`] is what ADS answers.
    pub fn write(&mut self, data: &[u8], now: Duration) -> Ack {
        self.advance(now);
        let was_dry = self.is_dry();
        let ack = self.take(data);
        match ack {
            Ack::Accepted if was_dry => {
                self.clock = Clock::begin(self.now);
                self.run();
            }
            Ack::Busy => self.refusals = self.refusals.saturating_add(1),
            Ack::Accepted | Ack::Rejected => {}
        }
        ack
    }

    fn take(&mut self, data: &[u8]) -> Ack {
        let Some(habit) = self.habit else { return self.interface.write(data) };
        let over = self.interface.len().saturating_add(data.len()) > Habit::LITTLE_ROOM;
        if habit == Habit::Narrow && over {
            return Ack::Busy;
        }
        let mut ack = self.interface.write(data);
        let all = self.written.iter().map(Vec::len).sum::<usize>().saturating_add(data.len());
        if ack == Ack::Busy && habit == Habit::Roomy && all <= 2 * Habit::ROOM {
            ack = Ack::Accepted;
        }
        if ack == Ack::Accepted {
            self.written.push(data.to_vec());
        }
        ack
    }

    /// Makes up for the time that has passed.
    pub fn advance(&mut self, now: Duration) {
        self.now = self.now.max(now);
        self.run();
    }

    /// Starts the streaming program, as main program or as global subroutine (STM-14). Its lines
    /// are counted from 1 again.
    ///
    /// # Errors
    /// [`StartError`]: it has no name, it runs, or it was aborted.
    pub fn start(&mut self, now: Duration) -> Result<(), StartError> {
        self.advance(now);
        if self.config.name.is_empty() {
            return Err(StartError::NoName);
        }
        match &self.phase {
            Phase::Started(_) => return Err(StartError::Running),
            Phase::Over(State::Aborted(_)) => return Err(StartError::Aborted),
            Phase::Over(_) => {}
        }
        if self.habit == Some(Habit::StartEmpties) {
            self.empty();
        }
        self.begin();
        self.clock = Clock::begin(self.now);
        self.run();
        Ok(())
    }

    /// NC reset: ends streaming mode and empties the interface (STM-11). What was run by then can
    /// still be read back.
    pub fn reset(&mut self, now: Duration) {
        self.advance(now);
        if self.habit != Some(Habit::ResetKeeps) {
            self.empty();
        }
        match self.habit {
            Some(Habit::ResetGoesOn) => {}
            Some(Habit::StartsItself) => self.begin(),
            _ => self.phase = Phase::Over(State::Stopped),
        }
    }

    fn empty(&mut self) {
        self.interface.reset();
        self.written.clear();
    }

    /// Changes how fast lines are run from now on; the line that is being run begins anew.
    pub fn set_pace(&mut self, pace: Pace, now: Duration) {
        self.advance(now);
        self.config.pace = pace;
        self.clock = Clock::begin(self.now);
        self.run();
    }

    /// Where it stands, as of the last access.
    pub fn state(&self) -> State {
        match &self.phase {
            Phase::Over(state) => state.clone(),
            Phase::Started(_) if self.is_dry() => State::Dry,
            Phase::Started(_) => State::Running,
        }
    }

    fn is_dry(&self) -> bool {
        let Phase::Started(segment) = &self.phase else { return false };
        self.interface.is_empty() && matches!(segment.next(), Next::Nothing)
    }

    /// What was run, as of the last access, over all starts and resets.
    pub fn executed(&self) -> &Executed {
        &self.executed
    }

    /// Forgets what was run.
    pub fn forget_executed(&mut self) {
        self.executed = Executed::new(self.config.kept);
    }

    /// Bytes that the interface holds, as of the last access.
    pub fn held(&self) -> usize {
        self.interface.len()
    }

    /// How often a write was refused for now: so many times warning
    /// [11012](ads_cnc::streaming::BUSY_WARNING) was issued (STM-6).
    pub fn refusals(&self) -> u64 {
        self.refusals
    }

    /// How it is set up.
    pub fn config(&self) -> &ProgramConfig {
        &self.config
    }

    fn begin(&mut self) {
        self.checker = Checker::new();
        self.phase = Phase::Started(Segment::default());
    }

    fn run(&mut self) {
        while let Phase::Started(segment) = &mut self.phase {
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
                    self.phase = Phase::Over(State::Aborted(message));
                }
                Next::End(end) => {
                    if self.habit == Some(Habit::EndEmpties) {
                        self.empty();
                    }
                    match self.config.start {
                        Start::Again => self.begin(),
                        _ => self.phase = Phase::Over(State::Ended(end)),
                    }
                }
                Next::Nothing if self.interface.is_empty() => {
                    if self.habit == Some(Habit::DryEnds) && self.checker.lines() > 0 {
                        self.phase = Phase::Over(State::Stopped);
                    }
                    break;
                }
                Next::Nothing => self.read(),
            }
        }
    }

    fn read(&mut self) {
        let written = std::mem::take(&mut self.written);
        self.phase = match (self.interface.read(), self.habit) {
            (Ok(lines), None) => Phase::Started(Segment::new(&mut self.checker, lines, None)),
            (Ok(_), Some(habit)) => {
                let lines = match (habit, written.as_slice()) {
                    (Habit::Packets, [first, rest @ ..]) => {
                        for packet in rest {
                            self.interface.write(packet);
                        }
                        self.written = rest.to_vec();
                        first.clone()
                    }
                    (Habit::Reversed, all) => all.iter().rev().flatten().copied().collect(),
                    (_, all) => all.concat(),
                };
                if habit == Habit::Forgets {
                    self.checker = Checker::new();
                }
                Phase::Started(Segment::new(&mut self.checker, &lines, self.habit))
            }
            (Err(_), Some(Habit::SkipsLines)) => {
                let all = written.concat();
                let whole = lines(&all).filter(|line| line.ends_with(b"\r\n"));
                let whole: Vec<u8> = whole.flatten().copied().collect();
                Phase::Started(Segment::new(&mut self.checker, &whole, self.habit))
            }
            (Err(error), habit) => {
                let before = self.checker.lines();
                let mut message = Message::of_line_end(&self.config.name, before, &error);
                if habit == Some(Habit::OtherError) {
                    message.number = message.number.map(|number| number.wrapping_add(1));
                }
                Phase::Over(State::Aborted(message))
            }
        };
    }
}

/// What ADS answers to a write: 0, 0x706 for now, 0x705 for good (STM-6; the numbers are assumed).
///
/// ```
/// use ads_cnc::streaming::Ack;
/// use ads_cnc_conformance::cnc::program::result;
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
