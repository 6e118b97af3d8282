//! Bytes as a stream of frames: every step uses up bytes, and how they come makes no difference.

use std::io::Read;
use wedm::server::{Frame, Frames};

pub fn run(data: &[u8]) {
    let is_broken = |body: &[u8]| body.len().is_multiple_of(2);
    let at_once = bodies(data, usize::MAX, is_broken);
    assert_eq!(
        bodies(data, 1 + data.len() % 7, is_broken),
        at_once,
        "bytes that come a few at a time"
    );
}

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
pub fn bodies(bytes: &[u8], at_once: usize, is_broken: impl Fn(&[u8]) -> bool) -> Vec<Vec<u8>> {
    let mut frames = Frames::new(Trickle { bytes, at_once });
    let mut bodies = Vec::new();
    let mut used = 0;
    loop {
        match frames.step() {
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
