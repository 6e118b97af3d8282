//! The part's contour for 4B: every corner a tangent arc that stays an arc when the controller adds its correction.
//!
//! The controller changes the radius of each arc by its correction and runs lines as they are written. The wire's path
//! therefore only joins where the contour turns in arcs alone, each of which is larger than the correction where the
//! wire runs inside of it. The ways in and out are lines: they lead to the start of the wire's path, beside the
//! contour.

use super::decode::decode;
use super::encode::encode;
use crate::finding::{Detail, Finding, Place, Rule, Severity, Side, Unwritable};
use crate::geometry::{Arc, Locus, Point, Segment, Vector, left_normal, turn};
use crate::program::grid::{point_of, snap};
use crate::program::path::is_tight_in_four_b;
use crate::program::write::{ProofError, Proved, scaled, too_far_out};
use crate::toolpath::{PathSegment, Source, WirePath, each};
use std::f64::consts::PI;

/// An arc that leaves a side at less than this is tangent to it, radians.
const TANGENT: f64 = 1e-3;

/// A corner where the wire's path has a smaller step needs no transition, µm: on the grid its arc would be a micrometre
/// or two long, and run anywhere.
const LEAST_STEP: f64 = 0.5;

/// The largest step of the wire's path where an arc, rounded to the grid, leaves a side, µm.
const LARGEST_STEP: f64 = 2.0;

/// The step of the wire's path, µm, at a joint that turns by `turn` radians: the controller moves
/// the pieces before and after it by the correction, each across its own direction.
pub(super) fn wire_step(turn: f64, correction: f64) -> f64 {
    2.0 * correction * (turn / 2.0).sin().abs()
}

/// How far the corners of a part lie from the transitions in their place, at most, µm, and where: those that the wire runs
/// inside of, and each of those that it goes round, before its segment.
#[derive(Clone, Debug, Default)]
pub(super) struct CutCorners {
    pub(super) inside: Option<(f64, Point)>,
    pub(super) outside: Vec<(f64, Source)>,
}

impl CutCorners {
    fn take(&mut self, corner: Point, source: Source, arc: &Arc, side: Side) {
        let away = (corner - arc.center).norm() - arc.radius;
        match is_concave(arc, side) {
            true if self.inside.is_none_or(|(worst, _)| away > worst) => {
                self.inside = Some((away, corner));
            }
            true => {}
            false => self.outside.push((away, source)),
        }
    }
}

/// The path of a part's contour, followed by that of its tab, rounded as one.
pub(super) fn rounded_with_tab(
    path: &WirePath,
    tab: Option<&WirePath>,
    scale: f64,
    correction: f64,
    radius: f64,
    corners: &mut CutCorners,
) -> Proved<Vec<WirePath>> {
    let Some(tab) = tab else {
        return Ok(vec![rounded(path, scale, correction, radius, corners)?]);
    };
    let mut whole = path.clone();
    whole.segments.extend_from_slice(&tab.segments);
    let made = rounded(&whole, scale, correction, radius, corners)?;
    let is_of_contour =
        |piece: &&PathSegment| !matches!(piece.source, Source::LeadIn | Source::LeadOut);
    let first = |path: &WirePath| {
        let first = path.segments.iter().find(is_of_contour);
        first.map_or_else(Point::origin, |piece| piece.geometry.start())
    };
    let begin = tab.begin() * scale + (first(&made) - first(path) * scale);
    // The last piece that is there; in a rounded corner, the nearest.
    let away = |index: &usize| made.segments[*index].geometry.distance_to(begin);
    let index = (0..made.segments.len())
        .rev()
        .filter(|&index| is_of_contour(&&made.segments[index]))
        .min_by(|a, b| away(a).total_cmp(&away(b)))
        .unwrap_or(0);
    let (mut before, mut behind) = (made.clone(), made);
    behind.segments.drain(..index);
    before.segments.truncate(index + 1);
    let piece = before.segments[index].geometry;
    let (share, length) = (piece.share_of(begin).clamp(0.0, 1.0), piece.length());
    if share * length <= LEAST_LEFT {
        before.segments.pop();
    } else if (1.0 - share) * length <= LEAST_LEFT {
        behind.segments.remove(0);
    } else {
        before.segments[index].geometry = piece.part(0.0, share);
        behind.segments[0].geometry = piece.part(share, 1.0);
    }
    behind.cut_off = true;
    Ok(vec![before, behind])
}

/// The path of a part's contour in µm: rounded at its corners with `radius`, moved beside the contour by the correction, µm both.
fn rounded(
    path: &WirePath,
    scale: f64,
    correction: f64,
    radius: f64,
    corners: &mut CutCorners,
) -> Proved<WirePath> {
    let refused = |sentence: String| Err(ProofError::Refused(sentence));
    let Some(side) = path.side else {
        return refused(say!(n4b_needs_the_side_of_the_contour).into());
    };
    let is_lead = |piece: &PathSegment| matches!(piece.source, Source::LeadIn | Source::LeadOut);
    let mut contour: Vec<PathSegment> = path
        .segments
        .iter()
        .filter(|piece| !is_lead(piece))
        .copied()
        .collect();
    contour
        .iter_mut()
        .for_each(|piece| piece.geometry = scaled(&piece.geometry, scale));
    let (Some(first), Some(last)) = (contour.first().copied(), contour.last().copied()) else {
        return refused(say!(there_is_no_contour_to_cut).into());
    };
    for piece in &contour {
        if let Segment::Arc(arc) = piece.geometry
            && is_concave(&arc, side)
            && is_tight_in_four_b(arc.radius, correction)
        {
            let fault = Unwritable::TightArc {
                at: mm(arc.start),
                radius: arc.radius / 1e3,
                correction: correction / 1e3,
            };
            return Err(unwritable(piece.source, fault));
        }
    }
    let entry = first.geometry.start();
    let closed = !path.is_open();
    let turned = turn(last.geometry.end_tangent(), first.geometry.start_tangent());
    if closed && wire_step(turned, correction) > LEAST_STEP {
        return Err(unwritable(
            first.source,
            Unwritable::BeginsInCorner { at: mm(entry) },
        ));
    }
    let made_at = &mut |corner, source, arc: &Arc| corners.take(corner, source, arc, side);
    let contour = with_transitions(&contour, radius, correction, made_at)?;
    // The lines and arcs are those of the part, begun where the wire is.
    let beside = left_normal(first.geometry.start_tangent()) * (side.sign() * correction);
    let (Some(from), Some(to)) = (snap(entry), snap(entry + beside)) else {
        return Err(too_far_out(entry));
    };
    let by = point_of(to) - point_of(from);
    let thread = path.thread_hole * scale;
    let begin = entry + by;
    let mut segments = Vec::with_capacity(contour.len() + 2);
    let [way_in, mut way_out] = leads(path, scale, begin, correction);
    if !closed {
        way_out.clear();
    }
    segments.extend(way_in.into_iter().map(|geometry| PathSegment {
        geometry,
        source: Source::LeadIn,
    }));
    segments.extend(contour.iter().map(|piece| PathSegment {
        geometry: piece.geometry.moved(by),
        ..*piece
    }));
    segments.extend(way_out.into_iter().rev().map(|geometry| PathSegment {
        geometry: geometry.reversed(),
        source: Source::LeadOut,
    }));
    Ok(WirePath {
        segments,
        thread_hole: thread,
        correction: 0.0,
        ..path.clone()
    })
}

/// The way in and the way out, both towards the beginning of the contour.
fn leads(path: &WirePath, scale: f64, begin: Point, correction: f64) -> [Vec<Segment>; 2] {
    let thread = path.thread_hole * scale;
    let arc_of = |source: Source| {
        let own = path.segments.iter().filter(|piece| piece.source == source);
        let mut arcs = own.filter_map(|piece| scaled(&piece.geometry, scale).as_arc().copied());
        arcs.next()
    };
    let way_out = arc_of(Source::LeadOut).map(|arc| arc.reversed());
    [arc_of(Source::LeadIn), way_out].map(|arc| match arc {
        _ if (thread - begin).norm() <= 1.0 => Vec::new(),
        Some(arc) => along_wire(thread, &arc, begin, correction),
        None => vec![Segment::line(thread, begin)],
    })
}

/// A lead along an arc as the wire runs: the controller does not change it, since its blocks have no radius. `arc` is
/// that of the part, larger by the correction.
fn along_wire(thread: Point, arc: &Arc, begin: Point, correction: f64) -> Vec<Segment> {
    let share = (arc.radius - correction) / arc.radius;
    let by = begin - (arc.center + (arc.end - arc.center) * share);
    let center = arc.center + by;
    let touch = center + (arc.start - arc.center) * share;
    let wire = Arc {
        radius: arc.radius * share,
        ..Arc::about(center, touch, begin, arc.sweep > 0.0)
    };
    vec![Segment::line(thread, touch), Segment::Arc(wire)]
}

/// Reports at the contour's own piece what 4B cannot hold.
pub(super) fn unwritable(source: Source, fault: Unwritable) -> ProofError {
    ProofError::Unwritable(Box::new(Finding {
        rule: Rule::UnprovedPath,
        severity: Severity::Error,
        place: source.place().unwrap_or(Place::Document),
        detail: Detail::Unwritable(fault),
        related: Vec::new(),
    }))
}

/// A point of the path, µm, in mm.
pub(super) fn mm(point: Point) -> [f64; 2] {
    [point.x / 1e3, point.y / 1e3]
}

/// The wire runs inside of an arc when the centre lies on its side.
pub(super) fn is_concave(arc: &Arc, side: Side) -> bool {
    (arc.sweep > 0.0) == (side == Side::Left)
}

/// The least length of a piece between its transitions, µm.
const LEAST_LEFT: f64 = 1.0;

/// Transitions that one core checks against the grid at a time.
const AT_A_TIME: usize = 64;

/// How much larger a transition may become so that it exceeds the correction on the grid, too, µm.
const LARGER: i32 = 3;

/// Beyond that it grows by this factor until it is so long that it keeps its direction on the grid, µm: a corner that
/// turns by little is cut off by hundredths of a micrometre.
const FACTOR: f64 = 1.25;
const LONG: f64 = 60.0;

/// The radii of a corner's transition, the smallest first, µm. They end at [`LONG`]: one that is 0 grows all the same, and where there is no
/// turn there are no larger ones.
fn sizes(radius: f64, angle: f64) -> impl Iterator<Item = f64> {
    let larger = (0..=LARGER).map(move |more| radius + f64::from(more));
    let first = (angle != 0.0).then_some(radius.max(1.0));
    let grown = std::iter::successors(first, |radius| Some((radius * FACTOR).ceil()));
    let grown = grown.skip_while(move |own| *own <= radius + f64::from(LARGER));
    larger.chain(grown.take_while(move |own| own * angle.abs() <= LONG))
}

/// Transition arcs of `radius`, or just as much more as makes them sound on the grid, at the corners between lines and
/// arcs alike. Each corner is made from the two pieces as they are drawn; `made_at` gets it with what the piece behind it follows, and its arc.
fn with_transitions(
    contour: &[PathSegment],
    radius: f64,
    correction: f64,
    made_at: &mut dyn FnMut(Point, Source, &Arc),
) -> Proved<Vec<PathSegment>> {
    let corners = each(contour.len().saturating_sub(1), AT_A_TIME, |nth| {
        let [before, behind] = [nth, nth + 1].map(|nth| &contour[nth].geometry);
        let angle = turn(before.end_tangent(), behind.start_tangent());
        let sizes = sizes(radius, angle);
        let mut fitting = sizes.filter_map(|radius| transition(before, behind, angle, radius));
        let is_sound = |made: &Transition| is_sound(&made.arc, correction);
        (wire_step(angle, correction) > LEAST_STEP).then(|| (angle, fitting.find(is_sound)))
    });
    let mut rounded: Vec<PathSegment> = Vec::with_capacity(contour.len() * 2);
    let mut from = 0.0;
    for (nth, piece) in contour.iter().enumerate() {
        let until = |share: f64| PathSegment {
            geometry: piece.geometry.part(from, share),
            ..*piece
        };
        let Some((turn, made)) = corners.get(nth).copied().flatten() else {
            rounded.push(until(1.0));
            from = 0.0;
            continue;
        };
        let behind = &contour[nth + 1];
        let is_left =
            |made: &Transition| piece.geometry.length() * (made.leaves - from) >= LEAST_LEFT;
        let Some(Transition { leaves, arc, meets }) = made.filter(is_left) else {
            let fault = Unwritable::NoTransition {
                at: mm(behind.geometry.start()),
                radius: radius / 1e3,
                turn,
            };
            return Err(unwritable(behind.source, fault));
        };
        made_at(behind.geometry.start(), behind.source, &arc);
        rounded.push(until(leaves));
        rounded.push(PathSegment {
            geometry: Segment::Arc(arc),
            ..*behind
        });
        from = meets;
    }
    Ok(rounded)
}

/// Whether a controller can move the blocks that an arc becomes: on the grid they are arcs, too, each larger than the
/// correction, and the wire's path has hardly a step where they leave the sides and each other.
fn is_sound(arc: &Arc, correction: f64) -> bool {
    let (Some(from), Some(to)) = (snap(arc.start), snap(arc.end)) else {
        return false;
    };
    let mut blocks = Vec::new();
    if encode(&Segment::Arc(*arc), from, to, i64::MAX, &mut blocks).is_none() {
        return false;
    }
    let joins = |one: Vector, next: Vector| wire_step(turn(one, next), correction) <= LARGEST_STEP;
    let mut along = arc.tangent_at(0.0);
    for block in &blocks {
        let Ok(Segment::Arc(own)) = decode(&block.block, point_of(block.from)) else {
            return false;
        };
        if is_tight_in_four_b(own.radius.round(), correction) || !joins(along, own.tangent_at(0.0))
        {
            return false;
        }
        along = own.tangent_at(1.0);
    }
    !blocks.is_empty() && joins(along, arc.tangent_at(1.0))
}

/// The arc at a corner.
#[derive(Clone, Copy)]
struct Transition {
    /// The share of the piece before at which it begins.
    leaves: f64,
    arc: Arc,
    /// The share of the piece after it at which it ends.
    meets: f64,
}

/// The arc of `radius` tangent to both sides of a corner that turns by `angle`.
///
/// Its centre lies `radius` beside both of them, on the side to which the corner turns. `None` where it meets one of
/// them outside of it, or turns by more than a half.
fn transition(before: &Segment, behind: &Segment, angle: f64, radius: f64) -> Option<Transition> {
    let side = angle.signum();
    let corner = behind.start();
    let centers =
        Locus::beside(before, side, radius, 0.0)?.meet(&Locus::beside(behind, side, radius, 0.0)?);
    let fitting = centers.into_iter().filter_map(|center| {
        let (leaves, meets) = (before.share_of(center), behind.share_of(center));
        let left = [before.length() * leaves, behind.length() * (1.0 - meets)];
        if leaves >= 1.0 || meets <= 0.0 || left.iter().any(|left| *left < LEAST_LEFT) {
            return None;
        }
        let (start, end) = (before.point_at(leaves), behind.point_at(meets));
        let arc = Arc {
            radius,
            ..Arc::about(center, start, end, side > 0.0)
        };
        let is_tangent = (before.tangent_at(leaves) - arc.tangent_at(0.0)).norm() <= TANGENT;
        (is_tangent && arc.sweep.abs() < PI - TANGENT).then_some(Transition { leaves, arc, meets })
    });
    fitting.min_by(|a, b| {
        (a.arc.center - corner)
            .norm()
            .total_cmp(&(b.arc.center - corner).norm())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radii_of_a_transition_end_whatever_the_first_and_the_turn() {
        for radius in [0.0, 0.3, 1.0, 3.0, 100.0] {
            for angle in [0.0, 1e-3, -0.5, 3.0] {
                let sizes: Vec<f64> = sizes(radius, angle).take(1_000).collect();
                assert!(sizes.len() < 1_000, "{radius} {angle}");
                assert!(sizes.is_sorted(), "{sizes:?}");
            }
        }
        assert_eq!(
            sizes(0.0, 10.0).collect::<Vec<_>>(),
            [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
        );
    }
}
