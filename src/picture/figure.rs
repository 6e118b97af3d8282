//! The drawing itself: areas, contours, entities that are not cut, the wire's path and the faults on it.

use super::marks;
use super::numbers::number;
use super::reach::FARTHEST;
use super::sheet::{Frame, Sheet, escaped, named, path_data};
use super::style::class_of;
use super::subject::{Subject, is_other};
use crate::drawing::{Entity, EntityId, Geometry, Role};
use crate::finding::{Detail, Finding, Place};
use crate::geometry::{Point, Segment};
use crate::toolpath::{Source, WirePath, lengths};
use rustc_hash::{FxHashMap, FxHashSet};

/// How far the material reaches beyond an opening that no outline holds.
const GROUND: f64 = 22.0;
/// Radius of the dot at a fault.
const DOT: f64 = 4.5;
/// Up to this many segments each one is an element of its own, with a tooltip; beyond it each entity is.
const TOOLTIP_SEGMENTS: usize = 4000;

pub(super) fn figure(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
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
    areas(sheet, frame, subject);
    asides(sheet, frame, subject);
    contours(sheet, frame, subject);
    wire(sheet, frame, subject);
    other_faults(sheet, frame, subject);
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
    marks::thread_holes(sheet, frame, subject);
    sheet.line(format_args!("</g>"));
}

/// The segments of an entity as path data.
fn data_of(frame: &Frame, subject: &Subject, entity: &Entity) -> String {
    let geometry = &entity.geometry;
    let segments = geometry.segments_of(subject.drawing.flat());
    path_data(frame, segments, geometry.is_closed())
}

/// The insides of closed contours, the largest first, so that openings lie upon the part that holds them; each with
/// what the wire cuts along it, and what it leaves of the area that it should cut.
fn areas(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let drawing = subject.drawing;
    // By size: whether it is an opening, its contour, and its place among the outlines.
    let mut areas: Vec<(f64, bool, String, Option<usize>)> = Vec::new();
    for (id, entity) in drawing.entities() {
        if entity.geometry.is_closed() && !subject.cut.contains(&id) {
            let bounds = entity.geometry.bounds(drawing.flat());
            let size = bounds.width() * bounds.height() * 2.0;
            areas.push((size, false, data_of(frame, subject, entity), None));
        }
    }
    for (index, outline) in subject.outlines.iter().enumerate() {
        if outline.contour.closed {
            let is_opening = outline.role == Role::Opening;
            let segments = outline.contour.segments(drawing);
            let data = path_data(frame, segments.map(|segment| segment.geometry), true);
            areas.push((outline.twice_area.abs(), is_opening, data, Some(index)));
        }
    }
    areas.sort_by(|a, b| b.0.total_cmp(&a.0));
    if areas.first().is_some_and(|(_, is_opening, ..)| *is_opening) {
        let [width, height] = [subject.bounds.width(), subject.bounds.height()]
            .map(|length| number(length * frame.scale + 2.0 * GROUND));
        sheet.line(format_args!(
            r#"<rect class="part" x="-{GROUND}" y="-{GROUND}" width="{width}" height="{height}" rx="8"/>"#
        ));
    }
    let mut of: FxHashMap<usize, Vec<(&WirePath, f64)>> = FxHashMap::default();
    for (path, half) in subject.paths.iter().zip(&subject.half_kerfs) {
        if let Some(half) = half {
            of.entry(path.outline).or_default().push((path, *half));
        }
    }
    for (_, is_opening, data, outline) in areas {
        let paths = outline.and_then(|outline| of.remove(&outline));
        let paths = &paths.unwrap_or_default()[..];
        let swept = round_of(frame, paths);
        let fill = |sheet: &mut Sheet, class: &str, data: &str| {
            sheet.path(&format!(r#"class="{class}""#), data, "");
        };
        match (is_opening, &swept) {
            (true, Some(round)) => {
                fill(sheet, "lost", &data);
                fill(sheet, "void", round);
            }
            (false, Some(round)) => fill(sheet, "lost", round),
            (true, None) => fill(sheet, "void", &data),
            (false, None) => fill(sheet, "part", &data),
        }
        kerfs(sheet, frame, paths);
        if !is_opening && swept.is_some() {
            fill(sheet, "part", &data);
        }
    }
    // Open contours have no inside.
    for index in 0..subject.outlines.len() {
        kerfs(sheet, frame, &of.remove(&index).unwrap_or_default());
    }
}

/// The loop of the first pass around an outline, where the kerf of the wire is known: everything
/// between that and the contour that no kerf covers is left standing.
fn round_of(frame: &Frame, paths: &[(&WirePath, f64)]) -> Option<String> {
    let own = |cut_off: bool| {
        let is_it = |path: &WirePath| path.pass == 1 && path.cut_off == cut_off;
        let (path, _) = paths.iter().find(|(path, _)| is_it(path))?;
        let is_lead = |source: &Source| matches!(source, Source::LeadIn | Source::LeadOut);
        let pieces = path.segments.iter();
        let pieces = pieces.filter(|piece| !is_lead(&piece.source));
        Some(pieces.map(|piece| piece.geometry).collect::<Vec<_>>())
    };
    let mut round = own(false)?;
    let end = round.last()?.end();
    // The tab closes the loop, whichever way the tab is cut.
    let tab = own(true).unwrap_or_default();
    let is_end = |at: Option<Point>| at.is_some_and(|at| (at - end).norm() * frame.scale < 1.0);
    if is_end(tab.first().map(Segment::start)) {
        round.extend(tab);
    } else if is_end(tab.last().map(Segment::end)) {
        round.extend(tab.iter().rev().map(Segment::reversed));
    }
    Some(path_data(frame, round, true))
}

/// The kerf along an outline in all its passes, leads and tab included, to scale.
fn kerfs(sheet: &mut Sheet, frame: &Frame, paths: &[(&WirePath, f64)]) {
    for (path, half) in paths {
        let pieces = path.segments.iter().map(|piece| piece.geometry);
        let (data, width) = (path_data(frame, pieces, false), 2.0 * half * frame.scale);
        if !data.is_empty() {
            let width = number(width.min(FARTHEST));
            sheet.path(
                &format!(r#"class="kerf" stroke-width="{width}""#),
                &data,
                "",
            );
        }
    }
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

/// Errors and warnings without a picture of their own: a dot at a point, else a marked segment.
fn other_faults(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let pieces = subject
        .outlines
        .iter()
        .map(|outline| &outline.contour.pieces);
    let reversed: FxHashSet<EntityId> = pieces
        .flatten()
        .filter(|piece| piece.reversed)
        .map(|piece| piece.entity)
        .collect();
    for finding in subject.findings.iter().filter(|finding| is_other(finding)) {
        if let Place::Segment { entity, segment } = finding.place
            && let Some(found) = subject.drawing.get(entity)
        {
            let place = (found, segment, reversed.contains(&entity));
            other_fault(sheet, frame, subject, finding, place);
        }
    }
}

fn other_fault(
    sheet: &mut Sheet,
    frame: &Frame,
    subject: &Subject,
    finding: &Finding,
    (entity, segment, is_reversed): (&Entity, usize, bool),
) {
    let flat = subject.drawing.flat();
    let Some(geometry) = entity.geometry.segment_of(segment, flat) else {
        return;
    };
    let point = match finding.detail {
        Detail::SelfIntersection { at, .. }
        | Detail::LostPocket { near: at }
        | Detail::UnprovedPath { near: at }
        | Detail::DeadEnd { near: at, .. } => Some(at),
        // Shown at the start of the segment in the direction of travel.
        Detail::SharpCorner { .. } | Detail::NearTangent { .. } | Detail::Gap { .. } => {
            Some(match is_reversed {
                true => geometry.end(),
                false => geometry.start(),
            })
        }
        // Too short to be visible.
        _ if geometry.length() * frame.scale < DOT => Some(geometry.point_at(0.5)),
        _ => None,
    };
    let (handle, rule) = (&entity.handle, finding.rule.name());
    let label = format!("{handle} · {} · {rule}", say!(segment_by_number, segment));
    let severity = class_of(finding.severity);
    if let Some(point) = point {
        let attributes = named(&format!("dot {severity}"), handle, segment);
        sheet.circle(&attributes, frame.local(point), DOT, &label);
        return;
    }
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
    let data = path_data(frame, all, false);
    let class = format!("other {severity}");
    sheet.path(&named(&class, handle, segment), &data, &label);
}
