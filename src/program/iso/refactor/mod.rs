//! Refactorings of ISO: how its moves are printed, and the refactorings that it alone has.

mod centers;
mod mode;
mod scaled;
#[cfg(test)]
mod tests;
mod turned;
mod words;

pub(in crate::program) use centers::centered;
pub(in crate::program) use mode::counted;
pub(in crate::program) use words::Words;
