//! The rules on pairs of segments.

mod cases;
mod outlines;
#[path = "../support/star.rs"]
mod star;
