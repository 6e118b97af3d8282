//! Areas of the drawing: what is material, what the wire cuts, and what it leaves of what it should cut.

use super::numbers::number;
use super::reach::FARTHEST;
use super::sheet::{Frame, Sheet, path_data};
use super::subject::Subject;
use crate::drawing::{Drawing, Outline, Role, winding};
use crate::geometry::{Bounds, Grid, Point, Segment};
use crate::toolpath::{Source, WirePath};
use rustc_hash::{FxHashMap, FxHashSet};

/// How far the material reaches beyond an opening that no outline holds.
const GROUND: f64 = 22.0;

/// A closed outline.
struct Area {
    outline: usize,
    /// There is no material in it.
    is_void: bool,
}

/// The insides of closed outlines, the largest first, so that holes lie upon the part that holds them; each with
/// what the wire cuts along it, and what it leaves of the area that it should cut.
pub(super) fn areas(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    let areas = told_apart(subject.drawing, subject.outlines);
    if areas.first().is_some_and(|largest| largest.is_void) {
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
    for area in areas {
        let Some(outline) = subject.outlines.get(area.outline) else {
            continue;
        };
        let contour = &outline.contour;
        let segments = contour.segments(subject.drawing);
        let data = path_data(frame, segments.map(|segment| segment.geometry), true);
        let paths = of.remove(&area.outline).unwrap_or_default();
        let swept = round_of(frame, &paths);
        let fill = |sheet: &mut Sheet, class: &str, data: &str| {
            sheet.path(&format!(r#"class="{class}""#), data, "");
        };
        match (area.is_void, &swept) {
            (true, Some(round)) => {
                fill(sheet, "lost", &data);
                fill(sheet, "void", round);
            }
            (false, Some(round)) => fill(sheet, "lost", round),
            (true, None) => fill(sheet, "void", &data),
            (false, None) => fill(sheet, "part", &data),
        }
        kerfs(sheet, frame, &paths);
        if !area.is_void && swept.is_some() {
            fill(sheet, "part", &data);
        }
    }
    // Open contours have no inside.
    for index in 0..subject.outlines.len() {
        kerfs(sheet, frame, &of.remove(&index).unwrap_or_default());
    }
}

/// The outlines that have no material in them.
pub(super) fn voids(drawing: &Drawing, outlines: &[Outline]) -> FxHashSet<usize> {
    let areas = told_apart(drawing, outlines).into_iter();
    areas
        .filter(|area| area.is_void)
        .map(|area| area.outline)
        .collect()
}

/// The closed outlines, the largest first. An opening is void, whatever holds it; of the others one is void that lies in material, which
/// is a hole there, whether a side is known for it or not.
fn told_apart(drawing: &Drawing, outlines: &[Outline]) -> Vec<Area> {
    let closed = outlines.iter().enumerate();
    let closed = closed.filter(|(_, outline)| outline.contour.closed);
    let mut closed: Vec<(usize, &Outline, Bounds)> = closed
        .map(|(index, outline)| (index, outline, outline.contour.bounds(drawing)))
        .collect();
    closed.sort_by(|(_, a, _), (_, b, _)| b.twice_area.abs().total_cmp(&a.twice_area.abs()));
    let mut grid: Grid<usize> = Grid::default();
    let mut areas: Vec<Area> = Vec::with_capacity(closed.len());
    // What holds a contour is larger, and stands before it.
    for (place, (index, outline, bounds)) in closed.iter().enumerate() {
        let first = outline.contour.segment(drawing, 0);
        let point = first.map(|first| first.geometry.point_at(0.5));
        let mut holder: Option<usize> = None;
        if let Some(point) = point {
            grid.near(&Bounds::of_points(&[point]), |at, _| {
                let holds = closed.get(at).is_some_and(|(_, outer, its)| {
                    its.merged(bounds) == *its
                        && its != bounds
                        && winding(drawing, &outer.contour, point) != 0
                });
                if holds {
                    holder = holder.max(Some(at));
                }
            });
        }
        let holder = holder.and_then(|holder| areas.get(holder));
        areas.push(Area {
            outline: *index,
            is_void: outline.role == Role::Opening || holder.is_some_and(|holder| !holder.is_void),
        });
        grid.insert(place, *bounds);
    }
    areas
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
