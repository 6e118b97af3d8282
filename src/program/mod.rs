//! Programs for the machine: how each language is read, decoded to geometry and written.

pub mod three_b;
