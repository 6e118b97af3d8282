//! Refactorings of programs: the same part written in another way, or exactly mirrored, rotated or
//! scaled.
//!
//! One file a refactoring, the same for every language. Each says what becomes of the [`moves`]; the language, a
//! [`moves::Printer`], writes it; [`proof`] reads the new program and compares each of its moves with the intended one.
//! A refactoring that fails there is not offered.

pub(in crate::program) mod merge;
pub(in crate::program) mod mirror;
pub(in crate::program) mod moves;
pub(in crate::program) mod number;
pub(in crate::program) mod proof;
pub(in crate::program) mod reverse;
pub(in crate::program) mod scale;
pub(in crate::program) mod sheet;
pub(in crate::program) mod start_here;
#[cfg(test)]
pub(in crate::program) mod tests;
pub(in crate::program) mod transform;
