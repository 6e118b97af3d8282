//! The path of the wire: offsets, leads, passes, tabs, open contours, pairs of parts, taper, milling.
//!
//! One binary for many files: what they stand on is compiled once.

#[path = "fit/main.rs"]
mod fit;
#[path = "holes/main.rs"]
mod holes;
#[path = "milling/main.rs"]
mod milling;
#[path = "open/main.rs"]
mod open;
#[path = "passes/main.rs"]
mod passes;
#[path = "paths/main.rs"]
mod paths;
#[path = "support/size.rs"]
mod size;
#[path = "support/generate.rs"]
mod support;
#[path = "taper.rs"]
mod taper;
