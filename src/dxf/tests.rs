//! Tests of the module as a whole.

mod blocks;
mod editing;
mod faults;
mod reading;
mod writing;
