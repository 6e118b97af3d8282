//! Hands what libFuzzer draws to `wedm_fuzz::dxf_reader`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::dxf_reader::run(data));
