//! What needs a server with hidden methods, which the shipped one has not: `cargo test --features testing --test server testing`.

#[path = "testing/panics.rs"]
mod panics;
#[path = "testing/sequences.rs"]
mod sequences;
#[path = "testing/waiting.rs"]
mod waiting;
