//! A program that contains functions of the codec as if it called them, and does nothing else. Its
//! size is therefore that of these functions and of the code that they need. The script `run`
//! generates the list of functions.

#![no_std]
#![no_main]

use core::panic::PanicInfo;

#[cfg(feature = "alloc")]
#[path = "../../no_std/src/bump.rs"]
mod bump;
#[allow(dead_code, reason = "not every program keeps all of it")]
mod generic;
#[cfg(target_os = "linux")]
#[path = "../../no_std/src/memory.rs"]
mod memory;

/// The address of a function; a static with the address keeps the function in the program.
struct Kept(#[allow(dead_code, reason = "the linker follows it")] *const ());

// SAFETY: the address is never dereferenced.
unsafe impl Sync for Kept {}

/// Keeps functions in the program. Their addresses are in a section that is not measured.
macro_rules! keep {
    ($( $function:expr ),* $(,)?) => {
        #[unsafe(link_section = ".kept")]
        pub(crate) static KEPT: [crate::Kept; [$( stringify!($function) ),*].len()] =
            [$( crate::Kept($function as *const ()) ),*];
    };
}

use keep;

/// The generated list of the functions that are kept in the program by their paths.
mod kept {
    #![allow(unused_imports, reason = "not every program keeps all of it")]
    use ads_cnc::operation::Operation;
    use ads_cnc::value::EncodeValue;
    use ads_cnc::{Decode, Encode};

    use crate::generic;

    include!(env!("KEPT"));
}

#[unsafe(no_mangle)]
extern "C" fn _start() -> ! {
    kept::keep_all();
    loop {}
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}
