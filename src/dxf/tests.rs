//! Tests of the module as a whole.

mod ahead;
mod aside;
mod blocks;
mod curves;
mod editing;
mod faults;
mod layers;
mod marks;
mod planes;
pub(super) mod reading;
mod writing;
