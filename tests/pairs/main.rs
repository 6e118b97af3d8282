//! The rules on pairs of segments.

mod cases;
mod dead_ends;
mod outlines;
