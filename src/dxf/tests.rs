//! Tests of the module as a whole.

mod editing;
mod faults;
mod reading;
mod writing;
