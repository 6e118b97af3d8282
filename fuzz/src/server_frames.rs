//! Bytes as a stream of frames: every step uses up bytes, and how they come makes no difference.

use wedm::server::testing::bodies;

pub fn run(data: &[u8]) {
    let is_broken = |body: &[u8]| body.len().is_multiple_of(2);
    let at_once = bodies(data, usize::MAX, is_broken);
    assert_eq!(
        bodies(data, 1 + data.len() % 7, is_broken),
        at_once,
        "bytes that come a few at a time"
    );
}
