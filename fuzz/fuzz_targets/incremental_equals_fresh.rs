//! Hands what libFuzzer draws to `wedm_fuzz::incremental_equals_fresh`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::incremental_equals_fresh::run(data));
