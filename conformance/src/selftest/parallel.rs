//! Processes items in several threads.

use std::sync::Mutex;
use std::thread;

use crate::mutex::lock;

/// The progress of a part of the self-test: the numbers of all items, processed items and failed
/// items.
#[derive(Clone, Copy, Debug)]
pub struct SelfTestProgress {
    /// The text after the number of items, such as "defects tried once".
    pub part: &'static str,
    pub all: usize,
    pub done: usize,
    pub failed: usize,
}

/// The function that is called after each item.
pub(super) type ProgressCallback<'a> = &'a (dyn Fn(SelfTestProgress) + Sync);

/// Processes the items in `threads` threads per processor; returns the results in the order of the
/// items.
pub(super) fn parallel<T: Sync, R: Send>(
    (part, items): (&'static str, &[T]),
    threads: usize,
    work: impl Fn(&T) -> R + Sync,
    is_failure: impl Fn(&R) -> bool + Sync,
    report_progress: ProgressCallback<'_>,
) -> Vec<R> {
    let all = items.len();
    let progress = Mutex::new((items.iter().enumerate(), Vec::with_capacity(all), 0));
    let workers = thread::available_parallelism().map_or(1, usize::from) * threads;
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let next = lock(&progress).0.next();
                    let Some((place, item)) = next else { return };
                    let result = work(item);
                    let mut progress = lock(&progress);
                    progress.2 += usize::from(is_failure(&result));
                    progress.1.push((place, result));
                    report_progress(SelfTestProgress {
                        part,
                        all,
                        done: progress.1.len(),
                        failed: progress.2,
                    });
                }
            });
        }
    });
    let (_, mut results, _) =
        progress.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}
