//! Hands what libFuzzer draws to `wedm_fuzz::three_b_controller`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::three_b_controller::run(data));
