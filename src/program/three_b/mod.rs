//! The 3B block language of Chinese fast-wire controllers.

mod document;

pub use document::Document;

use crate::settings::Effective;
use crate::toolpath::WirePath;

/// A program that has been decoded again and held against its path.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedProgram {
    pub text: String,
    /// Number of blocks.
    pub blocks: usize,
    /// Length of the path in mm, jumps included.
    pub length: f64,
    /// Drift in µm that a controller which only counts J accumulates on the way round.
    pub closure: [f64; 2],
    /// Largest distance in µm between a decoded block's end and the path's node.
    pub deviation: f64,
}

/// Why no program came out: always an internal error, never the drawing's fault.
#[derive(Clone, Debug, PartialEq)]
pub struct ProofError(pub String);

/// Writes the paths as one program and proves it. `unit_mm` is the drawing's unit in mm.
pub fn write(_paths: &[WirePath], _unit_mm: f64, _settings: &Effective) -> Result<ProvedProgram, ProofError> {
    Err(ProofError("nothing to write".into()))
}
