//! Signals that end a process, on Windows the events of a console, and how a tool puts things in
//! order before it ends.

use std::io;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use crate::judge::Exit;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// What a shell gives a process that Ctrl-C has ended.
const INTERRUPTED: i32 = 130;

/// How often a wait that can be interrupted looks whether it is.
pub(crate) const LOOK: Duration = Duration::from_millis(20);

/// Whether a signal that ends the process was caught.
pub(crate) fn is_requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// SIGSTKFLT, SIGPWR and the real-time signals end a process too. Their numbers are Linux's.
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

/// Those that a terminal, a service manager, a timer or a limit sends; whichever ends the process
/// and can be caught.
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
        // A C library may keep one for itself.
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

/// A signal no longer ends the process: the tool does, when it has put things in order. A second
/// one ends it at once, with all commands that it has started.
#[derive(Debug)]
pub(crate) struct Interrupt(Receiver<()>);

impl Interrupt {
    /// Catches the signals; possible once in a process.
    pub(crate) fn catch() -> io::Result<Self> {
        Self::catch_telling(|| (), || None)
    }

    /// Catches the signals. `first_words` is called at the first one. `last_words` is called before a
    /// second one ends the process, and gives the exit code if it is another than that of an
    /// interrupted process.
    pub(crate) fn catch_telling(
        first_words: impl Fn() + Send + 'static,
        last_words: impl Fn() -> Option<Exit> + Send + 'static,
    ) -> io::Result<Self> {
        let (tell, told) = mpsc::channel();
        let handler = move || {
            if REQUESTED.swap(true, Ordering::SeqCst) {
                let code = last_words().map_or(INTERRUPTED, |exit| exit.code().into());
                super::end_all();
                process::exit(code);
            }
            // Who does not wait looks.
            let _waiting = tell.send(());
            first_words();
        };
        on_signals(handler)?;
        Ok(Self(told))
    }

    /// Waits until a signal comes.
    pub(crate) fn wait(&self) {
        // The other end is never dropped.
        let _came = self.0.recv();
    }

    /// Whether a signal has come.
    pub(crate) fn is_requested(&self) -> bool {
        is_requested()
    }

    /// Waits for this time, or less if a signal comes; whether one has come.
    pub(crate) fn sleep(&self, time: Duration) -> bool {
        // Told once; who asks again looks.
        self.is_requested() || self.0.recv_timeout(time).is_ok()
    }
}
