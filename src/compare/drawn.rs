//! The data of a drawing for comparing: its contours, and the programs that we write for it.

use super::contour::Contour;
use super::rewritten::{Asked, Rewritten};
use super::ring::{Course, Ring};
use super::traced::Traced;
use super::walls::Walls;
use crate::drawing::{Drawing, EntityId, Outline};
use crate::program::Format;
use crate::settings::{Effective, Layout};
use crate::toolpath::plan;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Of more entities, or of contours of more segments, no program is written for a comparison.
const MOST_WRITTEN: usize = 20_000;
/// The most rewritten programs that are kept: a format or two, of all contours and of some.
const MOST_KEPT: usize = 4;
/// The most ways round contours that are kept, and the most pieces of them.
const MOST_RINGS: usize = 256;
const MOST_PIECES: usize = 200_000;

/// A drawing with its outlines, and what holds for it. What is worked out of it is kept as long as it is: an edit of a
/// program writes nothing again.
#[derive(Clone, Debug)]
pub struct Drawn {
    drawing: Arc<Drawing>,
    outlines: Arc<Vec<Outline>>,
    pub(super) settings: Arc<Effective>,
    /// mm of the drawing's unit.
    pub(super) unit_mm: f64,
    worked_out: Arc<WorkedOut>,
}

#[derive(Debug, Default)]
struct WorkedOut {
    contours: OnceLock<Vec<Contour>>,
    walls: OnceLock<Walls>,
    /// `None` where a program cannot be written.
    rewritten: Mutex<Vec<(Asked, Option<Arc<Rewritten>>)>>,
    /// `None` where no wire runs.
    rings: Mutex<Vec<(Course, Option<Arc<Ring>>)>>,
}

impl PartialEq for Drawn {
    fn eq(&self, other: &Drawn) -> bool {
        let is_one = Arc::ptr_eq(&self.outlines, &other.outlines)
            && Arc::ptr_eq(&self.drawing, &other.drawing);
        self.settings == other.settings
            && self.unit_mm == other.unit_mm
            && (is_one
                || self.outlines == other.outlines
                    && self.drawing.entities().eq(other.drawing.entities()))
    }
}

impl Drawn {
    pub fn of(
        drawing: &Arc<Drawing>,
        outlines: &Arc<Vec<Outline>>,
        settings: &Arc<Effective>,
    ) -> Drawn {
        Drawn {
            drawing: drawing.clone(),
            outlines: outlines.clone(),
            settings: settings.clone(),
            unit_mm: settings.unit_of(drawing).mm,
            worked_out: Arc::default(),
        }
    }

    /// The contours that are cut; what is drawn twice is taken once.
    pub(super) fn contours(&self) -> &[Contour] {
        self.worked_out.contours.get_or_init(|| {
            let cut = self.outlines.iter();
            let cut = cut.filter(|outline| outline.contour.double_of.is_none());
            let contour = |outline: &Outline| Contour {
                segments: outline.contour.segments(&self.drawing).collect(),
                closed: outline.contour.closed,
                side: outline.wire_side(),
                on_line: outline.is_on_line(),
            };
            cut.map(contour).collect()
        })
    }

    /// Their segments, and which of them are near a place.
    pub(super) fn walls(&self) -> &Walls {
        let made = || Walls::of(self.contours(), self.unit_mm * 1e3);
        self.worked_out.walls.get_or_init(made)
    }

    /// The program that we would write in the form of another one, of all contours or of those that hold some handles;
    /// `None` where there is none.
    pub(super) fn rewritten(
        &self,
        traced: &Traced,
        handles: Option<Vec<String>>,
    ) -> Option<Arc<Rewritten>> {
        let asked = Asked::of(traced, handles);
        let kept = &self.worked_out.rewritten;
        let lock = || kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = lock().iter().find(|(other, _)| *other == asked) {
            return known.clone();
        }
        let made = self.written(&asked).map(Arc::new);
        let mut kept = lock();
        if kept.len() >= MOST_KEPT {
            // The first is of all contours.
            kept.truncate(1);
        }
        kept.push((asked, made.clone()));
        made
    }

    fn written(&self, asked: &Asked) -> Option<Rewritten> {
        let mut settings = match (asked.format, self.settings.mills) {
            (Format::Milling, true) => self.settings.milled().ok()?,
            (Format::Milling, false) | (_, true) => return None,
            (_, false) => Effective::clone(&self.settings),
        };
        if asked.states_ends {
            settings.layout = Layout::Checking;
        }
        let contours = self.contours().iter();
        let segments: usize = contours.map(|contour| contour.segments.len()).sum();
        if settings.pass_error().is_some() || segments.max(self.drawing.len()) > MOST_WRITTEN {
            return None;
        }
        let of_format = asked.format.settings(&settings);
        let handles = asked.handles.as_deref();
        let paths = plan(&self.drawing, &self.outlines, &of_format, handles).ok()?;
        Rewritten::of(&paths, asked.format, &settings, self.unit_mm)
    }

    /// The way of the wire round a contour.
    pub(super) fn ring(&self, course: &Course) -> Option<Arc<Ring>> {
        let kept = &self.worked_out.rings;
        let lock = || kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = lock().iter().find(|(other, _)| other == course) {
            return known.clone();
        }
        let contour = self.contours().get(course.contour)?;
        let made = Ring::of(contour, course, &self.settings, self.unit_mm).map(Arc::new);
        let mut kept = lock();
        let pieces = |(_, ring): &(Course, Option<Arc<Ring>>)| {
            ring.as_ref().map_or(0, |ring| ring.pieces.len())
        };
        if kept.len() >= MOST_RINGS || kept.iter().map(pieces).sum::<usize>() > MOST_PIECES {
            kept.clear();
        }
        kept.push((*course, made.clone()));
        made
    }

    /// What an entity is called.
    pub fn handle(&self, entity: EntityId) -> &str {
        let entity = self.drawing.get(entity);
        entity.map_or("", |entity| &entity.handle)
    }
}
