//! Ctrl-C, on every system.

use std::io;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use crate::session::Trouble;

static CAME: AtomicBool = AtomicBool::new(false);

/// What a shell gives a process that Ctrl-C has ended.
const INTERRUPTED: i32 = 130;

/// Ctrl-C no longer ends the process: the tool does, when it has put things in order. A second one
/// ends it at once.
#[derive(Debug)]
pub(super) struct Interrupt(Receiver<()>);

impl Interrupt {
    /// Takes Ctrl-C over, once in a process.
    pub(super) fn catch() -> Result<Self, Trouble> {
        let (tell, told) = mpsc::channel();
        let handler = move || {
            if CAME.swap(true, Ordering::SeqCst) {
                process::exit(INTERRUPTED);
            }
            // Who does not wait looks.
            let _waiting = tell.send(());
        };
        let set = ctrlc::set_handler(handler).map_err(io::Error::other);
        set.map_err(|error| Trouble::Internal(format!("Ctrl-C cannot be caught: {error}")))?;
        Ok(Self(told))
    }

    /// Waits until it comes.
    pub(super) fn wait(&self) {
        // The other end is never dropped.
        let _came = self.0.recv();
    }

    /// Whether it has come.
    pub(super) fn came(&self) -> bool {
        CAME.load(Ordering::SeqCst)
    }

    /// Lets this time pass, or less if it comes; whether it has come.
    pub(super) fn sleep(&self, time: Duration) -> bool {
        // Told once; who asks again looks.
        self.came() || self.0.recv_timeout(time).is_ok()
    }
}
