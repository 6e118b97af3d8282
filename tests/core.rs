//! Drawings and programs: rules, repairs, what an edit leaves alone, programs read, judged and converted.
//!
//! One binary for many files: what they stand on is compiled once.

#[path = "compare/main.rs"]
mod compare;
#[path = "convert/main.rs"]
mod convert;
#[path = "extremes.rs"]
mod extremes;
#[path = "faults.rs"]
mod faults;
#[path = "incremental/main.rs"]
mod incremental;
#[path = "pairs/main.rs"]
mod pairs;
#[path = "programs.rs"]
mod programs;
#[path = "rules/main.rs"]
mod rules;
#[path = "support/size.rs"]
mod size;
#[path = "small_radius/main.rs"]
mod small_radius;
#[path = "support/star.rs"]
mod star;
#[path = "three_b_examples.rs"]
mod three_b_examples;
#[path = "twins/main.rs"]
mod twins;
