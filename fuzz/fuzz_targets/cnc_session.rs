#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| ads_cnc_fuzz::targets::CNC_SESSION.fuzz(data));
