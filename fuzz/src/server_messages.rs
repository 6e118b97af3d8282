//! A session of a client with a whole server: every request is answered once and never with an internal error, whatever came before
//! it, and nothing panics.

use wedm::server::testing::{check_answers, sequence, served};

pub fn run(data: &[u8]) {
    let sequence = sequence(&data[..data.len().min(1_000)]);
    check_answers(&sequence, &served(&sequence.stream));
}
