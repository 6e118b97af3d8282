//! Bytes as a 3B program: reading, rules, fixes and the trace end whatever they are, every place lies in the text, and a document that
//! was edited is the one read from scratch.

use super::check_program;
use wedm::program::Language;

pub fn run(data: &[u8]) {
    check_program(Language::ThreeB, data);
}
