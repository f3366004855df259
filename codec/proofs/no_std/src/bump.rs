//! A bump allocator: allocates from the start of a block of 64 KiB and never frees memory.

use core::alloc::{GlobalAlloc, Layout};
use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicUsize, Ordering};

const SIZE: usize = 64 * 1024;

struct Bump {
    block: UnsafeCell<[u8; SIZE]>,
    used: AtomicUsize,
}

// SAFETY: `used` ensures that every byte of the block is allocated only once.
unsafe impl Sync for Bump {}

// SAFETY: every allocation is aligned, within the block, and disjoint from earlier ones.
unsafe impl GlobalAlloc for Bump {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let reach = layout.size() + layout.align();
        let at = self.used.fetch_add(reach, Ordering::Relaxed);
        if at + reach > SIZE {
            return core::ptr::null_mut();
        }
        let block = self.block.get().cast::<u8>();
        // SAFETY: `at + reach` is within the block, and aligning the address adds less than `align`
        // bytes.
        unsafe {
            let free = block.add(at);
            free.add(free.align_offset(layout.align()))
        }
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static BUMP: Bump = Bump { block: UnsafeCell::new([0; SIZE]), used: AtomicUsize::new(0) };
