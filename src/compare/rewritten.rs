//! The program that wedm writes for a drawing, to be compared with another one.

use super::traced::{Motion, Traced};
use crate::drawing::EntityId;
use crate::geometry::Vector;
use crate::program::{Document, Format};
use crate::settings::Effective;
use crate::toolpath::WirePath;

/// A program written for the comparison.
#[derive(Debug)]
pub(super) struct Rewritten {
    pub(super) traced: Traced,
    /// Of each block the segment of the drawing that it follows; `None` for the ways in, out and between, and stops.
    sources: Vec<Option<(EntityId, usize)>>,
    /// From its places to those of the drawing.
    pub(super) shift: Vector,
}

/// What is to be written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Asked {
    pub(super) format: Format,
    pub(super) states_ends: bool,
    /// The contours that it cuts; all where none is named.
    pub(super) handles: Option<Vec<String>>,
}

impl Asked {
    pub(super) fn of(traced: &Traced, handles: Option<Vec<String>>) -> Asked {
        Asked {
            format: traced.format(),
            states_ends: traced.states_ends,
            handles,
        }
    }
}

impl Rewritten {
    /// The segment of the drawing that a block of it follows.
    pub(super) fn source(&self, nth: usize) -> Option<(EntityId, usize)> {
        *self.sources.get(nth)?
    }

    /// Some paths written in a format, and read again.
    pub(super) fn of(
        paths: &[WirePath],
        format: Format,
        settings: &Effective,
        unit_mm: f64,
    ) -> Option<Rewritten> {
        let mut followed = Vec::new();
        let sources = Some(&mut followed);
        let written =
            format.write_with_sources(paths, unit_mm, settings, sources, &mut |_, _| true);
        let text = written.ok()?.text.into_bytes();
        let document = Document::read(format.language(), text, settings);
        let traced = Traced::of(&document);
        let scale = unit_mm * 1e3;
        let shift = match traced.is_placed {
            true => Vector::zeros(),
            false => paths.first()?.begin() * scale - traced.begin()?,
        };
        let mut followed = followed.into_iter();
        let sources = traced.blocks.iter().map(|block| match block.motion {
            Motion::Stop => None,
            _ => followed.next()?.segment(),
        });
        Some(Rewritten {
            sources: sources.collect(),
            traced,
            shift,
        })
    }
}
