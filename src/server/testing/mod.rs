//! The server's inside for tests and fuzz targets: its frames step by step, and the whole of it between two buffers.

mod sequence;

pub use sequence::{check_answers, sequence};

use super::transport::{Frame, Frames, Writer};
use super::{methods, serve_between};
use std::io::{Read, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Longer than anything in a test takes: an answer that has not come by then will never come.
const PATIENCE: Duration = Duration::from_secs(20);

/// Bytes that come at most `at_once` at a time, as from a pipe.
struct Trickle<'a> {
    bytes: &'a [u8],
    at_once: usize,
}

impl Read for Trickle<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let count = self.at_once.min(self.bytes.len()).min(into.len());
        into[..count].copy_from_slice(&self.bytes[..count]);
        self.bytes = &self.bytes[count..];
        Ok(count)
    }
}

/// The bodies of a stream that comes `at_once` bytes at a time; those for which `is_broken` holds are given back, as
/// the server does with invalid JSON.
///
/// # Panics
/// Where a step uses up no bytes, or more than there are.
pub fn bodies(bytes: &[u8], at_once: usize, is_broken: impl Fn(&[u8]) -> bool) -> Vec<Vec<u8>> {
    let mut frames = Frames::new(Trickle { bytes, at_once });
    let mut bodies = Vec::new();
    let mut used = 0;
    loop {
        match frames.next() {
            Frame::End => return bodies,
            Frame::Broken(reason) => assert!(!reason.is_empty()),
            Frame::Body(body) => {
                if is_broken(&body) {
                    frames.was_broken(&body);
                }
                bodies.push(body);
            }
        }
        assert!(
            frames.position() > used,
            "a step from byte {used} to byte {}",
            frames.position()
        );
        assert!(
            frames.position() <= bytes.len() as i64,
            "byte {} of {}",
            frames.position(),
            bytes.len()
        );
        used = frames.position();
    }
}

/// The output of a whole server in this process for `input` and then the end: bodies, in order.
pub fn served(input: &[u8]) -> Vec<Vec<u8>> {
    let output = Output::default();
    let writer = Writer::start(output.clone(), || {}).expect("a thread can be started");
    let flags = Arc::new(methods::Flags::default());
    let transport = serve_between(input, &writer, &flags, None, [PATIENCE; 2])
        .expect("a server can be started");
    drop(transport);
    let written = output
        .bytes
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .clone();
    bodies(&written, usize::MAX, |_| false)
}

#[derive(Clone, Default)]
struct Output {
    bytes: Arc<Mutex<Vec<u8>>>,
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.bytes
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
