//! The paths of the passes after the first.

use super::clearance::Walls;
use super::contour_path::{Along, Fault, Laid, Outcome};
use super::corners::Element;
use super::job::{Job, ROUNDING};
use super::nest::Before;
use super::offset::Wall;
use super::open_contour::Lost;
use super::path::Refusal;
use crate::settings::SkimCorner;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// The path of the first pass.
pub(super) struct Rough {
    /// Drawing units.
    pub(super) correction: f64,
    /// Empty where the wire stands in one point.
    pub(super) path: Vec<Element>,
}

impl Job<'_> {
    /// The paths of all passes: that of the first is given, and those after it are made in parallel. Only the first one where it has no path.
    pub(super) fn each_pass(
        &self,
        walls: &[Wall],
        own: &Walls,
        first: Outcome,
        later: &[f64],
        along: Along,
    ) -> Result<Vec<Outcome>, Refusal> {
        let (path, stand) = match first {
            Ok(Laid::Path(path)) => (path, None),
            Ok(Laid::Point(stand)) => (Vec::new(), Some(stand)),
            Err(_) => return Ok(vec![first]),
        };
        let rough = Rough {
            correction: along.correction,
            path,
        };
        let pass = |&correction: &f64| {
            let along = Along {
                correction,
                ..along
            };
            self.skim(walls, own, &rough, along)
        };
        let later: Result<Vec<Outcome>, Refusal> = later.par_iter().map(pass).collect();
        let first = match stand {
            Some(stand) => Laid::Point(stand),
            None => Laid::Path(rough.path),
        };
        let mut all = vec![Ok(first)];
        all.extend(later?);
        Ok(all)
    }

    /// The path of a pass after the first: beside the contour or, where corners are to have a constant stock, beside the first path.
    pub(super) fn skim(
        &self,
        walls: &[Wall],
        own: &Walls,
        rough: &Rough,
        along: Along,
    ) -> Result<Outcome, Refusal> {
        let by = rough.correction - along.correction;
        let side = along.side;
        let is_constant = self.settings.passes.skim_corner() == SkimCorner::ConstantStock;
        if !is_constant || by.abs() <= self.units(ROUNDING) || rough.path.is_empty() {
            let along = along.on_own_side();
            let before = Before {
                path: &rough.path,
                correction: rough.correction,
            };
            // One beside the first path has been proved otherwise.
            let is_plain =
                !is_constant && along.side == side && along.correction <= rough.correction;
            return self.laid_within(walls, own, along, is_plain.then_some(before));
        }
        let beside: Vec<Wall> = rough.path.iter().map(Element::piece).collect();
        let near = Walls::of(&beside);
        let back = Along {
            side: -along.side,
            correction: by,
            closed: along.closed,
        };
        let laid = self.laid(&beside, &near, back.on_own_side())?;
        Ok(match laid {
            Ok(Laid::Path(mut path)) => {
                for element in &mut path {
                    element.wall = rough.path[element.wall].wall;
                }
                let least = along.correction - 2.0 * self.units(ROUNDING);
                let into = path
                    .iter()
                    .find_map(|element| own.too_near(&element.geometry, least));
                match into {
                    Some(wall) => Err(Fault::Unproved { wall }),
                    None => Ok(Laid::Path(path)),
                }
            }
            Err(Fault::Several(mut lost)) => {
                for Lost { wall, .. } in &mut lost {
                    *wall = rough.path[*wall].wall;
                }
                Err(Fault::Several(lost))
            }
            Err(Fault::Unproved { wall }) => Err(Fault::Unproved {
                wall: rough.path[wall].wall,
            }),
            nothing => nothing,
        })
    }
}
