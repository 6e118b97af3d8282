//! `wedm/fit` and `wedm/pair`: whether two parts fit, and the programs of all parts of a pair.

use super::generate::Program;
use crate::drawing::Drawing;
use crate::fit;
use crate::geometry::Xy as Point;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Result of `wedm/fit`: each outline as the wire leaves it, laid in the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Fit {
    /// Nowhere do two parts of a pair bind.
    pub fits: bool,
    /// Clearance that there should be, mm a side.
    pub clearance: f64,
    /// The least clearance that is left anywhere, mm; below 0 where two parts bind. Where no contour has a partner, nothing is compared: that
    /// which there should be.
    pub least: f64,
    /// Every place where less is left than there should be.
    pub places: Vec<FitPlace>,
    /// Contours of workpieces that have no partner.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alone: Vec<FitAlone>,
    /// One outline in the other, the places marked.
    pub svg: String,
}

/// A place where clearance is missing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct FitPlace {
    /// On the outline that stands too far out, drawing units.
    pub at: Point,
    /// What is left there, mm; below 0 where the parts bind.
    pub clearance: f64,
    pub handle: String,
    /// Index within the entity.
    pub segment: usize,
    /// The part that stands too far out, of which the segment is: `punch`, `plate`, or the name of a workpiece.
    pub of: String,
}

/// A contour without a partner.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct FitAlone {
    pub handle: String,
    /// Its workpiece.
    pub of: String,
}

impl Fit {
    /// True where no contour has a partner.
    pub(crate) fn compares_nothing(&self) -> bool {
        !self.fits && self.places.is_empty()
    }

    pub(crate) fn new(drawing: &Drawing, fit: &fit::Fit, svg: String, unit_mm: f64) -> Fit {
        let handle = |(entity, _): fit::SegmentOf| {
            let entity = drawing.get(entity);
            entity.map_or_else(String::new, |entity| entity.handle.to_string())
        };
        let place = |spot: &fit::Spot| FitPlace {
            at: spot.at.into(),
            clearance: spot.clearance * unit_mm,
            handle: handle(spot.segment),
            segment: spot.segment.1,
            of: spot.of.to_string(),
        };
        let alone = fit.alone.iter().map(|(segment, of)| FitAlone {
            handle: handle(*segment),
            of: of.to_string(),
        });
        Fit {
            fits: fit.fits(),
            clearance: fit.clearance * unit_mm,
            least: fit.least() * unit_mm,
            places: fit.spots().map(place).collect(),
            alone: alone.collect(),
            svg,
        }
    }
}

/// Result of `wedm/pair`: a program for each part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct PairPrograms {
    pub programs: Vec<PairProgram>,
}

/// The program of one part of a pair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct PairProgram {
    /// `punch`, `plate`, `stripper`, `holder`, or the name of a workpiece.
    pub part: String,
    /// Correction of each pass, mm. Below 0 for the passes on the other side of what is drawn, where the clearance lies between the
    /// corrections; where they all run there, how far they are from it, with `otherSide`.
    pub corrections: Vec<f64>,
    /// The clearance is not smaller than the correction: the wire runs on what is drawn or on its other side.
    pub(crate) other_side: bool,
    #[serde(flatten)]
    pub program: Program,
}
