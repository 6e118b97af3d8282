//! The formats that programs are written in, by name.

use super::write::{ProofError, ProvedProgram};
use super::{iso, three_b};
use crate::settings::Effective;
use crate::toolpath::WirePath;

/// A format that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    ThreeB,
    Iso,
}

impl Format {
    pub const ALL: [Format; 2] = [Format::ThreeB, Format::Iso];

    pub fn name(self) -> &'static str {
        match self {
            Format::ThreeB => "3b",
            Format::Iso => "iso",
        }
    }

    /// The format of a name, in either letter case. The error names those that there are.
    pub fn of(name: &str) -> Result<Format, String> {
        let found = Format::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name));
        found.ok_or_else(|| {
            let names = Format::ALL.map(|format| format!("\"{}\"", format.name()));
            format!("format is \"{name}\", expected {}", names.join(" or "))
        })
    }

    /// Writes the paths as one program and proves it; `go_on` hears how far it is, and ends the work with `false`.
    pub fn write(
        self,
        paths: &[WirePath],
        unit_mm: f64,
        settings: &Effective,
        go_on: &mut dyn FnMut(usize, usize) -> bool,
    ) -> Result<ProvedProgram, ProofError> {
        match self {
            Format::ThreeB => three_b::write_with(paths, unit_mm, settings, go_on),
            Format::Iso => iso::write_with(paths, unit_mm, settings, go_on),
        }
    }
}
