//! Bytes as a 3B program: reading, rules, fixes and the trace end whatever they are, every place lies in the text, and a document that
//! was edited is the one read from scratch.

#![no_main]

use libfuzzer_sys::fuzz_target;
use wedm::program::Language;
use wedm_fuzz::check_program;

fuzz_target!(|data: &[u8]| {
    check_program(Language::ThreeB, data);
});
