//! Areas of the drawing: what is material, what the wire cuts, and what it leaves of what it should cut.

use super::numbers::{number, thousandths};
use super::pieces::What;
use super::reach::FARTHEST;
use super::sheet::{Frame, Sheet};
use super::subject::Subject;
use crate::drawing::{Drawing, Outline, Role, winding};
use crate::geometry::{Bounds, Grid, Point, Segment};
use crate::toolpath::{Source, WirePath};
use rustc_hash::{FxHashMap, FxHashSet};

/// How far the material reaches beyond an opening that no outline holds.
const GROUND: f64 = 22.0;
/// The radius of its corners.
const ROUND: f64 = 8.0;

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
            .map(|length| length * frame.scale + 2.0 * GROUND);
        ground(sheet, width, height);
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
        let own: Vec<Segment> = contour
            .segments(subject.drawing)
            .map(|segment| segment.geometry)
            .collect();
        let paths = of.remove(&area.outline).unwrap_or_default();
        let swept = round_of(frame, &paths);
        let fill = |sheet: &mut Sheet, class: &str, segments: &[Segment]| {
            let segments = segments.iter().copied();
            sheet.draw(frame, &What::of(class), segments, true, String::new);
        };
        match (area.is_void, &swept) {
            (true, Some(round)) => {
                fill(sheet, "lost", &own);
                fill(sheet, "void", round);
            }
            (false, Some(round)) => fill(sheet, "lost", round),
            (true, None) => fill(sheet, "void", &own),
            (false, None) => fill(sheet, "part", &own),
        }
        kerfs(sheet, frame, &paths);
        if !area.is_void && swept.is_some() {
            fill(sheet, "part", &own);
        }
    }
    // Open contours have no inside.
    for index in 0..subject.outlines.len() {
        kerfs(sheet, frame, &of.remove(&index).unwrap_or_default());
    }
}

/// Material as a box with rounded corners.
fn ground(sheet: &mut Sheet, width: f64, height: f64) {
    let Some(pieces) = &mut sheet.pieces else {
        let [width, height] = [width, height].map(number);
        return sheet.line(format_args!(
            r#"<rect class="part" x="-{GROUND}" y="-{GROUND}" width="{width}" height="{height}" rx="{ROUND}"/>"#
        ));
    };
    let [low, right, top] = [-GROUND, width - GROUND, height - GROUND].map(thousandths);
    let round = thousandths(ROUND);
    let sides = [
        [low + round, low],
        [right - round, low],
        [right, low + round],
        [right, top - round],
        [right - round, top],
        [low + round, top],
        [low, top - round],
        [low, low + round],
        [low + round, low],
    ];
    let mut at = sides[0].to_vec();
    for (index, [x, y]) in sides.into_iter().enumerate().skip(1) {
        at.extend([x, y, if index % 2 == 0 { round } else { 0 }]);
    }
    pieces.push(What::of("part").piece(at));
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
    let closed = closed.filter(|(_, outline)| outline.contour.closed && !outline.is_on_line());
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
fn round_of(frame: &Frame, paths: &[(&WirePath, f64)]) -> Option<Vec<Segment>> {
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
    Some(round)
}

/// The width of a kerf on the sheet.
pub(super) fn kerf_width(frame: &Frame, half: f64) -> f64 {
    (2.0 * half * frame.scale).min(FARTHEST)
}

/// The kerf along an outline in all its passes, leads and tab included, to scale; pieces of the path have it themselves.
fn kerfs(sheet: &mut Sheet, frame: &Frame, paths: &[(&WirePath, f64)]) {
    if sheet.pieces.is_some() {
        return;
    }
    for (path, half) in paths {
        let what = What {
            width: Some(kerf_width(frame, *half)),
            ..What::of("kerf")
        };
        let pieces = path.segments.iter().map(|piece| piece.geometry);
        sheet.draw(frame, &what, pieces, false, String::new);
    }
}
