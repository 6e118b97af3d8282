//! The drawing itself: areas, contours, entities that are not cut, the wire's path and the faults on it.

use super::areas;
use super::marks::{self, Spot};
use super::numbers::number;
use super::pieces::What;
use super::room::Room;
use super::sheet::{Frame, Sheet};
use super::style::class_of;
use super::subject::{Subject, TOOLTIP_SEGMENTS, is_other, mark_numbers};
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
        let class = format!("fault {}", class_of(fault.severity));
        let what = What {
            handle: Some(handle),
            segment: Some(segment),
            ..What::of(&class)
        };
        sheet.draw(frame, &what, [Segment::Arc(fault.arc())], false, || {
            let (radius, required) = (subject.mm(detail.radius), subject.mm(detail.required));
            say!(
                a_segment_tighter_than_the_correction,
                handle,
                segment,
                radius,
                required
            )
        });
        if sheet.pieces.is_none() {
            let middle = frame.local(fault.correction_disc());
            let radius = detail.required * frame.scale;
            sheet.circle(r#"class="correction fine""#, middle, radius, "");
        }
    }
    if sheet.pieces.is_none() {
        note(room, frame, subject);
    }
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

/// Entities that are drawn and not cut.
fn asides(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let entities = subject.drawing.entities();
    for (_, entity) in entities.filter(|(id, _)| !subject.cut.contains(id)) {
        if let Geometry::Text { at, text } = &entity.geometry {
            let is_hole = |hole: Point| (hole - at).norm() * frame.scale < 1.0;
            let mut holes = subject.paths.iter().map(|path| path.thread_hole);
            if sheet.pieces.is_none() && !text.is_empty() && !holes.any(is_hole) {
                marks::text(sheet, frame, *at, text);
            }
            continue;
        }
        let (kind, handle, layer) = (entity.kind, &entity.handle, &entity.layer);
        let what = What {
            handle: Some(handle),
            ..What::of("aside")
        };
        let segments = entity.geometry.segments_of(subject.drawing.flat());
        let closed = entity.geometry.is_closed();
        sheet.draw(frame, &what, segments, closed, || {
            say!(on_layer_not_cut, kind, handle, layer)
        });
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
        let what = What {
            handle: Some(handle),
            ..What::of("contour")
        };
        let segments = entity.geometry.segments_of(subject.drawing.flat());
        if count > TOOLTIP_SEGMENTS {
            let closed = entity.geometry.is_closed();
            sheet.draw(frame, &what, segments, closed, || {
                format!("{kind} {handle} · {}", say!(segments, piece.count()))
            });
            continue;
        }
        for (index, segment) in segments.enumerate() {
            let what = What {
                segment: Some(index),
                ..what
            };
            sheet.draw(frame, &what, [segment], false, || {
                let shape = match segment {
                    Segment::Line(line) => say!(line_mm, subject.mm(line.length())),
                    Segment::Arc(arc) => {
                        let (radius, sweep) = (subject.mm(arc.radius), arc.sweep.to_degrees());
                        say!(arc_r_mm, radius, format!("{sweep:.1}"))
                    }
                };
                format!(
                    "{kind} {handle} · {} · {shape}",
                    say!(segment_by_number, index)
                )
            });
        }
    }
}

/// The way without a cut from where one path ends to where the next begins.
fn jump(sheet: &mut Sheet, frame: &Frame, subject: &Subject, from: Point, to: Point) {
    if from != to {
        let way = Segment::line(from, to);
        sheet.draw(frame, &What::of("jump"), [way], false, || {
            say!(way_without_a_cut_mm, subject.mm(way.length()))
        });
    }
}

/// The paths and the ways between them, in the order of travel.
fn wire(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let is_lead = |source: &Source| matches!(source, Source::LeadIn | Source::LeadOut);
    let mut before = None;
    let mut drawn: FxHashSet<Vec<Vec<i64>>> = FxHashSet::default();
    let has_passes = subject.paths.iter().any(|path| path.pass > 1);
    let parts = subject.parts.iter();
    let of_part = parts.flat_map(|part| {
        let paths = part.paths.iter().enumerate();
        paths.map(move |(index, path)| (path, part.title, index == 0))
    });
    let corrections = subject.corrections.iter().zip(&subject.half_kerfs);
    for ((path, part, is_first), (correction, half_kerf)) in of_part.zip(corrections) {
        if let Some(end) = before.replace(path.end()).filter(|_| !is_first) {
            jump(sheet, frame, subject, end, path.begin());
        }
        let label = || {
            let distance = subject.mm(*correction);
            let mut label = match subject.mills {
                false if path.side.is_some() => say!(contour_that_the_control_offsets, distance),
                false if path.on_line => say!(cut_on_the_line).into(),
                false => say!(path_of_the_wire_centre, distance),
                true => say!(path_of_the_electrode_axis, distance),
            };
            if has_passes {
                label += &say!(of_pass, path.pass);
            }
            match part {
                Some(part) => say!(of_a_part, part, label),
                None => label,
            }
        };
        // Runs of one kind: the way round the contour is one line, the leads are others.
        for run in path
            .segments
            .chunk_by(|a, b| is_lead(&a.source) == is_lead(&b.source))
        {
            let along = || run.iter().map(|segment| segment.geometry);
            let is_of_lead = run.first().is_some_and(|first| is_lead(&first.source));
            let class = match is_of_lead {
                true => {
                    let back = run.iter().rev().map(|segment| segment.geometry.reversed());
                    // Dashes upon dashes of the other way would look solid.
                    match drawn.contains(&frame.runs(back, false)) {
                        true => "lead back",
                        false => {
                            drawn.insert(frame.runs(along(), false));
                            "lead"
                        }
                    }
                }
                false if path.cut_off => "wire tab",
                false => "wire",
            };
            let width = half_kerf.map(|half| areas::kerf_width(frame, half));
            let what = What {
                pass: Some(path.pass),
                width: width.filter(|_| sheet.pieces.is_some()),
                ..What::of(class)
            };
            sheet.draw(frame, &what, along(), false, || match is_of_lead {
                true => say!(lead_in_and_lead_out).into(),
                false if path.cut_off => say!(the_tab).into(),
                false => label(),
            });
        }
    }
}

/// A finding without a picture of its own: a dot at a point, else a marked segment.
struct Other<'a> {
    finding: &'a Finding,
    spot: Spot,
    label: String,
    /// What is marked, where it is no point.
    marked: Option<Vec<Segment>>,
}

impl Other<'_> {
    fn draw(&self, sheet: &mut Sheet, frame: &Frame) {
        let (spot, severity) = (&self.spot, class_of(self.finding.severity));
        let shape = if self.marked.is_some() {
            "other"
        } else {
            "dot"
        };
        let class = format!("{shape} {severity}");
        let what = What {
            handle: Some(&spot.handle),
            segment: Some(spot.segment),
            ..What::of(&class)
        };
        match &self.marked {
            Some(segments) => {
                let segments = segments.iter().copied();
                sheet.draw(frame, &what, segments, false, || self.label.clone());
            }
            None => {
                let at = (spot.at.0 - frame.left, frame.bottom - spot.at.1);
                sheet.dot(&what, at, dot_of(self.finding.severity), &self.label);
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
    let marked = point.is_none().then(|| all.collect());
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
        marked,
    })
}
