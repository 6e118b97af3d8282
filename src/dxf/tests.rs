//! Tests of the module as a whole.

mod editing;
mod reading;
