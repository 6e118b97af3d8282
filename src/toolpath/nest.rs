//! What the proof of an earlier pass says of a later one.
//!
//! Nothing of the contour lies in the disc of the larger correction about a place of the earlier path. The disc of the smaller one about the
//! place on the same normal of the wall lies in it: there the later path keeps as clear, and only what reaches beyond is to be proved.

use super::corners::Element;
use super::path::Source;
use super::proof::Proof;
use crate::geometry::{Arc, Point, Segment, left_normal};

/// The path of an earlier pass, proved, beside the same walls on the same side, at no smaller correction.
#[derive(Clone, Copy)]
pub(super) struct Before<'a> {
    pub(crate) path: &'a [Element],
    pub(crate) correction: f64,
}

/// Which pieces of a path run beside what an earlier pass does.
pub(super) struct Nest<'a> {
    before: Before<'a>,
    at: usize,
}

impl<'a> Nest<'a> {
    pub(crate) fn new(before: Before<'a>) -> Nest<'a> {
        Nest { before, at: 0 }
    }

    /// What of a piece reaches beyond the piece of the earlier path beside the same wall. `None` where there is none, or that is not known.
    pub(crate) fn beyond(
        &mut self,
        proof: &Proof,
        element: &Element,
    ) -> Option<[Option<Segment>; 2]> {
        /// So many pieces of the earlier path are looked at.
        const AHEAD: usize = 6;
        let Before { path, correction } = self.before;
        let is_roll = |element: &Element| matches!(element.source, Source::Corner { .. });
        let is_same =
            |other: &Element| other.wall == element.wall && is_roll(other) == is_roll(element);
        let found = path.iter().skip(self.at).take(AHEAD).position(is_same)?;
        self.at += found;
        let by = correction - proof.correction;
        let slack = 1e-3 * proof.rounding;
        if by < 0.0 {
            return None;
        }
        let mut parts = [None; 2];
        match (element.geometry, path.get(self.at)?.geometry) {
            (Segment::Line(inner), Segment::Line(outer)) => {
                let own = proof.walls.get(element.wall)?.geometry;
                let along = own.start_tangent();
                let out = left_normal(along) * proof.side;
                let place = |point: Point, correction: f64| {
                    let from = point - own.start();
                    let is_on = (from.dot(&out) - correction).abs() <= slack;
                    is_on.then(|| from.dot(&along))
                };
                let (begin, end) = (
                    place(inner.start, proof.correction)?,
                    place(inner.end, proof.correction)?,
                );
                let (first, last) = (
                    place(outer.start, correction)?,
                    place(outer.end, correction)?,
                );
                if !matches!(own, Segment::Line(_)) || begin >= last || first >= end {
                    return None;
                }
                if begin < first - slack {
                    let there = inner.start + along * (first - begin);
                    parts[0] = Some(Segment::line(inner.start, there));
                }
                if end > last + slack {
                    let there = inner.end - along * (end - last);
                    parts[1] = Some(Segment::line(there, inner.end));
                }
            }
            (Segment::Arc(inner), Segment::Arc(outer)) => {
                let is_on = |arc: &Arc, point: Point| {
                    ((point - arc.center).norm() - arc.radius).abs() <= slack
                };
                let is_exact = |arc: &Arc| {
                    !arc.is_shallow()
                        && !arc.is_full_turn()
                        && arc.radius > proof.rounding
                        && is_on(arc, arc.start)
                        && is_on(arc, arc.end)
                };
                let is_beside = inner.center == outer.center
                    && inner.sweep * outer.sweep > 0.0
                    && ((inner.radius - outer.radius).abs() - by).abs() <= slack;
                if !is_beside || !is_exact(&inner) || !is_exact(&outer) {
                    return None;
                }
                let (sense, extent) = (inner.sweep.signum(), inner.sweep.abs());
                let ahead = (outer.start_angle - inner.start_angle) * sense;
                let behind = extent - ahead - outer.sweep.abs();
                if ahead >= extent || behind >= extent {
                    return None;
                }
                let least = slack / inner.radius;
                if ahead > least {
                    parts[0] = Some(Segment::Arc(Arc {
                        sweep: sense * ahead,
                        end: inner.point_at(ahead / extent),
                        ..inner
                    }));
                }
                if behind > least {
                    parts[1] = Some(Segment::Arc(Arc {
                        start_angle: inner.start_angle + inner.sweep - sense * behind,
                        sweep: sense * behind,
                        start: inner.point_at(1.0 - behind / extent),
                        ..inner
                    }));
                }
            }
            _ => return None,
        }
        Some(parts)
    }
}
