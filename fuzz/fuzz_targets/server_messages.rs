//! Hands what libFuzzer draws to `wedm_fuzz::server_messages`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::server_messages::run(data));
