//! An allocator that counts allocations.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The allocator. It counts the allocations of each thread separately, because tests run in
/// parallel.
struct Counting;

thread_local! {
    static LIVE: Cell<usize> = const { Cell::new(0) };
    static PEAK: Cell<usize> = const { Cell::new(0) };
    static COUNT: Cell<usize> = const { Cell::new(0) };
    static BYTES: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: the implementation passes every call on to the system's allocator; the counters neither
// allocate nor have a destructor.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        LIVE.set(LIVE.get().saturating_add(layout.size()));
        PEAK.set(PEAK.get().max(LIVE.get()));
        COUNT.set(COUNT.get() + 1);
        BYTES.set(BYTES.get() + layout.size());
        // SAFETY: the caller upholds the same contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // The counter does not fall below 0 if a thread frees memory that another thread allocated.
        LIVE.set(LIVE.get().saturating_sub(layout.size()));
        // SAFETY: the caller upholds the same contract.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Runs a function; returns the maximum by which the allocated bytes of this thread exceed those
/// before the call, and the number of allocations of this thread during the call.
pub(crate) fn measure(run: impl FnOnce()) -> (usize, usize) {
    let before = (LIVE.get(), COUNT.get());
    PEAK.set(before.0);
    run();
    (PEAK.get() - before.0, COUNT.get() - before.1)
}

/// Runs a function; returns the number of allocations of this thread during the call.
pub(crate) fn allocations(run: impl FnOnce()) -> usize {
    measure(run).1
}

/// The number of allocations of this thread so far, and the sum of their sizes in bytes.
#[cfg(feature = "alloc")]
pub(crate) fn allocated() -> (usize, usize) {
    (COUNT.get(), BYTES.get())
}

/// The counters detect allocations; the other tests of this program rely on this.
#[test]
fn counters_detect_allocations() {
    let before = BYTES.get();
    let held = measure(|| drop(std::hint::black_box(vec![0_u8; 1000])));
    assert_eq!((held, BYTES.get() - before), ((1000, 1), 1000));
    let (grown, _) = measure(|| {
        let mut bytes = std::hint::black_box(vec![0_u8; 1000]);
        bytes.reserve_exact(1000);
    });
    assert_eq!(grown, 3000);
}
