//! Tips in place of the ways round convex corners, and the proof of the path that has them.
//!
//! A path that rolls about every corner has been proved before. Where the pieces before and after a roll can run on to where they
//! meet, clear of everything, the roll goes. What comes of that is proved once more, and nothing is added to it: every piece keeps its
//! distance, and goes along all of the piece that it was. Where that does not hold, the path stays as it was.

use super::clearance::Walls;
use super::corners::{Element, meetings};
use super::job::{Job, ROUNDING};
use super::offset::Wall;
use crate::geometry::{Arc, Point, Segment, cross, turn};
use crate::settings::Corner;
use std::f64::consts::{FRAC_PI_2, TAU};

/// An extended corner reaches at most this many corrections from its vertex; beyond, the wire rolls about it.
const LONGEST_TIP: f64 = 4.0;

/// The sine of the angle within which a roll goes on from the piece before it.
const TANGENT: f64 = 1e-4;

/// Whether a piece of a path comes too near to some other contour.
pub(super) type MeetsOther<'a> = &'a dyn Fn(&Segment) -> bool;

impl Job<'_> {
    /// The path of a pass at a correction, drawing units, as it is written: with the corners that the settings want.
    pub(super) fn with_corners(
        &self,
        path: Vec<Element>,
        (walls, own): (&[Wall], &Walls),
        correction: f64,
        meets_other: MeetsOther,
    ) -> Vec<Element> {
        if self.settings.corner == Corner::Arc || path.len() < 3 {
            return path;
        }
        let rounding = self.units(ROUNDING);
        // One beside the first path is as exact as two paths are together.
        let least = correction.abs() - 2.0 * rounding;
        let is_clear =
            |piece: &Segment| own.too_near(piece, least).is_none() && !meets_other(piece);
        let tips = (0..path.len()).filter_map(|roll| tip_of(&path, roll, walls, rounding));
        let tips = tips.filter(|tip| tip.ways.iter().all(is_clear));
        let tips = apart(tips.collect(), rounding);
        let written = extended(&path, &tips);
        let holds = |(before, now): (&Element, &Option<Element>)| match now {
            Some(now) if now.geometry == before.geometry => true,
            Some(now) => is_clear(&now.geometry) && goes_along(now, before, rounding),
            // Its tip has been seen to be clear, and those beside it lead there.
            None => before.is_roll(),
        };
        match path.iter().zip(&written).all(holds) {
            true => written.into_iter().flatten().collect(),
            false => path,
        }
    }
}

/// What comes in the place of a roll.
struct Tip {
    /// The roll, by its place in the path.
    roll: usize,
    /// Onwards from the piece before the roll to the tip, and from there to the piece after it.
    ways: [Segment; 2],
}

/// The places of the pieces before and after one.
fn beside(path: &[Element], index: usize) -> [usize; 2] {
    let count = path.len();
    [(index + count - 1) % count, (index + 1) % count]
}

/// The tip where the pieces before and after a roll meet when both are extended. `None` for what is no whole roll between the offsets of
/// two neighbours, and where they do not meet, or too far out.
fn tip_of(path: &[Element], roll: usize, walls: &[Wall], touch: f64) -> Option<Tip> {
    let element = path.get(roll).filter(|element| element.is_roll())?;
    let arc = element.geometry.as_arc()?;
    let [before, after] = beside(path, roll).map(|index| &path[index]);
    let next = (element.wall + 1) % walls.len();
    let is_offset = |element: &Element, wall: usize| element.wall == wall && !element.is_roll();
    let leads_on = |one: &Segment, other: &Segment| {
        let (along, on) = (one.end_tangent(), other.start_tangent());
        (one.end() - other.start()).norm() <= touch
            && along.dot(&on) > 0.0
            && cross(along, on).abs() <= TANGENT
    };
    let is_whole = is_offset(before, element.wall)
        && is_offset(after, next)
        && leads_on(&before.geometry, &element.geometry)
        && leads_on(&element.geometry, &after.geometry);
    if !is_whole {
        return None;
    }
    let tips = meetings(&before.geometry, &after.geometry).into_iter();
    let tips = tips.filter(|tip| (tip - arc.center).norm() <= LONGEST_TIP * arc.radius);
    let ways = |at: Point| {
        let out = way_on(&before.geometry, at)?;
        let back = way_on(&after.geometry.reversed(), at)?.reversed();
        Some(Tip {
            roll,
            ways: [out, back],
        })
    };
    let length = |tip: &Tip| tip.ways[0].length() + tip.ways[1].length();
    let tips = tips.filter_map(ways);
    tips.min_by(|a, b| length(a).total_cmp(&length(b)))
}

/// The way from the end of a segment on, along what carries it, to a point of that: by at most a quarter of a turn.
fn way_on(segment: &Segment, to: Point) -> Option<Segment> {
    let start = segment.end();
    match segment {
        Segment::Line(line) => {
            let is_ahead = (to - start).dot(&(line.end - line.start)) > 0.0;
            is_ahead.then_some(Segment::line(start, to))
        }
        Segment::Arc(arc) => {
            let sweep = match arc.is_shallow() {
                true => (arc.share_of(to) - 1.0) * arc.sweep,
                false => turn(start - arc.center, to - arc.center),
            };
            let ahead = sweep * arc.sweep.signum();
            let is_ahead = ahead > 0.0 && ahead <= FRAC_PI_2;
            let on = Arc {
                start_angle: arc.start_angle + arc.sweep,
                sweep,
                start,
                end: to,
                ..*arc
            };
            is_ahead.then_some(Segment::Arc(on))
        }
    }
}

/// A segment with the way on from its end; `None` where it would come round to its start.
fn on_along(segment: &Segment, way: &Segment) -> Option<Segment> {
    match (segment, way) {
        (Segment::Arc(arc), Segment::Arc(way)) => {
            let (sweep, end) = (arc.sweep + way.sweep, way.end);
            (sweep.abs() < TAU).then_some(Segment::Arc(Arc { sweep, end, ..*arc }))
        }
        _ => Some(Segment::line(segment.start(), way.end())),
    }
}

/// The tips whose ways meet none of those of another: the wire would cut a crumb off the waste there.
fn apart(tips: Vec<Tip>, touch: f64) -> Vec<Tip> {
    let ways = Walls::by_one_core(tips.iter().flat_map(|tip| tip.ways).collect());
    let is_apart = |(index, tip): (usize, Tip)| {
        let is_other = |way: usize, _| way / 2 != index;
        let mut own = tip.ways.iter();
        let meets = own.any(|way| ways.find_near(way, touch, is_other).is_some());
        (!meets).then_some(tip)
    };
    tips.into_iter().enumerate().filter_map(is_apart).collect()
}

/// The path with its tips; nothing in the place of the rolls that are gone.
fn extended(path: &[Element], tips: &[Tip]) -> Vec<Option<Element>> {
    let mut extended: Vec<Option<Element>> = path.iter().copied().map(Some).collect();
    for Tip { roll, ways } in tips {
        let [before, after] = beside(path, *roll);
        let (Some(one), Some(other)) = (extended[before], extended[after]) else {
            continue;
        };
        let [out, back] = [ways[0], ways[1].reversed()];
        let one = on_along(&one.geometry, &out);
        let other = on_along(&other.geometry.reversed(), &back);
        let (Some(one), Some(other)) = (one, other) else {
            continue;
        };
        for (index, geometry) in [(before, one), (after, other.reversed())] {
            extended[index] = extended[index].map(|element| Element {
                geometry,
                ..element
            });
        }
        extended[*roll] = None;
    }
    extended
}

/// True where a piece goes along all of what it was.
fn goes_along(now: &Element, before: &Element, rounding: f64) -> bool {
    let (now, before) = (&now.geometry, &before.geometry);
    let is_on = |share: f64| now.distance_to(before.point_at(share)) <= rounding;
    now.length() >= before.length() - rounding && [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().all(is_on)
}
