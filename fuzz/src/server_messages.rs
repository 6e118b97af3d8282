//! A session of a client with a whole server: every request is answered once and never with an internal error, whatever came before
//! it, and nothing panics.

use super::sequence::{check_answers, sequence};
use super::server_frames::bodies;
use std::io::Write;
use std::sync::{Arc, Mutex};

pub fn run(data: &[u8]) {
    let sequence = sequence(&data[..data.len().min(1_000)]);
    check_answers(&sequence, &served(&sequence.stream));
}

/// What a whole server in this process answers to `input`, which then ends: bodies, in order.
fn served(input: &[u8]) -> Vec<Vec<u8>> {
    let output = Output::default();
    wedm::server::serve_here(input, output.clone()).expect("a server can be started");
    let written = output.0.lock().unwrap().clone();
    bodies(&written, usize::MAX, |_| false)
}

#[derive(Clone, Default)]
struct Output(Arc<Mutex<Vec<u8>>>);

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
