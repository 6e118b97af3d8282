//! Refactorings of 3B and 4B: how its moves are printed, and the refactorings that it alone has.

mod blocks;
mod coordinates;
mod correction;
mod header;
mod split;
#[cfg(test)]
mod tests;
mod turned;

pub(in crate::program) use blocks::Blocks;
pub(in crate::program) use coordinates::{with_ends, without_ends};
pub(in crate::program) use correction::corrected;
pub(in crate::program) use split::split;
