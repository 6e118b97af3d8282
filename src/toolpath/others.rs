//! Paths and ways beside the other contours of the workpiece, which none of them may cut into.

use super::clearance::Walls;
use super::contours::Contours;
use super::corners::Element;
use super::job::Job;
use super::leads::{fault, finding};
use super::offset::Wall;
use super::path::{Refusal, WirePath};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::Segment;
use crate::settings::Jumps;

impl Job<'_> {
    /// The path of a pass as it is written, which keeps the correction from all other contours, too.
    pub(super) fn beside_others(
        &self,
        path: Vec<Element>,
        (walls, own): (&[Wall], &Walls),
        correction: f64,
        index: usize,
        contours: &Contours,
    ) -> Result<Vec<Element>, Refusal> {
        let clearance = self.clearance(correction.abs());
        let met = |piece: &Segment| match self.outlines.len() {
            1 => None,
            _ => self.met(piece, clearance, contours, Some(index)),
        };
        let path = self.with_corners(path, (walls, own), correction, &|piece| {
            met(piece).is_some()
        });
        let into = |element: &Element| Some((element.source, met(&element.geometry)?));
        let Some((source, wall)) = path.iter().find_map(into) else {
            return Ok(path);
        };
        let sentence = say!(
            the_path_comes_too_near_to_contour,
            self.name(index),
            correction.abs() * self.unit_mm,
            self.name(contours.outline_of(wall))
        );
        let severity = self.settings.severity(Rule::UnprovedPath);
        let severity = severity.unwrap_or(Severity::Error);
        let (place, other) = (source.place(), contours.place_of(wall));
        Err(finding(Rule::UnprovedPath, severity, place, sentence, Some(other)).into())
    }

    /// The wall of a contour, `but` for one of them, that a straight way cuts. One that is open and has no side is nobody's part.
    pub(super) fn crossed(
        &self,
        way: &Segment,
        contours: &Contours,
        but: Option<usize>,
    ) -> Option<usize> {
        let clearance = self.clearance(self.units(self.settings.correction));
        self.met(way, clearance, contours, but)
    }

    /// The same for any piece of a path, which is to keep a distance, drawing units.
    fn met(
        &self,
        piece: &Segment,
        clearance: f64,
        contours: &Contours,
        but: Option<usize>,
    ) -> Option<usize> {
        let counts = |wall: usize, _| {
            let index = contours.outline_of(wall);
            let outline = &self.outlines[index];
            Some(index) != but && (outline.contour.closed || outline.wire_side().is_some())
        };
        contours.walls().find_near(piece, clearance, counts)
    }

    /// The ways from one contour to the next that cut through a part, where the wire stays threaded.
    pub(crate) fn jumps_that_cut(&self, paths: &[WirePath], contours: &Contours) -> Vec<Finding> {
        if !self.settings.stays_threaded || self.settings.jumps == Jumps::None {
            return Vec::new();
        }
        let cut = |pair: &[WirePath]| {
            let (from, next) = (pair[0].segments.last()?.geometry.end(), &pair[1]);
            let to = next.segments.first()?.geometry.start();
            if from == to {
                return None;
            }
            let wall = self.crossed(&Segment::line(from, to), contours, None)?;
            let [from, to] = [from, to].map(|at| self.in_mm(at));
            let sentence = say!(
                the_way_cuts_into_contour,
                from.x,
                from.y,
                to.x,
                to.y,
                self.name(contours.outline_of(wall))
            );
            let source = next
                .segments
                .iter()
                .map(|piece| piece.source)
                .find(|source| source.place().is_some());
            Some(fault(
                self.severity(),
                source,
                sentence,
                Some(contours.place_of(wall)),
            ))
        };
        paths.windows(2).filter_map(cut).collect()
    }
}
