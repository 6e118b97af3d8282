//! The reply of `wedm/toolpath`: the path of the wire's centre.

use super::contours::Direction;
use super::segment::SegmentShape;
use super::work::{StartHole, Work};
use crate::analysis;
use crate::drawing::{Drawing, Outline};
use crate::geometry::Xy as Point;
use crate::settings::Effective;
use crate::toolpath::{Planned, Source, WirePath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Wire paths in machining order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Toolpath {
    /// Millimetres in one drawing unit.
    pub(crate) units_to_mm: f64,
    pub(crate) paths: Vec<ToolpathPath>,
    /// Where the wire is threaded, in the order of the cuts.
    #[serde(default)]
    pub(crate) holes: Vec<StartHole>,
    /// What the paths come to on the machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) work: Option<Work>,
}

/// The path for one contour in one pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ToolpathPath {
    /// Index of the contour in the reply of `wedm/contours`.
    pub(crate) contour: usize,
    /// 1-based number of the pass.
    pub(crate) pass: usize,
    /// Which way a closed contour is gone round in this pass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) direction: Option<Direction>,
    /// How far the path lies from the contour, drawing units.
    pub(crate) correction: f64,
    pub(crate) thread_hole: Point,
    /// Drawing units, leads included.
    pub(crate) length: f64,
    pub(crate) segments: Vec<PathPiece>,
}

/// What a piece of the path follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum PathSource {
    Segment,
    /// The way round the convex corner at the end of a segment.
    Corner,
    LeadIn,
    LeadOut,
    /// At the end of a tab, from one pass to the next.
    Tab,
    /// Along the tab, which it cuts off.
    CutOff,
    /// On past the place where the contour is closed.
    Overlap,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct PathPiece {
    pub(crate) source: PathSource,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) handle: Option<String>,
    /// Index within the entity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
    #[serde(flatten)]
    pub(crate) shape: SegmentShape,
}

impl Toolpath {
    /// The paths that have been planned for a drawing under its settings.
    pub(crate) fn new(
        drawing: &Drawing,
        outlines: &[Outline],
        settings: &Effective,
        planned: &Planned,
    ) -> Toolpath {
        let paths = &planned.paths;
        let holes = planned.holes.iter();
        let work = analysis::work(drawing, outlines, settings, paths);
        Toolpath {
            units_to_mm: settings.unit_of(drawing).mm,
            paths: paths.iter().map(|path| one_path(drawing, path)).collect(),
            holes: holes
                .map(|hole| StartHole::new(drawing, outlines, settings, hole))
                .collect(),
            work: Some(Work::new(drawing, outlines, &work)),
        }
    }
}

fn one_path(drawing: &Drawing, path: &WirePath) -> ToolpathPath {
    let segments = path.segments.iter().map(|piece| {
        let (source, of) = match piece.source {
            Source::Segment { entity, segment } => (PathSource::Segment, Some((entity, segment))),
            Source::Corner { entity, segment } => (PathSource::Corner, Some((entity, segment))),
            Source::LeadIn => (PathSource::LeadIn, None),
            Source::LeadOut => (PathSource::LeadOut, None),
            Source::Tab => (PathSource::Tab, None),
            Source::Overlap { entity, segment } => (PathSource::Overlap, Some((entity, segment))),
        };
        let source = match source {
            PathSource::Segment | PathSource::Corner if path.cut_off => PathSource::CutOff,
            source => source,
        };
        PathPiece {
            source,
            handle: of.and_then(|(entity, _)| Some(drawing.get(entity)?.handle.to_string())),
            segment: of.map(|(_, segment)| segment),
            shape: SegmentShape::from(&piece.geometry),
        }
    });
    ToolpathPath {
        contour: path.outline,
        pass: path.pass,
        direction: path.counter_clockwise.map(|is| match is {
            true => Direction::Ccw,
            false => Direction::Cw,
        }),
        correction: path.correction,
        thread_hole: path.thread_hole.into(),
        length: path
            .segments
            .iter()
            .map(|piece| piece.geometry.length())
            .sum(),
        segments: segments.collect(),
    }
}
