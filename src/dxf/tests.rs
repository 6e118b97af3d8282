//! Tests of the module as a whole.

mod blocks;
mod editing;
mod faults;
mod layers;
mod reading;
mod writing;
