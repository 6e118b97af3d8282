//! The sentences that people read, made from findings; one module per language.

pub mod en;
mod readable;

pub use readable::{is_hidden, readable};
