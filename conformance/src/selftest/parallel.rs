//! Work in several threads.

use std::sync::Mutex;
use std::thread;

/// Processes each item, in this many threads per processor; the results have the order of the
/// items.
pub(super) fn parallel<T: Sync, R: Send>(
    items: &[T],
    threads: usize,
    work: impl Fn(&T) -> R + Sync,
    tell: &(impl Fn(usize, usize) + Sync),
) -> Vec<R> {
    let left = Mutex::new((items.iter().enumerate(), Vec::with_capacity(items.len())));
    let workers = thread::available_parallelism().map_or(1, usize::from) * threads;
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let next = lock(&left).0.next();
                    let Some((place, item)) = next else { return };
                    let result = work(item);
                    let mut left = lock(&left);
                    left.1.push((place, result));
                    tell(left.1.len(), items.len());
                }
            });
        }
    });
    let (_, mut results) = left.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
