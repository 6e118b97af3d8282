//! Hands what libFuzzer draws to `wedm_fuzz::dxf_lexer`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| wedm_fuzz::dxf_lexer::run(data));
