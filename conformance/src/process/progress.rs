//! Counts the steps of a long run, for the progress on stderr.

use std::sync::atomic::{AtomicUsize, Ordering};

static ALL: AtomicUsize = AtomicUsize::new(0);
static DONE: AtomicUsize = AtomicUsize::new(0);
static FAILED: AtomicUsize = AtomicUsize::new(0);
static REQUESTS: AtomicUsize = AtomicUsize::new(0);

/// The counts of the current part of a run: all steps, finished steps, failed steps and requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) all: usize,
    pub(crate) done: usize,
    pub(crate) failed: usize,
    pub(crate) requests: usize,
}

/// Begins a part of the run that has `all` steps, and sets all other counts to 0.
pub(crate) fn begin(all: usize) {
    ALL.store(all, Ordering::Relaxed);
    for count in [&DONE, &FAILED, &REQUESTS] {
        count.store(0, Ordering::Relaxed);
    }
}

/// Counts a finished step, which may have failed.
pub(crate) fn step(failed: bool) {
    DONE.fetch_add(1, Ordering::Relaxed);
    FAILED.fetch_add(usize::from(failed), Ordering::Relaxed);
}

/// Counts finished steps.
pub(crate) fn steps(number: usize) {
    DONE.fetch_add(number, Ordering::Relaxed);
}

/// Sets the number of failed cases.
pub(crate) fn set_failed(number: usize) {
    FAILED.store(number, Ordering::Relaxed);
}

/// Counts requests.
pub(crate) fn requests(number: usize) {
    REQUESTS.fetch_add(number, Ordering::Relaxed);
}

pub(crate) fn counts() -> Counts {
    let [all, done, failed, requests] =
        [&ALL, &DONE, &FAILED, &REQUESTS].map(|count| count.load(Ordering::Relaxed));
    Counts { all, done, failed, requests }
}
