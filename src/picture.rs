//! A picture of contours, faults and wire path as SVG, for people: one file that needs nothing beside it.
//!
//! It shows what others have found and planned and decides nothing. It knows drawings, findings and paths,
//! and nothing of files or protocols. The same input gives the same bytes.
//!
//! Whoever shows it to somebody who may point at it finds parts by their class: `figure` is the drawing, `lens` an enlarged
//! fault, `mark` the number beside one (with `data-at`, the point on the sheet that it belongs to), `chrome` what is
//! written about it, `fine` what is too small to be seen at this size. What stands for a segment says so in `data-handle` and `data-segment`.

mod figure;
mod lens;
mod marks;
mod program;
mod style;

pub use program::program_svg;

use crate::drawing::{Drawing, Entity, EntityId, Geometry, Outline, Role};
use crate::finding::{Detail, Finding, Place, Severity, SmallRadius};
use crate::geometry::{Bounds, Segment};
use crate::toolpath::{Source, WirePath};
use figure::{Frame, escaped, named, number, path_data};

use rustc_hash::FxHashSet;
use std::fmt::Write;

/// Width of the sheet and of the margin round it, in the picture's own units.
const SHEET_WIDTH: f64 = 960.0;
const MARGIN: f64 = 40.0;
/// The drawing keeps room at its sides for the numbers beside its faults.
const FIGURE_WIDTH: f64 = SHEET_WIDTH - 5.5 * MARGIN;
const FIGURE_HEIGHT: f64 = 560.0;
const FIGURE_TOP: f64 = 96.0;
/// How far the material reaches beyond an opening that no outline holds.
const GROUND: f64 = 22.0;
/// Up to this many segments each one is an element of its own, with a tooltip; beyond it each entity is.
/// Radius of the dot at a fault.
const DOT: f64 = 4.5;
const TOOLTIP_SEGMENTS: usize = 4000;

/// The drawing with its faults and the paths of the wire as one SVG.
///
/// `outlines` are what is cut; entities in none of them are drawn faintly. Every arc that is too tight is marked, and
/// the first ones are shown enlarged with the circle of the correction. `unit_mm` is the drawing's unit in mm: all
/// figures that a reader sees are in mm. The y axis points up, as in the drawing. A drawing without geometry gives
/// a sheet that says so.
pub fn svg(
    drawing: &Drawing,
    outlines: &[Outline],
    findings: &[Finding],
    paths: &[WirePath],
    unit_mm: f64,
) -> String {
    let Some(bounds) = extents(drawing, paths) else {
        return style::empty_sheet();
    };
    let scale = scale_to_fit(&bounds);
    let height = (bounds.height() * scale).max(24.0);
    let faults = tight_arcs(drawing, findings);
    let cut = outlines
        .iter()
        .flat_map(|outline| outline.contour.pieces.iter().map(|piece| piece.entity))
        .collect();
    let picture = Picture {
        drawing,
        bounds,
        outlines,
        cut,
        findings,
        faults,
        paths,
        unit_mm,
    };
    let left = (SHEET_WIDTH - bounds.width() * scale) / 2.0;
    let frame = Frame {
        origin: bounds.min,
        scale,
        left,
        bottom: FIGURE_TOP + height,
    };

    let details_top = frame.bottom + 48.0;
    let details_height = lens::height_of(picture.faults.len());
    let legend_top = details_top + details_height;
    let mut sheet = style::opening(SHEET_WIDTH, legend_top + 48.0, &picture.title());
    picture.header(&mut sheet);
    sheet.push_str("<g class=\"figure\">\n");
    picture.figure(&mut sheet, &frame);
    marks::faults(
        &mut sheet,
        &frame,
        &picture.faults,
        unit_mm,
        FIGURE_TOP - 26.0,
    );
    sheet.push_str("</g>\n");
    lens::row(&mut sheet, &picture, details_top);
    let shown = style::Shown {
        faults: !picture.faults.is_empty(),
        others: findings.iter().any(is_other),
        paths: !picture.paths.is_empty(),
    };
    sheet.push_str("<g class=\"chrome\">\n");
    style::legend(&mut sheet, legend_top + 12.0, shown);
    style::scale_bar(
        &mut sheet,
        SHEET_WIDTH - MARGIN,
        legend_top + 12.0,
        scale / unit_mm,
    );
    sheet.push_str("</g>\n</svg>\n");
    sheet
}

/// All that is shown.
struct Picture<'a> {
    drawing: &'a Drawing,
    /// The box of all of it, drawing units.
    bounds: Bounds,
    outlines: &'a [Outline],
    /// The entities of the outlines.
    cut: FxHashSet<EntityId>,
    findings: &'a [Finding],
    faults: Vec<Fault<'a>>,
    paths: &'a [WirePath],
    unit_mm: f64,
}

/// An arc that is too tight, and what its segment is called.
struct Fault<'a> {
    detail: &'a SmallRadius,
    handle: String,
    segment: usize,
    entity: Option<EntityId>,
}

impl Fault<'_> {
    /// The arc as it was found, which may differ from the drawing's present one.
    fn arc(&self) -> crate::geometry::Arc {
        let detail = self.detail;
        let start_angle =
            (detail.start.y - detail.center.y).atan2(detail.start.x - detail.center.x);
        crate::geometry::Arc {
            center: detail.center,
            radius: detail.radius,
            start_angle,
            sweep: detail.sweep,
            start: detail.start,
            end: detail.end,
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
        })
    });
    faults.collect()
}

/// The box of all that is drawn; `None` where nothing finite is.
fn extents(drawing: &Drawing, paths: &[WirePath]) -> Option<Bounds> {
    let mut bounds = Bounds::EMPTY;
    for (_, entity) in drawing.entities() {
        bounds.merge(&entity.geometry.bounds(drawing.flat()));
    }
    for path in paths {
        bounds.include(path.thread_hole);
        path.segments
            .iter()
            .for_each(|segment| bounds.merge(&segment.geometry.bounds()));
    }
    // Nothing gives an endless box, and so do coordinates whose difference is beyond all numbers.
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

fn scale_to_fit(bounds: &Bounds) -> f64 {
    let scale = (FIGURE_WIDTH / bounds.width()).min(FIGURE_HEIGHT / bounds.height());
    // A single point has no extent to fit.
    if scale.is_finite() && scale > 0.0 {
        scale
    } else {
        1.0
    }
}

impl Picture<'_> {
    fn mm(&self, length: f64) -> f64 {
        length * self.unit_mm
    }

    fn title(&self) -> String {
        match self.faults.len() {
            0 => "Contour and wire path".into(),
            1 => "1 arc is tighter than the correction".into(),
            count => format!("{count} arcs are tighter than the correction"),
        }
    }

    fn header(&self, sheet: &mut String) {
        let correction = self
            .faults
            .first()
            .map(|fault| fault.detail.required)
            .or(self.paths.first().map(|path| path.correction));
        let mut facts = Vec::new();
        if let Some(correction) = correction {
            facts.push(format!("correction {:.3} mm", self.mm(correction)));
        }
        facts.push(match self.outlines.len() {
            1 => "1 contour".into(),
            count => format!("{count} contours"),
        });
        if !self.paths.is_empty() {
            let length: f64 = self
                .paths
                .iter()
                .flat_map(|path| &path.segments)
                .map(|segment| segment.geometry.length())
                .sum();
            facts.push(format!("wire path {:.3} mm", self.mm(length)));
        }
        let _ = writeln!(
            sheet,
            r#"<g class="chrome"><text class="heading" x="{MARGIN}" y="34">{}</text>"#,
            escaped(&self.title())
        );
        let _ = writeln!(
            sheet,
            r#"<text class="note" x="{MARGIN}" y="52">{}</text></g>"#,
            escaped(&facts.join(" · "))
        );
    }

    fn figure(&self, sheet: &mut String, frame: &Frame) {
        let _ = writeln!(sheet, "{}", frame.opening_of_drawing(self.unit_mm));
        self.areas(sheet, frame);
        self.asides(sheet, frame);
        self.contours(sheet, frame);
        self.wire(sheet, frame);
        self.other_faults(sheet, frame);
        for fault in &self.faults {
            let arc = Segment::Arc(fault.arc());
            let _ = writeln!(
                sheet,
                r#"<path class="fault" {} d="{}"><title>{}</title></path>"#,
                named(&fault.handle, fault.segment),
                path_data(frame, [arc], false),
                escaped(&self.fault_label(fault))
            );
            let (x, y) = frame.local(lens::correction_disc(fault));
            let radius = fault.detail.required * frame.scale;
            let _ = writeln!(
                sheet,
                r#"<circle class="correction fine" cx="{}" cy="{}" r="{}"/>"#,
                number(x),
                number(y),
                number(radius)
            );
        }
        marks::thread_holes(sheet, frame, self);
        sheet.push_str("</g>\n");
    }

    fn fault_label(&self, fault: &Fault) -> String {
        let (radius, required) = (self.mm(fault.detail.radius), self.mm(fault.detail.required));
        format!(
            "{} · segment {} · R {radius:.3} mm, the correction is {required:.3} mm",
            fault.handle, fault.segment
        )
    }

    /// The insides of closed contours, the largest first, so that openings lie upon the part that holds them.
    fn areas(&self, sheet: &mut String, frame: &Frame) {
        let mut areas: Vec<(f64, &str, String)> = Vec::new();
        for (id, entity) in self.drawing.entities() {
            if entity.geometry.is_closed() && !self.cut.contains(&id) {
                let segments: Vec<Segment> =
                    entity.geometry.segments_of(self.drawing.flat()).collect();
                let bounds = entity.geometry.bounds(self.drawing.flat());
                areas.push((
                    bounds.width() * bounds.height() * 2.0,
                    "part",
                    path_data(frame, segments, true),
                ));
            }
        }
        for outline in self
            .outlines
            .iter()
            .filter(|outline| outline.contour.closed)
        {
            let class = if outline.role == Role::Opening {
                "void"
            } else {
                "part"
            };
            let segments = outline
                .contour
                .segments(self.drawing)
                .map(|segment| segment.geometry);
            areas.push((
                outline.twice_area.abs(),
                class,
                path_data(frame, segments, true),
            ));
        }
        areas.sort_by(|a, b| b.0.total_cmp(&a.0));
        if areas.first().is_some_and(|(_, class, _)| *class == "void") {
            let (width, height) = (
                self.bounds.width() * frame.scale,
                self.bounds.height() * frame.scale,
            );
            let _ = writeln!(
                sheet,
                r#"<rect class="part" x="-{GROUND}" y="-{GROUND}" width="{}" height="{}" rx="8"/>"#,
                number(width + 2.0 * GROUND),
                number(height + 2.0 * GROUND)
            );
        }
        for (_, class, data) in areas {
            let _ = writeln!(sheet, r#"<path class="{class}" d="{data}"/>"#);
        }
    }

    /// What is drawn and not cut.
    fn asides(&self, sheet: &mut String, frame: &Frame) {
        for (_, entity) in self
            .drawing
            .entities()
            .filter(|(id, _)| !self.cut.contains(id))
        {
            if let Geometry::Text { at, text } = &entity.geometry {
                if !text.is_empty()
                    && !self
                        .paths
                        .iter()
                        .any(|path| (path.thread_hole - at).norm() * frame.scale < 1.0)
                {
                    marks::text(sheet, frame, *at, text);
                }
                continue;
            }
            let data = path_data(
                frame,
                entity.geometry.segments_of(self.drawing.flat()),
                entity.geometry.is_closed(),
            );
            let label = format!(
                "{} {} on layer {}, not cut",
                entity.kind, entity.handle, entity.layer
            );
            if !data.is_empty() {
                let _ = writeln!(
                    sheet,
                    r#"<path class="aside" data-handle="{}" d="{data}"><title>{}</title></path>"#,
                    escaped(&entity.handle),
                    escaped(&label)
                );
            }
        }
    }

    fn contours(&self, sheet: &mut String, frame: &Frame) {
        let count: usize = self
            .outlines
            .iter()
            .map(|outline| outline.contour.len())
            .sum();
        for outline in self.outlines {
            for piece in &outline.contour.pieces {
                let Some(entity) = self.drawing.get(piece.entity) else {
                    continue;
                };
                if count > TOOLTIP_SEGMENTS {
                    let data = path_data(
                        frame,
                        entity.geometry.segments_of(self.drawing.flat()),
                        entity.geometry.is_closed(),
                    );
                    let label = format!(
                        "{} {} · {} segments",
                        entity.kind,
                        entity.handle,
                        piece.count()
                    );
                    let _ = writeln!(
                        sheet,
                        r#"<path class="contour" data-handle="{}" d="{data}"><title>{}</title></path>"#,
                        escaped(&entity.handle),
                        escaped(&label)
                    );
                    continue;
                }
                for (index, segment) in entity.geometry.segments_of(self.drawing.flat()).enumerate()
                {
                    let data = path_data(frame, [segment], false);
                    let label = escaped(&self.segment_label(entity, index, &segment));
                    let name = named(&entity.handle, index);
                    let _ = writeln!(
                        sheet,
                        r#"<path class="contour" {name} d="{data}"><title>{label}</title></path>"#
                    );
                }
            }
        }
    }

    fn segment_label(&self, entity: &Entity, index: usize, segment: &Segment) -> String {
        let what = match segment {
            Segment::Line(line) => format!("line, {:.3} mm", self.mm(line.length())),
            Segment::Arc(arc) => format!(
                "arc R {:.3} mm, {:.1}°",
                self.mm(arc.radius),
                arc.sweep.to_degrees()
            ),
        };
        format!(
            "{} {} · segment {index} · {what}",
            entity.kind, entity.handle
        )
    }

    fn wire(&self, sheet: &mut String, frame: &Frame) {
        for path in self.paths {
            let is_lead = |source: &Source| matches!(source, Source::LeadIn | Source::LeadOut);
            let label = format!(
                "path of the wire's centre, {:.3} mm from the contour",
                self.mm(path.correction)
            );
            // Runs of one kind: the way round the contour is one line, the leads are others.
            for run in path
                .segments
                .chunk_by(|a, b| is_lead(&a.source) == is_lead(&b.source))
            {
                let lead = run.first().is_some_and(|segment| is_lead(&segment.source));
                let (class, label) = if lead {
                    ("lead", "lead-in and lead-out")
                } else {
                    ("wire", label.as_str())
                };
                let data = path_data(frame, run.iter().map(|segment| segment.geometry), false);
                let _ = writeln!(
                    sheet,
                    r#"<path class="{class}" d="{data}"><title>{}</title></path>"#,
                    escaped(label)
                );
            }
        }
    }

    /// Errors and warnings that have no picture of their own: a dot where they are of a point, else the segment is marked.
    fn other_faults(&self, sheet: &mut String, frame: &Frame) {
        let pieces = self
            .outlines
            .iter()
            .flat_map(|outline| &outline.contour.pieces);
        let reversed: FxHashSet<EntityId> = pieces
            .filter(|piece| piece.reversed)
            .map(|piece| piece.entity)
            .collect();
        for finding in self.findings.iter().filter(|finding| is_other(finding)) {
            let Place::Segment {
                entity: id,
                segment,
            } = finding.place
            else {
                continue;
            };
            let Some(entity) = self.drawing.get(id) else {
                continue;
            };
            let Some(geometry) = entity.geometry.segment_of(segment, self.drawing.flat()) else {
                continue;
            };
            let point = match finding.detail {
                Detail::SelfIntersection { at, .. }
                | Detail::LostPocket { near: at }
                | Detail::UnprovedPath { near: at }
                | Detail::DeadEnd { near: at, .. } => Some(at),
                // Seen where the segment begins in the direction of travel.
                Detail::SharpCorner { .. } | Detail::NearTangent { .. } | Detail::Gap { .. } => {
                    Some(if reversed.contains(&id) {
                        geometry.end()
                    } else {
                        geometry.start()
                    })
                }
                // Too short to be seen.
                _ if geometry.length() * frame.scale < DOT => Some(geometry.point_at(0.5)),
                _ => None,
            };
            let label = format!(
                "<title>{} · segment {segment} · {}</title>",
                escaped(&entity.handle),
                finding.rule.name()
            );
            let name = named(&entity.handle, segment);
            let _ = match point.map(|point| frame.local(point)) {
                Some((x, y)) => {
                    writeln!(
                        sheet,
                        r#"<circle class="dot" {name} cx="{}" cy="{}" r="{DOT}">{label}</circle>"#,
                        number(x),
                        number(y)
                    )
                }
                None => {
                    // Chords are shown in full where they are of one entity.
                    let count = if let Detail::ArcAsChords { chords, .. } = finding.detail {
                        chords
                    } else {
                        1
                    };
                    let from = if reversed.contains(&id) {
                        (segment + 1).saturating_sub(count)
                    } else {
                        segment
                    };
                    let all = entity
                        .geometry
                        .segments_of(self.drawing.flat())
                        .skip(from)
                        .take(count);
                    writeln!(
                        sheet,
                        r#"<path class="other" {name} d="{}">{label}</path>"#,
                        path_data(frame, all, false)
                    )
                }
            };
        }
    }
}

/// An error or a warning on a segment, of any rule but `small-radius`; and the hints that are of one place.
fn is_other(finding: &Finding) -> bool {
    let is_of_segment = matches!(finding.place, Place::Segment { .. });
    let is_of_one_place = matches!(
        finding.detail,
        Detail::NearTangent { .. } | Detail::ArcAsChords { .. }
    );
    is_of_segment
        && (finding.severity <= Severity::Warning || is_of_one_place)
        && !matches!(finding.detail, Detail::SmallRadius(_))
}

#[cfg(test)]
mod tests;
