//! Finds what comes near an outline where the boxes of all of them touch: outlines nested within
//! each other, or long slanting ones side by side.

use super::{Bounds, Point, Segment, Slant, Vector};
use std::ops::ControlFlow;

/// Where something lies: in a box but not in its core, in a rotated box, and between two circles about one point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shell {
    bounds: Bounds,
    /// A box that it does not reach into; empty where none is known.
    core: Bounds,
    slant: Slant,
    center: Point,
    inner: f64,
    outer: f64,
}

impl Shell {
    pub(crate) fn of(segments: impl Iterator<Item = Segment> + Clone) -> Shell {
        let mut bounds = Bounds::EMPTY;
        segments
            .clone()
            .for_each(|segment| bounds.merge(&segment.bounds()));
        let middle = bounds.min + (bounds.max - bounds.min) * 0.5;
        let arc = segments
            .clone()
            .find_map(|segment| segment.as_arc().copied());
        let center = arc.map_or(middle, |arc| arc.center);
        let mut shell = Shell {
            bounds,
            core: bounds,
            slant: Slant::ANYWHERE,
            center,
            inner: f64::INFINITY,
            outer: 0.0,
        };
        if !(center - Point::origin()).norm_squared().is_finite() {
            // Beyond all measure: it may be anywhere.
            return Shell {
                core: Bounds::EMPTY,
                center: Point::origin(),
                inner: 0.0,
                outer: f64::INFINITY,
                ..shell
            };
        }
        for segment in segments.clone() {
            let farthest = match &segment {
                Segment::Line(line) => (line.start - center).norm().max((line.end - center).norm()),
                Segment::Arc(arc) => (arc.center - center).norm() + arc.radius,
            };
            shell.outer = shell.outer.max(farthest);
            shell.inner = shell.inner.min(segment.distance_to(center));
            shell.core = clear_of(&shell.core, middle, &segment.bounds());
        }
        shell.slant = Slant::of(segments);
        shell
    }

    pub(crate) fn of_disc(center: Point, radius: f64) -> Shell {
        let bounds = Bounds::of_disc(center, radius);
        Shell {
            bounds,
            core: Bounds::EMPTY,
            slant: Slant::of_box(&bounds),
            center,
            inner: 0.0,
            outer: radius,
        }
    }

    pub(crate) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// False where another surely comes nowhere nearer than `reach`.
    pub(crate) fn may_meet(&self, other: &Shell, reach: f64) -> bool {
        Alike::one(self).may_meet(other, reach)
    }

    /// How far numbers are rounded here.
    fn rounding(&self) -> f64 {
        1e-9 * (self.center.coords.norm() + self.outer)
    }
}

/// The largest part of a box about a point that another box does not reach into; empty where that one holds the point.
fn clear_of(core: &Bounds, about: Point, other: &Bounds) -> Bounds {
    if !core.touches(other) {
        return *core;
    }
    let (min, max) = (core.min, core.max);
    let below = |max: Point| Bounds { min, max };
    let above = |min: Point| Bounds { min, max };
    let parts = [
        (other.min.x > about.x, below(Point::new(other.min.x, max.y))),
        (other.min.y > about.y, below(Point::new(max.x, other.min.y))),
        (other.max.x < about.x, above(Point::new(other.max.x, min.y))),
        (other.max.y < about.y, above(Point::new(min.x, other.max.y))),
    ];
    let area = |bounds: &Bounds| bounds.width() * bounds.height();
    let parts = parts.into_iter().filter(|(is_clear, _)| *is_clear);
    parts
        .map(|(_, part)| part)
        .max_by(|one, other| area(one).total_cmp(&area(other)))
        .unwrap_or(Bounds::EMPTY)
}

/// Shells by key, in a tree that groups shells of similar place and size. It cannot be changed.
#[derive(Debug)]
pub(crate) struct Shells<K> {
    shells: Vec<(K, Shell)>,
    nodes: Vec<Node>,
}

/// What is common to the shells of a range, and the first node after those of its parts.
#[derive(Debug)]
struct Node {
    first: u32,
    end: u32,
    behind: u32,
    is_leaf: bool,
    all: Alike,
}

/// What is common to some shells: the widest box and outer circle, the smallest core and inner
/// circle.
#[derive(Clone, Copy, Debug)]
struct Alike {
    bounds: Bounds,
    core: Bounds,
    slant: Slant,
    centers: Bounds,
    inner: f64,
    outer: f64,
}

/// The property by which shells are divided.
#[derive(Clone, Copy)]
enum Spread {
    Along,
    Across,
    Inside,
}

/// Shells that are looked at one by one.
const FEW: usize = 8;

impl<K: Copy> Shells<K> {
    pub(crate) fn new(shells: Vec<(K, Shell)>) -> Shells<K> {
        let mut all = Shells {
            shells,
            nodes: Vec::new(),
        };
        let count = all.shells.len();
        if count > 0 {
            all.divide(0, count);
        }
        all
    }

    fn divide(&mut self, first: usize, end: usize) {
        let shells = &mut self.shells[first..end];
        let all = Alike::of(shells);
        let (node, is_leaf) = (self.nodes.len(), shells.len() <= FEW);
        self.nodes.push(Node {
            first: first as u32,
            end: end as u32,
            behind: 0,
            is_leaf,
            all,
        });
        if !is_leaf {
            let spread = all.spread(shells);
            let by = |(_, shell): &(K, Shell)| match spread {
                Spread::Along => all.slant.within(shell.slant.middle.coords).x,
                Spread::Across => all.slant.within(shell.slant.middle.coords).y,
                Spread::Inside => shell.inner,
            };
            let middle = shells.len() / 2;
            shells.select_nth_unstable_by(middle, |one, other| by(one).total_cmp(&by(other)));
            self.divide(first, first + middle);
            self.divide(first + middle, end);
        }
        let behind = self.nodes.len() as u32;
        self.nodes[node].behind = behind;
    }

    /// Calls `found` for each shell that may come nearer to another than `reach`, once each. Returns how many were looked at.
    pub(crate) fn near(&self, to: &Shell, reach: f64, mut found: impl FnMut(K, &Bounds)) -> u64 {
        let mut work = 0;
        let _ = self.look(to, reach, &mut work, |key, bounds| {
            found(key, bounds);
            ControlFlow::Continue(())
        });
        work
    }

    /// True where a shell that may come nearer to another than `reach` is one for which `is_it`
    /// holds.
    pub(crate) fn any_near(&self, to: &Shell, reach: f64, is_it: impl Fn(K) -> bool) -> bool {
        let seek = |key: K, _: &Bounds| match is_it(key) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        self.look(to, reach, &mut 0, seek).is_break()
    }

    fn look(
        &self,
        to: &Shell,
        reach: f64,
        work: &mut u64,
        mut found: impl FnMut(K, &Bounds) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            *work += 1;
            let is_near = node.all.may_meet(to, reach);
            if is_near && node.is_leaf {
                let shells = &self.shells[node.first as usize..node.end as usize];
                *work += shells.len() as u64;
                for (key, shell) in shells {
                    if shell.may_meet(to, reach) {
                        found(*key, &shell.bounds)?;
                    }
                }
            }
            at = match is_near {
                true => at + 1,
                false => node.behind as usize,
            };
        }
        ControlFlow::Continue(())
    }
}

impl Alike {
    fn one(shell: &Shell) -> Alike {
        Alike {
            bounds: shell.bounds,
            core: shell.core,
            slant: shell.slant,
            centers: Bounds::of_points(&[shell.center]),
            inner: shell.inner,
            outer: shell.outer,
        }
    }

    /// What is common to some shells, at least one.
    fn of<K>(shells: &[(K, Shell)]) -> Alike {
        let mut all = Alike::one(&shells[0].1);
        for (_, shell) in &shells[1..] {
            all.bounds.merge(&shell.bounds);
            all.centers.include(shell.center);
            all.inner = all.inner.min(shell.inner);
            all.outer = all.outer.max(shell.outer);
            all.core.min = all.core.min.sup(&shell.core.min);
            all.core.max = all.core.max.inf(&shell.core.max);
        }
        all.slant = Slant::of_all(shells.iter().map(|(_, shell)| &shell.slant));
        all
    }

    /// The property in which these differ most: where their centres lie, beyond what the longest
    /// and the widest cover anyway, or how much they leave clear inside.
    fn spread<K>(&self, shells: &[(K, Shell)]) -> Spread {
        let (mut low, mut high) = (
            Vector::repeat(f64::INFINITY),
            Vector::repeat(f64::NEG_INFINITY),
        );
        let (mut largest, mut widest) = (Vector::zeros(), 0f64);
        for (_, shell) in shells {
            let middle = self.slant.within(shell.slant.middle.coords);
            (low, high) = (low.inf(&middle), high.sup(&middle));
            largest = largest.sup(&shell.slant.half);
            widest = widest.max(shell.inner);
        }
        let [along, across] = (high - low - largest * 2.0).into();
        let inside = widest - self.inner;
        if inside >= along && inside >= across {
            Spread::Inside
        } else if along >= across {
            Spread::Along
        } else {
            Spread::Across
        }
    }

    /// False where none of these comes nearer to a shell than `reach`.
    fn may_meet(&self, to: &Shell, reach: f64) -> bool {
        let reach = reach + to.rounding();
        let grown = to.bounds.grown(reach);
        if !grown.touches(&self.bounds)
            || self.core.holds(&grown)
            || to.core.holds(&self.bounds.grown(reach))
        {
            return false;
        }
        let centers = &self.centers;
        let beyond = centers.min.sup(&to.center.inf(&centers.max));
        let nearest = (beyond - to.center).norm();
        let away = |low: f64, high: f64, at: f64| (at - low).abs().max((high - at).abs());
        let farthest = Vector::new(
            away(centers.min.x, centers.max.x, to.center.x),
            away(centers.min.y, centers.max.y, to.center.y),
        )
        .norm();
        nearest <= self.outer + to.outer + reach
            && farthest + to.outer + reach >= self.inner
            && farthest + self.outer + reach >= to.inner
            && !to.slant.is_apart(&self.slant, reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn outline(x: f64, y: f64, size: f64, kind: usize) -> Vec<Segment> {
        let center = Point::new(x, y);
        let corner = |at: usize| {
            let (sine, cosine) = (at as f64 * std::f64::consts::FRAC_PI_2 + kind as f64).sin_cos();
            match kind {
                1 => center + Vector::new(sine.signum(), cosine.signum()) * size,
                _ => center + Vector::new(sine, cosine) * size,
            }
        };
        let bulge = if kind == 0 { -0.414_213_562 } else { 0.0 };
        (0..4)
            .map(|at| Segment::from_bulge(corner(at), corner(at + 1), bulge))
            .collect()
    }

    fn distance(one: &[Segment], other: &[Segment]) -> f64 {
        let points = |of: &Segment| {
            (0..=16)
                .map(|at| of.point_at(f64::from(at) / 16.0))
                .collect::<Vec<_>>()
        };
        let from = |one: &[Segment], other: &[Segment]| {
            let points = one.iter().flat_map(points);
            let nearest = |point| {
                other
                    .iter()
                    .map(|segment| segment.distance_to(point))
                    .fold(f64::INFINITY, f64::min)
            };
            points.map(nearest).fold(f64::INFINITY, f64::min)
        };
        from(one, other).min(from(other, one))
    }

    proptest! {
        #[test]
        fn whatever_comes_near_is_found(
            outlines in prop::collection::vec((-3..3i32, -3..3i32, 1..40i32, 0..3usize), 1..20),
            reach in 0.0..0.6f64,
        ) {
            let outlines: Vec<Vec<Segment>> = outlines
                .into_iter()
                .map(|(x, y, size, kind)| outline(f64::from(x) * 0.5, f64::from(y) * 0.5, f64::from(size) * 0.5, kind))
                .collect();
            let shell = |outline: &Vec<Segment>| Shell::of(outline.iter().copied());
            let shells = Shells::new(outlines.iter().map(shell).enumerate().collect());
            for one in &outlines {
                let mut found = vec![false; outlines.len()];
                shells.near(&shell(one), reach, |key, _| found[key] = true);
                for (other, is_found) in outlines.iter().zip(found) {
                    prop_assert!(is_found || distance(one, other) > reach);
                }
            }
        }
    }

    #[test]
    fn outlines_within_each_other_are_not_all_looked_at() {
        for kind in 0..3 {
            let outlines: Vec<Vec<Segment>> = (1..2000)
                .map(|size| outline(0.0, 0.0, f64::from(size), kind))
                .collect();
            let shell = |outline: &Vec<Segment>| Shell::of(outline.iter().copied());
            let shells = Shells::new(outlines.iter().map(shell).enumerate().collect());
            let mut near = 0;
            let work = shells.near(&shell(&outlines[1000]), 0.3, |_, _| near += 1);
            if kind < 2 {
                assert!(near == 1 && work < 200, "{kind}: {near} in {work}");
            }
        }
    }

    #[test]
    fn lines_side_by_side_are_not_all_looked_at() {
        let slanted = |at: f64| (Point::new(at, 0.0), Point::new(at + 1600.0, 1200.0));
        // Of one direction and many lengths, in no order.
        let chord = |at: f64| {
            let angle = at * 0.618_033_988_749_895 * std::f64::consts::TAU;
            let end = |angle: f64| Point::new(2000.0 * angle.cos(), 2000.0 * angle.sin());
            (end(angle), end(1.0 - angle))
        };
        // From one centre, each turned a little against the next.
        let ray = |at: f64| {
            let way = Vector::new((at * 0.003).cos(), (at * 0.003).sin());
            (Point::from(way * 500.0), Point::from(way * 2000.0))
        };
        for ends in [&slanted as &dyn Fn(f64) -> (Point, Point), &chord, &ray] {
            let shell = |at: usize| {
                let (start, end) = ends(at as f64);
                (at, Shell::of(std::iter::once(Segment::line(start, end))))
            };
            let all: Vec<(usize, Shell)> = (0..2000).map(shell).collect();
            let shells = Shells::new(all.clone());
            let (mut near, mut work) = (0, 0);
            for (_, shell) in &all {
                work += shells.near(shell, 0.3, |_, _| near += 1);
            }
            assert!(near < 3000 && work < 2000 * 200, "{near} in {work}");
        }
    }
}
