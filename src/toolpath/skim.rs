//! The path of a pass behind the first.

use super::clearance::Walls;
use super::job::{Job, ROUNDING};
use super::laid::{Along, Fault, Known, Laid, Outcome};
use super::nest::Before;
use super::offset::Wall;
use super::path::Refusal;
use super::paths::Pass;
use crate::settings::{Corner, SkimCorner};

impl Job<'_> {
    /// The path of a pass behind the first: beside the contour, or where the corners are to have a constant stock beside the first path.
    /// Of the passes before it there are the first and the last.
    pub(super) fn skim(
        &self,
        walls: &[Wall],
        own: &Walls,
        [rough, last]: [&Pass; 2],
        along: Along,
    ) -> Result<Outcome, Refusal> {
        let by = rough.correction - along.correction;
        let is_constant = self.settings.passes.skim_corner() == SkimCorner::ConstantStock;
        if !is_constant || by <= self.units(ROUNDING) || rough.path.is_empty() {
            let before = Before {
                path: &last.path,
                correction: last.correction,
            };
            // With tips a path is more than what has been proved, and beside the first path it has been otherwise.
            let is_plain = along.corner == Corner::Arc && !is_constant;
            let known = Known {
                before: is_plain.then_some(before),
                ..Known::default()
            };
            return self.laid_within(walls, own, along, known);
        }
        let beside: Vec<Wall> = rough
            .path
            .iter()
            .map(|element| Wall {
                geometry: element.geometry,
                source: element.source,
            })
            .collect();
        let near = Walls::new(beside.iter().map(|wall| wall.geometry).collect());
        let back = Along {
            side: -along.side,
            correction: by,
            corner: Corner::Arc,
            closed: along.closed,
        };
        let laid = self.laid(&beside, &near, back)?;
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
            Err(Fault::Several { near, wall }) => Err(Fault::Several {
                near,
                wall: rough.path[wall].wall,
            }),
            Err(Fault::Unproved { wall }) => Err(Fault::Unproved {
                wall: rough.path[wall].wall,
            }),
            nothing => nothing,
        })
    }
}
