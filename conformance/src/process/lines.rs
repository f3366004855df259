//! A command that exchanges lines over stdin and stdout.

use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Read, Write as _};
use std::process::{ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use super::{POLL, RunningCommand, interrupt};
use crate::mutex::lock;
use crate::text::{escape_lines, json_error, plural, shorten};

/// Maximum length of a line in bytes. The longest answer that a golden vector requires has about
/// 16,000 bytes if its JSON has no blanks between the tokens.
pub const LINE_MAX: usize = 1 << 18;

/// Maximum number of commas, `[` and `{` in a line. A JSON value may begin at or after each of
/// these characters, and may occupy much more memory than its text when it is parsed.
const VALUES_MAX: usize = 1 << 13;

/// Maximum number of bytes of stderr that are stored; only the last bytes are stored.
const STDERR_MAX: usize = 64 << 10;

/// The end of the output to stderr of a command, also of its earlier starts.
#[derive(Clone, Debug, Default)]
pub struct Stderr(Arc<Mutex<StderrBytes>>);

#[derive(Debug, Default)]
struct StderrBytes {
    kept: VecDeque<u8>,
    /// Number of starts of the command.
    starts: u64,
    /// Number of the last bytes of `kept` that the process of the last start has written.
    latest: usize,
}

impl Stderr {
    /// The stored bytes as printable text.
    pub fn text(&self) -> String {
        self.last(usize::MAX)
    }

    /// The stored bytes since the last start as printable text.
    pub(super) fn latest(&self) -> String {
        let latest = lock(&self.0).latest;
        self.last(latest)
    }

    fn last(&self, count: usize) -> String {
        let kept = &lock(&self.0).kept;
        let skipped = kept.len().saturating_sub(count);
        escape_lines(&String::from_utf8_lossy(
            &kept.iter().skip(skipped).copied().collect::<Vec<u8>>(),
        ))
    }

    /// Marks a start of the command.
    pub(super) fn begin(&self) {
        let mut bytes = lock(&self.0);
        bytes.starts = bytes.starts.wrapping_add(1);
        bytes.latest = 0;
    }

    fn collect(&self, mut from: impl Read) {
        let mut chunk = [0; 4096];
        let start = lock(&self.0).starts;
        while let Ok(len @ 1..) = from.read(&mut chunk) {
            let mut bytes = lock(&self.0);
            // A process that an earlier process started may still write.
            if bytes.starts == start {
                bytes.latest = bytes.latest.saturating_add(len);
            }
            bytes.kept.extend(chunk.iter().take(len));
            let over = bytes.kept.len().saturating_sub(STDERR_MAX);
            bytes.kept.drain(..over);
        }
    }
}

/// The reason why no line was received.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecvError {
    /// No line arrived within the time limit.
    Silence,
    /// This process was interrupted.
    Interrupted,
    /// The command closed its stdout, for example because it ended.
    Closed,
    /// The line is longer than [`LINE_MAX`]; the rest of the output is not read.
    Garbled(String),
    /// The line is not UTF-8, or has too many values.
    NoText(String),
}

/// A running command that exchanges lines. Dropping it ends the command and the processes that the
/// command started, see [`RunningCommand`].
#[derive(Debug)]
pub struct LineProcess {
    to: Sender<Vec<u8>>,
    from: Receiver<Result<Vec<u8>, String>>,
    /// Is disconnected when stderr has been read to its end.
    stderr_end: Receiver<()>,
    /// Dropped last: a command that cannot be killed may end when its stdin is closed.
    child: RunningCommand,
}

impl LineProcess {
    /// Starts a command in its own process group.
    pub fn start(mut command: Command, stderr: &Stderr) -> io::Result<Self> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let child = RunningCommand::start(command)?;
        let (to, lines) = mpsc::channel();
        let (tell, from) = mpsc::sync_channel(4);
        if let Some(stdin) = child.take_stdin() {
            spawn("to command", move || write(stdin, &lines))?;
        }
        if let Some(stdout) = child.take_stdout() {
            let tell = move || {
                let mut stdout = BufReader::new(stdout);
                while let Some(line) = read_line(&mut stdout, LINE_MAX) {
                    let over = line.is_err();
                    if tell.send(line).is_err() || over {
                        break;
                    }
                }
            };
            spawn("from command", tell)?;
        }
        let (end, stderr_end) = mpsc::channel();
        if let Some(from) = child.take_stderr() {
            let kept = stderr.clone();
            let collect = move || {
                kept.collect(from);
                drop(end);
            };
            spawn("command's stderr", collect)?;
        }
        Ok(Self { to, from, stderr_end, child })
    }

    /// Sends a line. If the command has ended, only [`recv`](Self::recv) reports that.
    pub fn send(&self, mut line: Vec<u8>) {
        line.push(b'\n');
        let _gone = self.to.send(line);
    }

    /// Waits for a line.
    ///
    /// # Errors
    /// The reason why no line of text was received.
    pub fn recv(&self, timeout: Duration) -> Result<String, RecvError> {
        let begun = Instant::now();
        loop {
            let left = timeout.saturating_sub(begun.elapsed());
            match self.from.recv_timeout(left.min(interrupt::POLL_INTERVAL)) {
                Ok(Ok(line)) => return text(line),
                Ok(Err(why)) => return Err(RecvError::Garbled(why)),
                Err(RecvTimeoutError::Disconnected) => return Err(RecvError::Closed),
                Err(RecvTimeoutError::Timeout) if interrupt::is_requested() => {
                    return Err(RecvError::Interrupted);
                }
                Err(RecvTimeoutError::Timeout) if left.is_zero() => return Err(RecvError::Silence),
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    /// A line that the command has already sent without a request; `None` if it has sent none.
    pub fn unasked(&self) -> Option<String> {
        self.from.try_recv().ok().map(|line| show(&line))
    }

    /// Closes stdin and waits for the command to end; kills the command and returns `None` if it
    /// does not end in time, or a signal interrupts the wait.
    pub fn ended(self, limit: Duration) -> Option<ExitStatus> {
        self.finish(limit).0
    }

    /// Like [`ended`](Self::ended), but also returns the first line, if any, that the command has
    /// still sent.
    pub fn finish(mut self, limit: Duration) -> (Option<ExitStatus>, Option<String>) {
        self.to = mpsc::channel().0;
        let mut unasked = None;
        // Reads stdout while waiting: a command whose stdout is not read may block and not end.
        let mut listen = |time| match self.from.recv_timeout(time) {
            Ok(line) => {
                unasked.get_or_insert_with(|| show(&line));
                true
            }
            Err(RecvTimeoutError::Timeout) => true,
            Err(RecvTimeoutError::Disconnected) => false,
        };
        let status = wait(&self.child, limit, || {
            if !listen(POLL) {
                thread::sleep(POLL);
            }
        });
        let until = Instant::now().checked_add(OUTPUT_AFTER_EXIT);
        // Reads the remaining output for a limited time only, because a process started by the
        // command may keep stdout and stderr open.
        while status.is_some() && until.is_some_and(|until| Instant::now() < until) && listen(POLL)
        {
        }
        if let Some(until) = until.filter(|_| status.is_some()) {
            let _end =
                self.stderr_end.recv_timeout(until.saturating_duration_since(Instant::now()));
        }
        (status, unasked)
    }
}

/// Maximum time to wait for the rest of the output after the command has ended.
const OUTPUT_AFTER_EXIT: Duration = Duration::from_millis(200);

fn show(line: &Result<Vec<u8>, String>) -> String {
    match line {
        Ok(line) => cut(&String::from_utf8_lossy(line)),
        Err(why) => why.clone(),
    }
}

fn spawn(name: &str, run: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().name(name.to_owned()).spawn(run).map(drop)
}

/// Writes lines to the command; runs in its own thread, because a command that does not read must
/// not block this process.
fn write(mut stdin: ChildStdin, lines: &Receiver<Vec<u8>>) {
    while let Ok(line) = lines.recv() {
        if stdin.write_all(&line).and_then(|()| stdin.flush()).is_err() {
            return;
        }
    }
}

/// Reads the next line without its line end; returns `None` at the end of the stream or after an
/// error of the system.
///
/// ```
/// use ads_cnc_conformance::process::read_line;
///
/// let mut output = &b"{}\r\nthe last"[..];
/// assert_eq!(read_line(&mut output, 8), Some(Ok(b"{}".to_vec())));
/// assert_eq!(read_line(&mut output, 8), Some(Ok(b"the last".to_vec())));
/// assert_eq!(read_line(&mut output, 8), None);
/// assert!(read_line(&mut &b"too long\r\n"[..], 7).unwrap().is_err());
/// ```
///
/// # Errors
/// If a line has more than `most` bytes without its line end. The bytes read are then lost, and the
/// rest of the line may not have been read, so the stream must not be read any further.
pub fn read_line(from: &mut impl BufRead, most: usize) -> Option<Result<Vec<u8>, String>> {
    let limit = u64::try_from(most).unwrap_or(u64::MAX).saturating_add(2);
    let mut line = Vec::new();
    match from.take(limit).read_until(b'\n', &mut line) {
        Err(_) | Ok(0) => return None,
        Ok(_) => {}
    }
    if line.last() == Some(&b'\n') {
        line.pop();
    }
    if line.last() == Some(&b'\r') {
        line.pop();
    }
    if line.len() > most {
        return Some(Err(format!("the line has more than {}", plural(most, "byte"))));
    }
    Some(Ok(line))
}

/// Converts a line of JSON from bytes to text.
///
/// # Errors
/// If the line has too many values, or is not UTF-8.
pub fn text(line: Vec<u8>) -> Result<String, RecvError> {
    if line.iter().filter(|byte| matches!(byte, b',' | b'[' | b'{')).count() > VALUES_MAX {
        return Err(RecvError::NoText(format!("the line has more than {VALUES_MAX} values")));
    }
    String::from_utf8(line).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let shown = cut(&String::from_utf8_lossy(error.as_bytes()));
        RecvError::NoText(format!("the line is not UTF-8 at byte {at}: {shown}"))
    })
}

fn wait(
    child: &RunningCommand,
    limit: Duration,
    mut meanwhile: impl FnMut(),
) -> Option<ExitStatus> {
    let until = Instant::now().checked_add(limit)?;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status),
            Ok(None) if Instant::now() < until && !interrupt::is_requested() => meanwhile(),
            _ => return None,
        }
    }
}

/// Maximum number of characters of an error of the JSON parser in a message.
const ERROR_MAX: usize = 400;

/// The error message for a line that is not a JSON message of the protocol.
pub(crate) fn not_json(line: &str, error: &serde_json::Error) -> String {
    let shown = cut(line);
    if serde_json::from_str::<serde::de::IgnoredAny>(line).is_ok() || line.starts_with('{') {
        // The error contains texts of the line, escaped.
        format!("{}: {shown}", shorten(&json_error(line, error), ERROR_MAX))
    } else {
        format!("the line is not JSON: {shown}; print only answers to stdout, the rest to stderr")
    }
}

/// The beginning of a line in quotes, for an error message.
pub fn cut(line: &str) -> String {
    let shown: String = line.chars().take(120).collect();
    if shown.len() < line.len() { format!("{shown:?}…") } else { format!("{shown:?}") }
}
