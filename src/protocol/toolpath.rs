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
    /// What the paths come to on the machine; of a pair that of each part is in `parts`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) work: Option<Work>,
    /// The parts of a pair, where the drawing is one of which everything is set.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) parts: Vec<ToolpathPart>,
}

/// One part of a pair, cut by the correction that `wedm/pair` gives it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ToolpathPart {
    /// `punch`, `plate`, `stripper`, `holder`, or the name of a workpiece.
    pub(crate) part: String,
    /// The correction of each pass, mm; below 0 for passes on the other side of the drawn outline, where not all run there.
    pub(crate) corrections: Vec<f64>,
    /// The wire runs on the other side of the drawn outline.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) other_side: bool,
    pub(crate) work: Work,
}

/// The path for one contour in one pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ToolpathPath {
    /// Index of the contour in the reply of `wedm/contours`.
    pub(crate) contour: usize,
    /// The part of a pair that it cuts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) part: Option<String>,
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
            parts: Vec::new(),
        }
    }

    /// The same as those of a part of a pair; `places` are those of its outlines among all of the drawing.
    pub(crate) fn of_part(
        self,
        part: &str,
        corrections: &[f64],
        other_side: bool,
        places: &[usize],
    ) -> Toolpath {
        let name = || Some(part.to_owned());
        let path = |path: ToolpathPath| ToolpathPath {
            contour: places.get(path.contour).copied().unwrap_or_default(),
            part: name(),
            ..path
        };
        let hole = |hole: StartHole| StartHole {
            part: name(),
            ..hole
        };
        let part = self.work.map(|work| ToolpathPart {
            part: part.to_owned(),
            corrections: corrections.to_vec(),
            other_side,
            work,
        });
        Toolpath {
            units_to_mm: self.units_to_mm,
            paths: self.paths.into_iter().map(path).collect(),
            holes: self.holes.into_iter().map(hole).collect(),
            work: None,
            parts: part.into_iter().collect(),
        }
    }

    /// Several in one reply.
    pub(crate) fn together(each: impl Iterator<Item = Toolpath>) -> Option<Toolpath> {
        each.reduce(|mut all, next| {
            all.paths.extend(next.paths);
            all.holes.extend(next.holes);
            all.parts.extend(next.parts);
            all
        })
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
        part: None,
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
