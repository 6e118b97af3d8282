//! The drawing itself: areas, contours, entities that are not cut, the wire's path and the faults on it.

use super::areas;
use super::marks::{self, Spot};
use super::numbers::number;
use super::room::Room;
use super::sheet::{Frame, Sheet, escaped, named, path_data};
use super::style::class_of;
use super::subject::{Subject, is_other, mark_numbers};
use crate::drawing::{Entity, EntityId, Geometry};
use crate::finding::{Detail, Finding, Place, Severity};
use crate::geometry::{Point, Segment};
use crate::toolpath::{Source, lengths};
use rustc_hash::FxHashSet;

/// Radius of the dot at a fault, by its severity: a hint is a small ring.
const fn dot_of(severity: Severity) -> f64 {
    match severity {
        Severity::Error => 4.5,
        Severity::Warning => 3.6,
        Severity::Information | Severity::Hint => 2.4,
    }
}
/// A segment that is shorter on the sheet is shown as a dot.
const TOO_SHORT: f64 = 4.5;
/// Up to this many segments each one is an element of its own, with a tooltip; beyond it each entity is.
const TOOLTIP_SEGMENTS: usize = 4000;

/// Draws it, and notes in `room` where there is something. The places of the marks that have a number come back, by number.
pub(super) fn figure(
    sheet: &mut Sheet,
    frame: &Frame,
    subject: &Subject,
    room: &mut Room,
) -> Vec<Spot> {
    sheet.line(format_args!(
        "{}",
        frame.opening_of_drawing(
            subject.unit_mm,
            (!subject.paths.is_empty()).then(|| {
                let cut = subject.parts.iter().map(|part| lengths(part.paths).0);
                subject.mm(cut.sum())
            })
        )
    ));
    areas::areas(sheet, frame, subject);
    asides(sheet, frame, subject);
    let others = others(subject, frame);
    let is_hint = |other: &&Other| other.finding.severity > Severity::Warning;
    others
        .iter()
        .filter(is_hint)
        .for_each(|other| other.draw(sheet, frame));
    contours(sheet, frame, subject);
    wire(sheet, frame, subject);
    datum(sheet, frame, subject);
    let is_fault = |other: &&Other| !is_hint(other);
    others
        .iter()
        .filter(is_fault)
        .for_each(|other| other.draw(sheet, frame));
    for fault in &subject.faults {
        let (handle, segment, detail) = (&fault.handle, fault.segment, fault.detail);
        let (radius, required) = (subject.mm(detail.radius), subject.mm(detail.required));
        let label = say!(
            a_segment_tighter_than_the_correction,
            handle,
            segment,
            radius,
            required
        );
        let data = path_data(frame, [Segment::Arc(fault.arc())], false);
        let class = format!("fault {}", class_of(fault.severity));
        sheet.path(&named(&class, handle, segment), &data, &label);
        let middle = frame.local(fault.correction_disc());
        let radius = detail.required * frame.scale;
        sheet.circle(r#"class="correction fine""#, middle, radius, "");
    }
    note(room, frame, subject);
    marks::thread_holes(sheet, frame, subject, room);
    sheet.line(format_args!("</g>"));
    others.into_iter().map(|other| other.spot).collect()
}

/// The drawing's zero, where it is in the picture: x to the right and y up.
fn datum(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    if subject.shows_zero() {
        let (x, y) = frame.local(Point::origin());
        let [left, low, x, y] = [x - 8.0, y - 8.0, x, y].map(number);
        let data = format!("M{left} {y}h32M{x} {low}v32");
        sheet.path(r#"class="datum""#, &data, say!(the_zero_of_the_drawing));
    }
}

/// Notes the lines of contours and paths.
fn note(room: &mut Room, frame: &Frame, subject: &Subject) {
    for outline in subject.outlines {
        let segments = outline.contour.segments(subject.drawing);
        segments.for_each(|segment| room.line(frame, &segment.geometry));
    }
    let pieces = subject.paths.iter().flat_map(|path| &path.segments);
    pieces.for_each(|piece| room.line(frame, &piece.geometry));
}

/// The segments of an entity as path data.
fn data_of(frame: &Frame, subject: &Subject, entity: &Entity) -> String {
    let geometry = &entity.geometry;
    let segments = geometry.segments_of(subject.drawing.flat());
    path_data(frame, segments, geometry.is_closed())
}

/// Entities that are drawn and not cut.
fn asides(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let entities = subject.drawing.entities();
    for (_, entity) in entities.filter(|(id, _)| !subject.cut.contains(id)) {
        if let Geometry::Text { at, text } = &entity.geometry {
            let is_hole = |hole: Point| (hole - at).norm() * frame.scale < 1.0;
            let mut holes = subject.paths.iter().map(|path| path.thread_hole);
            if !text.is_empty() && !holes.any(is_hole) {
                marks::text(sheet, frame, *at, text);
            }
            continue;
        }
        let data = data_of(frame, subject, entity);
        let (kind, handle, layer) = (entity.kind, &entity.handle, &entity.layer);
        if !data.is_empty() {
            sheet.path(
                &format!(r#"class="aside" data-handle="{}""#, escaped(handle)),
                &data,
                &say!(on_layer_not_cut, kind, handle, layer),
            );
        }
    }
}

fn contours(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let outlines = || subject.outlines.iter().map(|outline| &outline.contour);
    let count: usize = outlines().map(|contour| contour.len()).sum();
    for piece in outlines().flat_map(|contour| &contour.pieces) {
        let Some(entity) = subject.drawing.get(piece.entity) else {
            continue;
        };
        let (kind, handle) = (entity.kind, &entity.handle);
        if count > TOOLTIP_SEGMENTS {
            sheet.path(
                &format!(r#"class="contour" data-handle="{}""#, escaped(handle)),
                &data_of(frame, subject, entity),
                &format!("{kind} {handle} · {}", say!(segments, piece.count())),
            );
            continue;
        }
        let segments = entity.geometry.segments_of(subject.drawing.flat());
        for (index, segment) in segments.enumerate() {
            let what = match segment {
                Segment::Line(line) => say!(line_mm, subject.mm(line.length())),
                Segment::Arc(arc) => {
                    let (radius, sweep) = (subject.mm(arc.radius), arc.sweep.to_degrees());
                    say!(arc_r_mm, radius, format!("{sweep:.1}"))
                }
            };
            sheet.path(
                &named("contour", handle, index),
                &path_data(frame, [segment], false),
                &format!(
                    "{kind} {handle} · {} · {what}",
                    say!(segment_by_number, index)
                ),
            );
        }
    }
}

/// The way without a cut from where one path ends to where the next begins.
fn jump(sheet: &mut Sheet, frame: &Frame, subject: &Subject, from: Point, to: Point) {
    if from != to {
        let way = Segment::line(from, to);
        let label = say!(way_without_a_cut_mm, subject.mm(way.length()));
        let data = path_data(frame, [way], false);
        sheet.path(r#"class="jump""#, &data, &label);
    }
}

/// The paths and the ways between them, in the order of travel.
fn wire(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let is_lead = |source: &Source| matches!(source, Source::LeadIn | Source::LeadOut);
    let mut before = None;
    let mut drawn: FxHashSet<String> = FxHashSet::default();
    let parts = subject.parts.iter();
    let of_part = parts.flat_map(|part| {
        let paths = part.paths.iter().enumerate();
        paths.map(move |(index, path)| (path, part.title, index == 0))
    });
    for ((path, part, is_first), correction) in of_part.zip(&subject.corrections) {
        if let Some(end) = before.replace(path.end()).filter(|_| !is_first) {
            jump(sheet, frame, subject, end, path.begin());
        }
        let distance = subject.mm(*correction);
        let mut label = match subject.mills {
            false if path.side.is_some() => say!(contour_that_the_control_offsets, distance),
            false => say!(path_of_the_wire_centre, distance),
            true => say!(path_of_the_electrode_axis, distance),
        };
        if path.pass > 1 || subject.paths.iter().any(|path| path.pass > 1) {
            label += &say!(of_pass, path.pass);
        }
        if let Some(part) = part {
            label = say!(of_a_part, part, label);
        }
        // Runs of one kind: the way round the contour is one line, the leads are others.
        for run in path
            .segments
            .chunk_by(|a, b| is_lead(&a.source) == is_lead(&b.source))
        {
            let data = path_data(frame, run.iter().map(|segment| segment.geometry), false);
            let back = || run.iter().rev().map(|segment| segment.geometry.reversed());
            let (class, label) = match run.first() {
                // Dashes upon dashes of the other way would look solid.
                Some(first) if is_lead(&first.source) => {
                    match drawn.contains(&path_data(frame, back(), false)) {
                        true => ("lead back", say!(lead_in_and_lead_out)),
                        false => {
                            drawn.insert(data.clone());
                            ("lead", say!(lead_in_and_lead_out))
                        }
                    }
                }
                _ if path.cut_off => ("wire tab", say!(the_tab)),
                _ => ("wire", label.as_str()),
            };
            let pass = path.pass;
            sheet.path(
                &format!(r#"class="{class}" data-pass="{pass}""#),
                &data,
                label,
            );
        }
    }
}

/// A finding without a picture of its own: a dot at a point, else a marked segment.
struct Other<'a> {
    finding: &'a Finding,
    spot: Spot,
    label: String,
    /// Path data where a segment is marked.
    data: Option<String>,
}

impl Other<'_> {
    fn draw(&self, sheet: &mut Sheet, frame: &Frame) {
        let (spot, severity) = (&self.spot, class_of(self.finding.severity));
        let named = |what: &str| named(&format!("{what} {severity}"), &spot.handle, spot.segment);
        match &self.data {
            Some(data) => sheet.path(&named("other"), data, &self.label),
            None => {
                let at = (spot.at.0 - frame.left, frame.bottom - spot.at.1);
                sheet.circle(
                    &named("dot"),
                    at,
                    dot_of(self.finding.severity),
                    &self.label,
                );
            }
        }
    }
}

fn others<'a>(subject: &Subject<'a>, frame: &Frame) -> Vec<Other<'a>> {
    let pieces = subject
        .outlines
        .iter()
        .map(|outline| &outline.contour.pieces);
    let reversed: FxHashSet<EntityId> = pieces
        .flatten()
        .filter(|piece| piece.reversed)
        .map(|piece| piece.entity)
        .collect();
    let numbered = subject.findings.iter().zip(mark_numbers(subject.findings));
    let others = numbered.filter_map(|(finding, number)| {
        let Place::Segment { entity, segment } = finding.place else {
            return None;
        };
        let number = number.filter(|_| is_other(finding))?;
        let found = subject.drawing.get(entity)?;
        let place = (found, segment, reversed.contains(&entity));
        other(subject, frame, (finding, number), place)
    });
    others.collect()
}

fn other<'a>(
    subject: &Subject,
    frame: &Frame,
    (finding, number): (&'a Finding, usize),
    (entity, segment, is_reversed): (&Entity, usize, bool),
) -> Option<Other<'a>> {
    let flat = subject.drawing.flat();
    let geometry = entity.geometry.segment_of(segment, flat)?;
    let point = match finding.detail {
        Detail::SelfIntersection { at, .. }
        | Detail::LostPocket { near: at }
        | Detail::UnprovedPath { near: at }
        | Detail::DeadEnd { near: at, .. } => Some(at),
        // Shown at the start of the segment in the direction of travel.
        Detail::SharpCorner { .. }
        | Detail::SharpCorners { .. }
        | Detail::NearTangent { .. }
        | Detail::NearTangents { .. }
        | Detail::Gap { .. } => Some(match is_reversed {
            true => geometry.end(),
            false => geometry.start(),
        }),
        // Too short to be visible.
        _ if geometry.length() * frame.scale < TOO_SHORT => Some(geometry.point_at(0.5)),
        _ => None,
    };
    let (handle, rule) = (&entity.handle, finding.rule.name());
    // Chords are drawn in full where they belong to one entity.
    let count = match finding.detail {
        Detail::ArcAsChords { chords, .. } => chords,
        _ => 1,
    };
    let from = match is_reversed {
        true => (segment + 1).saturating_sub(count),
        false => segment,
    };
    let all = entity.geometry.segments_of(flat).skip(from).take(count);
    let data = match point {
        Some(_) => None,
        None => Some(path_data(frame, all, false)),
    };
    Some(Other {
        finding,
        label: format!(
            "{number} · {handle} · {} · {rule}",
            say!(segment_by_number, segment)
        ),
        spot: Spot {
            number,
            at: frame.on_sheet(point.unwrap_or_else(|| geometry.point_at(0.5))),
            handle: handle.to_string(),
            segment,
            severity: finding.severity,
        },
        data,
    })
}
