//! A program without std that decodes, dispatches and encodes. It exits with 0 on success.

#![no_std]
#![no_main]

use core::arch::{asm, global_asm};
use core::panic::PanicInfo;

use ads_cnc::address::{Channel, IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsPort, FrameRef};
use ads_cnc::operation::{AdsService, Call, Operation, ReadByName, Request};
use ads_cnc::{Decode, DescriptionRef, DescriptorsRef, Encode, Error, HandleReadRef};

#[cfg(feature = "alloc")]
mod bump;
#[path = "../../../tests/everything/mod.rs"]
mod everything;
mod memory;

// Align the stack to 16 bytes, as the call of `main` requires.
global_asm!(".globl _start", "_start:", "and rsp, -16", "call {main}", "ud2", main = sym main);

extern "C" fn main() -> ! {
    exit(match prove() {
        Ok(true) => 0,
        Ok(false) => 1,
        Err(_) => 2,
    })
}

const DESCRIPTION: &[u8] =
    b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";

fn prove() -> Result<bool, Error> {
    let mut buf = [0; 2048];
    let description = DescriptionRef::decode(opaque(DESCRIPTION))?;
    let mut good = description.encode(&mut buf)? == DESCRIPTION;
    good &= DescriptorsRef::decode(opaque(&[0; 168]))?.len() == 2;
    good &= HandleReadRef::decode(opaque(&[0; 9])).is_err();
    good &= FrameRef::split(opaque(&[0; 5]), 64)?.is_none();
    let op = ReadByName::new(Channel::new(1)?, "V.E.Testvar")?;
    let call = Call {
        port: AmsPort::SDA,
        service: AdsService::ReadWrite,
        index_group: op.index_group(),
        index_offset: op.index_offset(),
        read_length: op.read_length(),
        data: op.encode(&mut buf)?,
    };
    good &= matches!(call.dispatch(), Ok(Request::ReadByName(again)) if again == op);
    good &= everything::runs(opaque(&[0; 64]));
    #[cfg(feature = "no_panic_negative")]
    {
        good &= opaque(DESCRIPTION)[opaque(&[1])[0] as usize] == 0;
    }
    let (index_group, index_offset) = (IndexGroup::new(0xF005), IndexOffset::new(0));
    good &= Call { index_group, index_offset, ..call }.dispatch().is_err();
    #[cfg(any(feature = "alloc", feature = "negative"))]
    {
        let owned = ads_cnc::Description::decode(opaque(DESCRIPTION))?;
        good &= owned.encode_to_vec()? == DESCRIPTION;
    }
    Ok(good)
}

/// Hides the bytes from the compiler, so that it cannot decode constant bytes at compile time.
fn opaque(bytes: &[u8]) -> &[u8] {
    core::hint::black_box(bytes)
}

fn exit(code: i32) -> ! {
    // SAFETY: exit_group takes one number and does not return.
    unsafe { asm!("syscall", in("rax") 231, in("rdi") code, options(noreturn, nostack)) }
}

#[cfg(feature = "no_panic")]
unsafe extern "C" {
    fn a_panic_is_left_in_the_codec() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    #[cfg(feature = "no_panic")]
    // SAFETY: this call never runs, because a program that contains it does not link.
    unsafe {
        a_panic_is_left_in_the_codec()
    }
    #[cfg(not(feature = "no_panic"))]
    exit(3)
}
