//! The subject of a picture: the drawing with its contours, its faults and the paths of the wire.

use super::View;
use crate::drawing::{Contour, Drawing, EntityId, Outline};
use crate::finding::{Detail, Finding, Place, Severity, SmallRadius};
use crate::geometry::{Arc, Bounds, Point};
use crate::settings::Effective;
use crate::toolpath::WirePath;
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;

/// Up to this many segments each one is an element of its own, with a tooltip; beyond it each entity is.
pub(super) const TOOLTIP_SEGMENTS: usize = 4000;

/// Everything shown.
pub(super) struct Subject<'a> {
    pub(crate) drawing: &'a Drawing,
    /// The box of all of it, drawing units.
    pub(crate) bounds: Bounds,
    pub(crate) outlines: &'a [Outline],
    /// The entities of the outlines.
    pub(crate) cut: FxHashSet<EntityId>,
    pub(crate) findings: &'a [Finding],
    pub(crate) faults: Vec<Fault<'a>>,
    pub(crate) paths: &'a [WirePath],
    /// For each path the distance of the wire's centre from the contour, drawing units.
    pub(crate) corrections: Vec<f64>,
    /// The paths of each part of a pair; else all of them as one.
    pub(crate) parts: Vec<PartPaths<'a>>,
    /// For each path the half width of its kerf, drawing units; `None` where the control offsets it, and for the parts of a pair.
    pub(crate) half_kerfs: Vec<Option<f64>>,
    pub(crate) drill: Drill,
    /// The paths are those of an electrode.
    pub(crate) mills: bool,
    /// Its radius, drawing units.
    pub(crate) electrode: Option<f64>,
    pub(crate) unit_mm: f64,
    /// Where the correction comes from.
    pub(crate) origin: &'static str,
}

/// The paths of one part of a pair, or all that there are.
pub(super) struct PartPaths<'a> {
    /// Its name for people; nothing where the drawing is no pair.
    pub(crate) title: Option<&'a str>,
    pub(crate) paths: &'a [WirePath],
    /// Of each pass, drawing units.
    pub(crate) corrections: Vec<f64>,
}

/// The start holes that are drilled.
pub(super) struct Drill {
    /// Drawing units, where a diameter is set.
    radius: Option<f64>,
    /// Where a hole would cut into a contour: none is drilled.
    impossible: Vec<Point>,
}

impl Drill {
    /// The radius of the hole in `at`, if one is drilled there.
    pub(crate) fn radius_at(&self, at: Point) -> Option<f64> {
        self.radius.filter(|_| !self.impossible.contains(&at))
    }
}

/// An arc that is too tight, and the name of its segment.
pub(super) struct Fault<'a> {
    pub(crate) detail: &'a SmallRadius,
    pub(crate) handle: String,
    pub(crate) segment: usize,
    pub(crate) entity: Option<EntityId>,
    pub(crate) severity: Severity,
}

impl<'a> Subject<'a> {
    /// `None` where nothing finite is drawn.
    pub(crate) fn new(view: &View<'a>) -> Option<Subject<'a>> {
        let View {
            drawing,
            outlines,
            findings,
            paths,
            parts,
            holes,
            settings,
            ..
        } = *view;
        let unit_mm = settings.unit_of(drawing).mm;
        let beside = paths.iter().filter(|path| !path.on_line);
        let last = beside.map(|path| path.correction);
        let last = last.fold(f64::INFINITY, f64::min);
        let half_kerf = |path: &WirePath| {
            let known = settings.half_kerf(path.pass.saturating_sub(1));
            let half = known.map_or(last, |half| half / unit_mm);
            let is_shown = parts.is_empty() && path.side.is_none();
            (is_shown && half.is_finite() && half > 0.0).then_some(half)
        };
        let own = |title, paths: &'a [WirePath], settings: &Effective| {
            let correction = |path: &WirePath| path.offset(settings, unit_mm) / unit_mm;
            let each: Vec<f64> = paths.iter().map(correction).collect();
            // What is cut on the line has none, unless there is nothing else.
            let is_any = paths.iter().any(|path| !path.on_line);
            let passes = paths.iter().zip(&each);
            let passes = passes.filter(|(path, _)| !is_any || !path.on_line);
            let passes: BTreeMap<usize, f64> =
                passes.map(|(path, own)| (path.pass, *own)).rev().collect();
            let corrections = passes.into_values().collect();
            let part = PartPaths {
                title,
                paths,
                corrections,
            };
            (part, each)
        };
        let mut rest = paths;
        let mut of_parts: Vec<(PartPaths, Vec<f64>)> = Vec::new();
        for part in parts {
            let (these, next) = rest.split_at_checked(part.paths).unwrap_or((rest, &[]));
            of_parts.push(own(Some(part.title.as_str()), these, part.settings));
            rest = next;
        }
        if parts.is_empty() {
            of_parts.push(own(None, rest, settings));
        }
        let (of_parts, corrections): (Vec<_>, Vec<_>) = of_parts.into_iter().unzip();
        let drill = Drill {
            radius: settings.start_hole.map(|diameter| diameter / 2.0 / unit_mm),
            impossible: holes
                .iter()
                .filter(|hole| hole.cuts)
                .map(|hole| hole.at)
                .collect(),
        };
        let pieces = outlines.iter().flat_map(|outline| &outline.contour.pieces);
        Some(Subject {
            drawing,
            bounds: extents(drawing, paths, &drill)?,
            outlines,
            mills: settings.mills,
            electrode: (settings.milling.tool_diameter)
                .filter(|_| settings.mills)
                .map(|diameter| diameter / 2.0 / unit_mm),
            cut: pieces.map(|piece| piece.entity).collect(),
            findings,
            faults: tight_arcs(drawing, findings),
            paths,
            parts: of_parts,
            corrections: corrections.concat(),
            half_kerfs: paths.iter().map(half_kerf).collect(),
            drill,
            unit_mm,
            origin: settings.origins.correction.title(),
        })
    }

    /// About how many elements it is drawn with.
    pub(crate) fn elements(&self) -> usize {
        let contours = || self.outlines.iter().map(|outline| &outline.contour);
        let segments: usize = contours().map(Contour::len).sum();
        let of_contours = match segments > TOOLTIP_SEGMENTS {
            true => self.cut.len(),
            false => segments,
        };
        let asides = self.drawing.entities().count() - self.cut.len();
        // A path has two leads, the way between them, its kerf and a jump.
        of_contours + asides + 5 * self.paths.len() + self.findings.len()
    }

    /// The box of everything that is cut, or of everything shown where nothing is cut.
    pub(crate) fn extents(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for outline in self.outlines {
            bounds.merge(&outline.contour.bounds(self.drawing));
        }
        match bounds.is_empty() {
            true => self.bounds,
            false => bounds,
        }
    }

    /// The drawing's zero is in the picture.
    pub(crate) fn shows_zero(&self) -> bool {
        let zero = Bounds::of_points(&[Point::origin()]);
        self.bounds.merged(&zero) == self.bounds
    }

    pub(crate) fn mm(&self, length: f64) -> f64 {
        length * self.unit_mm
    }
}

impl Fault<'_> {
    /// The arc as it was found, which may differ from the drawing's present one.
    pub(crate) fn arc(&self) -> Arc {
        let detail = self.detail;
        let from = detail.start - detail.center;
        Arc {
            center: detail.center,
            radius: detail.radius,
            start_angle: from.y.atan2(from.x),
            sweep: detail.sweep,
            start: detail.start,
            end: detail.end,
        }
    }

    /// Centre of the circle of the correction where it touches both neighbours of a fillet.
    ///
    /// From a half turn on no circle touches both; it is then shown about the arc's own centre.
    pub(crate) fn correction_disc(&self) -> Point {
        let arc = self.arc();
        let opening = (arc.sweep.abs() / 2.0).cos();
        let inward = (arc.center - arc.point_at(0.5)).try_normalize(0.0);
        match inward {
            Some(inward) if arc.sweep.abs() < 2.8 => {
                arc.center + inward * ((self.detail.required - arc.radius) / opening)
            }
            _ => arc.center,
        }
    }
}

fn tight_arcs<'a>(drawing: &Drawing, findings: &'a [Finding]) -> Vec<Fault<'a>> {
    let faults = findings.iter().filter_map(|finding| {
        let Detail::SmallRadius(detail) = &finding.detail else {
            return None;
        };
        let (entity, segment) = match finding.place {
            Place::Segment { entity, segment } => (Some(entity), segment),
            Place::Entity { entity } => (Some(entity), 0),
            _ => (None, 0),
        };
        let handle = entity
            .and_then(|id| drawing.get(id))
            .map_or_else(String::new, |entity| entity.handle.to_string());
        Some(Fault {
            detail,
            handle,
            segment,
            entity,
            severity: finding.severity,
        })
    });
    faults.collect()
}

/// The box of the drawing and the paths; `None` where nothing finite is drawn.
fn extents(drawing: &Drawing, paths: &[WirePath], drill: &Drill) -> Option<Bounds> {
    let mut bounds = Bounds::EMPTY;
    for (_, entity) in drawing.entities() {
        bounds.merge(&entity.geometry.bounds(drawing.flat()));
    }
    for path in paths {
        let radius = drill.radius_at(path.thread_hole).unwrap_or(0.0);
        bounds.merge(&Bounds::of_disc(path.thread_hole, radius));
        path.segments
            .iter()
            .for_each(|segment| bounds.merge(&segment.geometry.bounds()));
    }
    // An empty drawing gives an infinite box, and so do coordinates whose difference overflows.
    let lengths = [
        bounds.min.x,
        bounds.min.y,
        bounds.max.x - bounds.min.x,
        bounds.max.y - bounds.min.y,
    ];
    lengths
        .iter()
        .all(|length| length.is_finite())
        .then_some(bounds)
}

/// The number of the mark of each finding, from 1; those of arcs that are too tight come first. The picture, and every list beside it, has
/// these.
pub(crate) fn mark_numbers(findings: &[Finding]) -> Vec<Option<usize>> {
    let is_tight = |finding: &&Finding| matches!(finding.detail, Detail::SmallRadius(_));
    let mut tight = 0;
    let mut others = findings.iter().filter(is_tight).count();
    let number = |finding: &Finding| {
        let of = match is_tight(&finding) {
            true => &mut tight,
            false if is_other(finding) => &mut others,
            false => return None,
        };
        *of += 1;
        Some(*of)
    };
    findings.iter().map(number).collect()
}

/// An error or a warning on a segment, of any rule but `small-radius`; and the hints about a single place.
pub(super) fn is_other(finding: &Finding) -> bool {
    let is_of_segment = matches!(finding.place, Place::Segment { .. });
    let is_of_one_place = matches!(
        finding.detail,
        Detail::NearTangent { .. }
            | Detail::NearTangents { .. }
            | Detail::ArcAsChords { .. }
            | Detail::ArcsAsChords { .. }
    );
    is_of_segment
        && (finding.severity <= Severity::Warning || is_of_one_place)
        && !matches!(finding.detail, Detail::SmallRadius(_))
}
