//! Hands what libFuzzer draws to `wedm_fuzz::server_frames`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::server_frames::run(data));
