//! The path of the wire's centre, as data, and why there may be none.

use crate::drawing::EntityId;
use crate::finding::{Finding, Place};
use crate::geometry::{Point, Segment, Side};
use crate::settings::Effective;

/// The source of a piece of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The offset of this segment of an entity.
    Segment {
        entity: EntityId,
        segment: usize,
    },
    /// The way round the convex corner at the end of this segment.
    Corner {
        entity: EntityId,
        segment: usize,
    },
    /// On along this segment past the place where the contour is closed.
    Overlap {
        entity: EntityId,
        segment: usize,
    },
    /// At the end of a tab, from the path of one pass to that of the next.
    Tab,
    LeadIn,
    LeadOut,
}

impl Source {
    /// The segment of the drawing, where it is of one.
    pub(crate) fn segment(self) -> Option<(EntityId, usize)> {
        match self {
            Source::Segment { entity, segment }
            | Source::Corner { entity, segment }
            | Source::Overlap { entity, segment } => Some((entity, segment)),
            Source::Tab | Source::LeadIn | Source::LeadOut => None,
        }
    }

    /// The same as the place of a finding.
    pub(crate) fn place(self) -> Option<Place> {
        let (entity, segment) = self.segment()?;
        Some(Place::Segment { entity, segment })
    }
}

/// One piece of the path of the wire's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSegment {
    pub geometry: Segment,
    pub source: Source,
}

/// The path of the wire's centre for one contour in one pass, in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub struct WirePath {
    /// Index of the outline in the drawing's list.
    pub outline: usize,
    /// 1-based number of the pass.
    pub pass: usize,
    /// The direction of a closed contour in this pass; `None` where it is open.
    pub counter_clockwise: Option<bool>,
    /// It cuts off the tab that the passes of the contour have left; before its first pass the machine stops.
    pub cut_off: bool,
    /// It goes back along what its pass has cut up to the tab, and cuts nothing: the next pass goes the same way.
    pub is_way_back: bool,
    /// The distance of the path from the contour, drawing units; 0 where the contour is the path.
    pub correction: f64,
    /// The contour is cut on the line, beside others that are cut with a correction.
    pub on_line: bool,
    /// The thread hole, to which the wire returns.
    pub thread_hole: Point,
    /// The side of travel on which the control must let the wire run; `None` where the path is that of the wire.
    pub side: Option<Side>,
    /// In order of travel, lead-in and lead-out included.
    pub segments: Vec<PathSegment>,
}

impl WirePath {
    /// The first pass along some pieces, which are the wire's own path.
    pub fn along(thread_hole: Point, segments: Vec<PathSegment>) -> WirePath {
        WirePath {
            outline: 0,
            pass: 1,
            counter_clockwise: None,
            cut_off: false,
            is_way_back: false,
            correction: 0.0,
            on_line: false,
            thread_hole,
            side: None,
            segments,
        }
    }

    /// The distance of the wire's centre from the contour, mm: where the control offsets, by how much it has to.
    pub(crate) fn offset(&self, settings: &Effective, unit_mm: f64) -> f64 {
        let of_passes = settings.each_correction();
        let of_pass = of_passes.get(self.pass.saturating_sub(1)).copied();
        match self.side {
            Some(_) => of_pass.unwrap_or(settings.correction),
            None => self.correction * unit_mm,
        }
    }

    /// The first path of its contour.
    pub(crate) fn is_first(&self) -> bool {
        self.pass == 1 && !self.cut_off && !self.is_way_back
    }

    /// It begins and ends in the thread hole.
    pub(crate) fn returns(&self) -> bool {
        [self.begin(), self.end()] == [self.thread_hole; 2]
    }

    /// It cuts a tab that another pass has cut before, from that pass's end: the machine does not stop in between.
    pub(crate) fn goes_back_along_tab(&self) -> bool {
        self.cut_off && self.pass > 1 && self.begin() != self.thread_hole
    }

    /// It runs along an open contour among others, and does not end where it begins.
    pub(crate) fn is_open(&self) -> bool {
        let is_of_part = self.correction > 0.0 || self.side.is_some() || self.on_line;
        self.counter_clockwise.is_none() && is_of_part && self.end() != self.begin()
    }

    /// The start of the path; the thread hole if the wire only stands.
    pub fn begin(&self) -> Point {
        let first = self.segments.first();
        first.map_or(self.thread_hole, |piece| piece.geometry.start())
    }

    /// The end of the path; the thread hole if the wire only stands.
    pub fn end(&self) -> Point {
        let last = self.segments.last();
        last.map_or(self.thread_hole, |piece| piece.geometry.end())
    }
}

/// Lengths in drawing units: of the cuts, with leads and all passes, and of the ways without a cut: from each path to
/// the next, and back along what has been cut.
pub(crate) fn lengths(paths: &[WirePath]) -> (f64, f64) {
    let along = |is_way_back: bool| {
        let own = paths
            .iter()
            .filter(move |path| path.is_way_back == is_way_back);
        let segments = own.flat_map(|path| &path.segments);
        // The sum of no numbers is -0.
        segments.fold(0.0, |sum, segment| sum + segment.geometry.length())
    };
    let pairs = paths.iter().zip(paths.iter().skip(1));
    let jumps = pairs.map(|(path, next)| (next.begin() - path.end()).norm());
    (along(false), jumps.fold(along(true), |sum, way| sum + way))
}

/// Why there is no path; a plain sentence for the user, in lower case without a full stop.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    Sentence(String),
    /// Refused for the geometry: errors in the drawing, at their places. Some, such as `lead-in`, only arise when a
    /// path is requested.
    Findings(Vec<Finding>),
    /// The caller cancelled.
    Cancelled,
}

impl From<Finding> for Refusal {
    fn from(finding: Finding) -> Refusal {
        Refusal::Findings(vec![finding])
    }
}

impl From<Vec<Finding>> for Refusal {
    fn from(findings: Vec<Finding>) -> Refusal {
        Refusal::Findings(findings)
    }
}
