#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| ads_cnc_fuzz::targets::TOOLS_CAPTURE.fuzz(data));
