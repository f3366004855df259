//! Catches signals that would end this process (on Windows, console events), so that the process
//! can clean up.

use std::io;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use crate::exit::Exit;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// The exit code that a shell reports for a process ended by Ctrl-C.
const INTERRUPTED: i32 = 130;

/// A second signal within this time is a repetition of the first signal, and is ignored.
const REPEATED: Duration = Duration::from_millis(200);

/// The interval at which a wait for a line of a command checks for a signal.
pub(crate) const POLL_INTERVAL: Duration = Duration::from_millis(20);

/// Whether a signal has been received.
pub(crate) fn is_requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// Numbers of further signals that end a process on Linux (x86, Arm): SIGSTKFLT, SIGPWR and the
/// real-time signals; empty on other systems.
#[cfg(unix)]
fn numbered() -> impl Iterator<Item = i32> {
    let is_linux = cfg!(all(
        target_os = "linux",
        any(
            target_arch = "x86_64",
            target_arch = "x86",
            target_arch = "aarch64",
            target_arch = "arm"
        )
    ));
    [16, 30].into_iter().chain(34..=64).filter(move |_| is_linux)
}

/// Registers a handler for most signals that end a process, but not for SIGKILL, SIGPIPE and the
/// signals of faults in the program, such as SIGSEGV.
#[cfg(unix)]
fn on_signals(handler: impl Fn() + Send + 'static) -> io::Result<()> {
    use signal_hook::consts::signal::{
        SIGABRT, SIGALRM, SIGHUP, SIGINT, SIGIO, SIGPROF, SIGQUIT, SIGSYS, SIGTERM, SIGTRAP,
        SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU, SIGXFSZ,
    };

    let all = [
        SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2,
        SIGXCPU, SIGXFSZ, SIGIO, SIGSYS, SIGTRAP,
    ];
    let mut signals = signal_hook::iterator::Signals::new(all)?;
    for signal in numbered() {
        // Fails for a signal that the C library reserves for itself.
        let _kept = signals.add_signal(signal);
    }
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        signals.forever().for_each(|_| handler());
    })?;
    Ok(())
}

#[cfg(not(unix))]
fn on_signals(handler: impl Fn() + Send + 'static) -> io::Result<()> {
    ctrlc::set_handler(handler).map_err(io::Error::other)
}

/// The caught signals. After the first signal, the tool cleans up and ends by itself. A second
/// signal, if not within [`REPEATED`], ends the process at once, with all commands that it has
/// started.
#[derive(Debug)]
pub(crate) struct Interrupt(Receiver<()>);

impl Interrupt {
    /// Catches the signals; to be called only once per process.
    pub(crate) fn catch() -> io::Result<Self> {
        Self::catch_with(|| (), || None)
    }

    /// Catches the signals. Calls `on_first` at the first signal. Calls `on_second` before a second
    /// signal ends the process; `on_second` may return an exit code other than that of an
    /// interrupted process.
    pub(crate) fn catch_with(
        on_first: impl Fn() + Send + 'static,
        on_second: impl Fn() -> Option<Exit> + Send + 'static,
    ) -> io::Result<Self> {
        let (sender, receiver) = mpsc::channel();
        let begun = OnceLock::new();
        let handler = move || {
            let begun: &Instant = begun.get_or_init(Instant::now);
            if REQUESTED.swap(true, Ordering::SeqCst) {
                // The command `timeout` sends the signal to the process, and then again to its
                // whole group.
                if begun.elapsed() < REPEATED {
                    return;
                }
                let code = on_second().map_or(INTERRUPTED, |exit| exit.code().into());
                super::end_all();
                process::exit(code);
            }
            // Fails if the `Interrupt` was dropped; `is_requested` still returns true.
            let _waiting = sender.send(());
            on_first();
        };
        on_signals(handler)?;
        Ok(Self(receiver))
    }

    /// Waits for a signal.
    pub(crate) fn wait(&self) {
        // `recv` does not fail, because the handler keeps the sender until the process ends.
        let _came = self.0.recv();
    }

    /// Whether a signal has been received.
    pub(crate) fn is_requested(&self) -> bool {
        is_requested()
    }

    /// Waits for this time or until a signal; returns whether a signal has been received.
    pub(crate) fn sleep(&self, time: Duration) -> bool {
        // The flag is checked too, because another wait may have received the message of the
        // signal.
        self.is_requested() || self.0.recv_timeout(time).is_ok()
    }
}
