//! The program that wedm writes for a drawing, to be compared with another one.

use super::basis::Basis;
use super::traced::{Motion, Traced};
use crate::drawing::EntityId;
use crate::geometry::Vector;
use crate::program::{Document, Format};
use crate::settings::Layout;
use crate::toolpath::plan;

/// Of more entities, or of contours of more segments, no program is written for a comparison.
const MOST: usize = 20_000;

/// A program written for the comparison.
#[derive(Debug)]
pub(super) struct Rewritten {
    pub(super) traced: Traced,
    /// Of each block the segment of the drawing that it follows; `None` for the ways in, out and between, and stops.
    pub(super) sources: Vec<Option<(EntityId, usize)>>,
    /// From its places to those of the drawing.
    pub(super) shift: Vector,
}

/// What is to be written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Asked {
    format: Format,
    states_ends: bool,
    /// The contours that it cuts; all where none is named.
    handles: Option<Vec<String>>,
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
    pub(super) fn of(basis: Basis, asked: &Asked) -> Option<Rewritten> {
        let mut settings = match (asked.format, basis.settings.mills) {
            (Format::Milling, true) => basis.settings.milled().ok()?,
            (Format::Milling, false) | (_, true) => return None,
            (_, false) => basis.settings.clone(),
        };
        if asked.states_ends {
            settings.layout = Layout::Checking;
        }
        let contours = basis.contours.iter();
        let segments: usize = contours.map(|contour| contour.segments.len()).sum();
        if settings.pass_error().is_some() || segments.max(basis.drawing.len()) > MOST {
            return None;
        }
        let paths = plan(
            basis.drawing,
            basis.outlines,
            &asked.format.settings(&settings),
            asked.handles.as_deref(),
        )
        .ok()?;
        let mut followed = Vec::new();
        let written = asked.format.write_with_sources(
            &paths,
            basis.unit_mm,
            &settings,
            Some(&mut followed),
            &mut |_, _| true,
        );
        let text = written.ok()?.text.into_bytes();
        let document = Document::read(asked.format.language(), text, &settings);
        let traced = Traced::of(&document);
        let scale = basis.unit_mm * 1e3;
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
