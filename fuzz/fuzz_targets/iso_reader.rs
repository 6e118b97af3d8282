//! Hands what libFuzzer draws to `wedm_fuzz::iso_reader`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::iso_reader::run(data));
