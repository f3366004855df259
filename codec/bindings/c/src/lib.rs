//! The codec for C and for languages that call C. `include/ads_cnc.h` documents it.
//!
//! The library has no allocator, no globals and no ownership: the caller provides all memory,
//! nothing is freed, and any thread may call any function. Structs consist of numbers and pointers.
//! Any number is safe to pass. An invalid pointer, or a length that exceeds the memory at its
//! pointer, is undefined behaviour.

#![cfg_attr(not(test), no_std)]

#[cfg(test)]
extern crate codec as ads_cnc;

mod address;
mod error;
mod frame;
mod machines;
mod memory;
mod request;
mod stream;
mod tables;
#[cfg(test)]
mod tests;

pub use address::AdsCncGroup;
pub use error::AdsCncError;
pub use frame::{AdsCncAddress, AdsCncFrame};
pub use machines::{AdsCncHost, AdsCncHostStep, AdsCncProgress, AdsCncSender, AdsCncServiceId};
pub use memory::AdsCncBytes;
pub use request::{AdsCncCall, AdsCncRequest};
pub use stream::{AdsCncField, AdsCncPart};
pub use tables::{AdsCncFieldInfo, AdsCncFunctionInfo, AdsCncStreamInfo, AdsCncType};

/// Means no function, stream or field.
pub const ADS_CNC_NONE: u32 = u32::MAX;

/// The ABI of the library. Programs built with a header of another ABI must not use this library.
#[unsafe(no_mangle)]
pub extern "C" fn ads_cnc_abi() -> u32 {
    const { decimal(env!("CARGO_PKG_VERSION_MINOR").as_bytes()) }
}

#[cfg(ads_cnc_negative)]
#[allow(clippy::indexing_slicing, missing_docs)]
#[unsafe(no_mangle)]
pub extern "C" fn ads_cnc_negative(at: u8) -> u8 {
    [1, 2, 3][usize::from(at)]
}

const fn decimal(mut digits: &[u8]) -> u32 {
    let mut number = 0_u32;
    while let [digit, rest @ ..] = digits {
        let [ones, ..] = [digit.wrapping_sub(b'0'), 0];
        number = number.wrapping_mul(10).wrapping_add(u32::from_le_bytes([ones, 0, 0, 0]));
        digits = rest;
    }
    number
}

/// The panic handler refers to an undefined symbol. No function can reach a panic, so a release
/// build does not contain this reference; `codec/bindings/run` verifies this. If the linker reports
/// the symbol, the build may be less optimised than this check requires.
#[cfg(not(any(test, debug_assertions)))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn ads_cnc_panicked() -> !;
    }
    // SAFETY: the function is not defined, so a program that links never calls it.
    unsafe { ads_cnc_panicked() }
}

#[cfg(all(not(test), debug_assertions))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
