//! The data of a drawing for comparing: its contours, by segments, and the programs that we write for it.

use super::cache::Cache;
use super::reference::{Of, Reference, Under};
use super::sides::{Sides, sided};
use super::traced::Traced;
use crate::drawing::{ContourSegment, Drawing, EntityId, Outline};
use crate::geometry::Side;
use crate::settings::Effective;
use std::sync::{Arc, OnceLock};

/// A drawing with its outlines, and what holds for it.
#[derive(Clone, Debug)]
pub struct Drawn {
    pub(super) drawing: Arc<Drawing>,
    pub(super) outlines: Arc<Vec<Outline>>,
    pub(super) settings: Arc<Effective>,
    /// mm of the drawing's unit.
    pub(super) unit_mm: f64,
    contours: Arc<OnceLock<Vec<Contour>>>,
    /// The outlines by each guess of their sides.
    sided: Arc<[OnceLock<Vec<Outline>>; Sides::GUESSED.len()]>,
    /// Programs that were written for it.
    cache: Arc<Cache>,
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

/// A contour that is cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    /// In the direction of travel, in the drawing's unit.
    pub segments: Vec<ContourSegment>,
    pub closed: bool,
    /// Side of the direction of travel on which the wire runs, where that is known.
    pub side: Option<Side>,
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
            contours: Arc::default(),
            sided: Arc::default(),
            cache: Arc::default(),
        }
    }

    /// The contours that are cut; what is drawn twice is taken once.
    pub(super) fn contours(&self) -> &[Contour] {
        let cut = self.cut().map(|outline| Contour {
            segments: outline.contour.segments(&self.drawing).collect(),
            closed: outline.contour.closed,
            side: outline.wire_side(),
        });
        self.contours.get_or_init(|| cut.collect())
    }

    /// Their outlines.
    pub(super) fn cut(&self) -> impl Iterator<Item = &Outline> {
        let all = self.outlines.iter();
        all.filter(|outline| outline.contour.double_of.is_none())
    }

    /// The same with the wire on the other side of each closed contour; `None` where no side is known.
    pub(super) fn turned(&self) -> Option<Drawn> {
        let is_sided = |contour: &Contour| contour.closed && contour.side.is_some();
        let turned = |contour: &Contour| Contour {
            side: match contour.closed {
                true => contour.side.map(Side::reversed),
                false => contour.side,
            },
            ..contour.clone()
        };
        let contours = self.contours();
        contours.iter().any(is_sided).then(|| Drawn {
            contours: Arc::new(OnceLock::from(
                contours.iter().map(turned).collect::<Vec<_>>(),
            )),
            ..self.clone()
        })
    }

    /// The same under other settings.
    pub(super) fn under(&self, settings: Effective) -> Drawn {
        Drawn {
            settings: Arc::new(settings),
            ..self.clone()
        }
    }

    /// The program that we would write for it in the form of another one.
    pub(super) fn reference(&self, traced: &Traced, under: &Under) -> Option<Arc<Reference>> {
        let of = Of {
            drawing: &self.drawing,
            outlines: self.outlines_by(under.sides),
            unit_mm: self.unit_mm,
        };
        self.cache.reference(&of, traced, under)
    }

    /// Under its own settings, all of it.
    pub(super) fn as_set(&self) -> Under {
        Under {
            settings: (*self.settings).clone(),
            sides: Sides::AsSet,
            handles: None,
        }
    }

    /// The outlines, with sides as they are guessed.
    fn outlines_by(&self, sides: Sides) -> &[Outline] {
        let at = Sides::GUESSED.iter().position(|guess| *guess == sides);
        let Some(kept) = at.and_then(|at| self.sided.get(at)) else {
            return &self.outlines;
        };
        let tolerance = self.settings.tolerances.same_place / self.unit_mm;
        kept.get_or_init(|| sided(&self.drawing, &self.outlines, (sides, tolerance)))
    }

    /// Under which sides a program may have been written.
    pub(super) fn sides(&self) -> &'static [Sides] {
        match self
            .contours()
            .iter()
            .any(|it| it.closed && it.side.is_none())
        {
            true => &Sides::GUESSED,
            false => &[Sides::AsSet],
        }
    }

    /// What has been inferred about programs written for it.
    pub(super) fn cache(&self) -> &Cache {
        &self.cache
    }

    /// What an entity is called.
    pub fn handle(&self, entity: EntityId) -> &str {
        let entity = self.drawing.get(entity);
        entity.map_or("", |entity| &entity.handle)
    }
}
