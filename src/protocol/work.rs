//! Lengths, times and costs of a job, beside the reply that holds its paths or its program.

use crate::drawing::{Drawing, Outline};
use crate::geometry::Xy as Point;
use crate::message::readable;
use crate::settings::Effective;
use crate::toolpath;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the wire is threaded for a contour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct StartHole {
    /// Handle of the contour's first entity.
    pub contour: String,
    /// Drawing units.
    pub at: Point,
    /// mm; where `program.start-hole` says it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<f64>,
    /// By the settings or by a mark in the drawing; else it was found.
    pub given: bool,
    /// The part of a pair that is threaded there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
}

/// What the cuts come to. Where a key is not set that something would need, it is left out and the key is `missing`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Work {
    /// In the order of the cuts.
    pub cuts: Vec<WorkCut>,
    /// mm of all cuts, leads included.
    pub length: f64,
    /// mm of the ways from one contour to the next, on which nothing is cut.
    pub jumps: f64,
    /// Of all cuts: length × `job.thickness` / `passes.rates`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub minutes: Option<f64>,
    /// In the money of `job.machine-rate`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// What drops out of openings.
    pub slugs: Vec<Slug>,
    /// The largest angle between a lead and its contour, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lead_angle: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest_wire: Option<LargestWire>,
    /// Keys that are not set.
    pub missing: Vec<String>,
}

/// One pass along one contour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct WorkCut {
    /// Handle of the contour's first entity.
    pub contour: String,
    /// 1-based number of the pass.
    pub pass: usize,
    /// It cuts off the tab.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cut_off: bool,
    /// mm, leads included.
    pub length: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub minutes: Option<f64>,
}

/// What drops out of an opening.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Slug {
    /// Handle of the contour's first entity.
    pub contour: String,
    /// g of steel: 7.85 g/cm³ × area × `job.thickness`.
    pub mass: f64,
}

/// The thickest wire that still cuts every arc and passes every narrow place: Ø = 2 (r − gap).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct LargestWire {
    /// mm.
    pub diameter: f64,
    /// Of the arc that says so, mm; where that is a narrow place, half its width.
    pub radius: f64,
    pub handle: String,
    /// Index within the entity.
    pub segment: usize,
    /// The facing wall of a narrow place, where that says so and no arc.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<FacingWall>,
}

/// One of the walls of a narrow place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct FacingWall {
    pub handle: String,
    /// Index within the entity.
    pub segment: usize,
}

fn name(drawing: &Drawing, outlines: &[Outline], outline: usize) -> String {
    outlines
        .get(outline)
        .map_or("?", |outline| outline.name(drawing))
        .to_owned()
}

impl StartHole {
    pub(crate) fn new(
        drawing: &Drawing,
        outlines: &[Outline],
        settings: &Effective,
        hole: &toolpath::StartHole,
    ) -> StartHole {
        StartHole {
            contour: name(drawing, outlines, hole.outline),
            at: hole.at.into(),
            diameter: settings.start_hole,
            given: hole.is_given,
            part: None,
        }
    }
}

impl Work {
    pub(crate) fn new(drawing: &Drawing, outlines: &[Outline], work: &toolpath::Work) -> Work {
        let name = |outline: usize| name(drawing, outlines, outline);
        let cuts = work.cuts.iter().map(|cut| WorkCut {
            contour: name(cut.outline),
            pass: cut.pass,
            cut_off: cut.cut_off,
            length: cut.length,
            minutes: cut.minutes,
        });
        let slugs = work.slugs.iter().map(|slug| Slug {
            contour: name(slug.outline),
            mass: slug.mass,
        });
        Work {
            cuts: cuts.collect(),
            length: work.length,
            jumps: work.jumps,
            minutes: work.minutes,
            cost: work.cost,
            slugs: slugs.collect(),
            lead_angle: work.lead_angle.map(f64::to_degrees),
            largest_wire: work
                .largest_wire
                .map(|largest| LargestWire::new(drawing, &largest)),
            missing: work.missing.iter().map(|&key| key.to_owned()).collect(),
        }
    }
}

impl LargestWire {
    pub(crate) fn new(drawing: &Drawing, largest: &toolpath::LargestWire) -> LargestWire {
        let name = |entity| {
            let entity = drawing.get(entity);
            entity.map_or("?", |entity| &entity.handle).to_owned()
        };
        LargestWire {
            diameter: largest.diameter,
            radius: largest.radius,
            handle: name(largest.entity),
            segment: largest.segment,
            facing: largest.facing.map(|(entity, segment)| FacingWall {
                handle: name(entity),
                segment,
            }),
        }
    }

    /// In words.
    pub(crate) fn sentence(&self) -> String {
        let handle = readable(&self.handle);
        match &self.facing {
            Some(facing) => say!(
                the_largest_wire_passes_between,
                self.diameter,
                2.0 * self.radius,
                handle,
                self.segment,
                readable(&facing.handle),
                facing.segment
            ),
            None => say!(
                the_largest_wire_is,
                self.diameter,
                self.radius,
                handle,
                self.segment
            ),
        }
    }
}
