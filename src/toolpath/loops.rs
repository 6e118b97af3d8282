//! Finds the path from all crossings of raw offsets, for contours on which cutting neighbour with neighbour is not
//! enough.
//!
//! Every raw element is cut where another one crosses it. The parts that keep clear of the walls stay, and are followed
//! from end to end in the order of the contour. The result is the edges of all regions in which the
//! wire's centre may be.

use super::clearance::Walls;
use super::cores::each;
use super::corners::{AT_A_TIME, Element, Raw, between, close_up};
use super::proof::Proof;
use crate::geometry::{Bounds, Grid, Point, Segment};
use rustc_hash::FxHashMap;

/// A stretch of a raw element that keeps clear of all walls, between two nodes.
#[derive(Clone, Copy, Debug)]
struct ClearStretch {
    raw: usize,
    from: usize,
    to: usize,
    is_alive: bool,
}

/// Closed ways of pieces, each with the index of its raw element.
pub(super) type Loops = Vec<Vec<(usize, Element)>>;

/// The result for the wire's centre.
pub(super) enum Found {
    /// All closed ways.
    Loops(Loops),
    /// None, but it can stand here.
    Point(Point),
    Nothing,
    /// Pieces do not lead on from each other at this raw element.
    Torn(usize),
    Cancelled,
}

/// Elements between two questions whether the path is still wanted.
const STEP: usize = 256;

pub(super) fn find(proof: &Proof, raw_elements: &Raw, goes_on: &dyn Fn() -> bool) -> Found {
    let mut nodes = Nodes {
        near: 0.2 * proof.rounding,
        points: Vec::new(),
        by_place: Grid::default(),
    };
    let mut stretches: Vec<ClearStretch> = Vec::new();
    let clear = |point: Point| {
        proof
            .own
            .nearer(point, proof.correction - proof.rounding)
            .is_none()
    };
    let mut stand = None;
    let all = Walls::new(each(raw_elements.len(), AT_A_TIME, |raw| {
        raw_elements.geometry(raw)
    }));
    for raw in 0..raw_elements.len() {
        if raw % STEP == 0 && !goes_on() {
            return Found::Cancelled;
        }
        let geometry = all.segment(raw);
        let cuts = proof.cuts_among(&all, raw);
        let mut last = nodes.at(geometry.start());
        let mut share = 0.0;
        for &cut in &cuts[1..] {
            let node = nodes.at(if cut == 1.0 {
                geometry.end()
            } else {
                geometry.point_at(cut)
            });
            // Both ends of a full turn are one node.
            let runs = node != last || (cut - share) * geometry.length() > 8.0 * proof.rounding;
            if runs {
                if clear(geometry.point_at((share + cut) / 2.0)) {
                    stretches.push(ClearStretch {
                        raw,
                        from: last,
                        to: node,
                        is_alive: true,
                    });
                }
                share = cut;
            }
            last = node;
        }
        if stand.is_none() && stretches.is_empty() {
            stand = cuts
                .iter()
                .map(|&cut| geometry.point_at(cut))
                .find(|&point| clear(point));
        }
    }
    let middle = |stretch: &ClearStretch| {
        let ends = [nodes.points[stretch.from], nodes.points[stretch.to]];
        between(all.segment(stretch.raw), ends[0], ends[1]).point_at(0.5)
    };
    once(&mut stretches, |a, b| {
        (middle(a) - middle(b)).norm() <= proof.rounding
    });
    prune(&mut stretches, nodes.points.len());
    match (followed(raw_elements, &stretches, &nodes), stand) {
        (Err(raw), _) => Found::Torn(raw),
        (Ok(loops), _) if !loops.is_empty() => Found::Loops(loops),
        (_, Some(point)) => Found::Point(point),
        _ => Found::Nothing,
    }
}

/// Leaves one of the stretches between two nodes that lie on each other, as two raw elements do where they nearly touch in a joint.
fn once(
    stretches: &mut Vec<ClearStretch>,
    on_each_other: impl Fn(&ClearStretch, &ClearStretch) -> bool,
) {
    let mut known: FxHashMap<(usize, usize), Vec<ClearStretch>> = FxHashMap::default();
    stretches.retain(|stretch| {
        let same = known.entry((stretch.from, stretch.to)).or_default();
        let is_new = !same.iter().any(|other| on_each_other(other, stretch));
        if is_new {
            same.push(*stretch);
        }
        is_new
    });
}

/// Removes stretches without a predecessor or successor, which are only clear by rounding.
fn prune(stretches: &mut [ClearStretch], nodes: usize) {
    let (mut coming, mut going) = (vec![0_u32; nodes], vec![0_u32; nodes]);
    let mut at: Vec<Vec<u32>> = vec![Vec::new(); nodes];
    for (index, stretch) in stretches.iter().enumerate() {
        coming[stretch.to] += 1;
        going[stretch.from] += 1;
        at[stretch.from].push(index as u32);
        at[stretch.to].push(index as u32);
    }
    let mut waiting: Vec<usize> = (0..nodes)
        .filter(|&node| (coming[node] == 0) != (going[node] == 0))
        .collect();
    while let Some(node) = waiting.pop() {
        if coming[node] > 0 && going[node] > 0 {
            continue;
        }
        for &index in &at[node] {
            let stretch = &mut stretches[index as usize];
            if std::mem::replace(&mut stretch.is_alive, false) {
                going[stretch.from] -= 1;
                coming[stretch.to] -= 1;
                waiting.extend(
                    [stretch.from, stretch.to]
                        .into_iter()
                        .filter(|&other| other != node),
                );
            }
        }
    }
}

/// Chains the stretches: each is followed by the next one in the order of the contour that begins where it ends, so
/// that ways that touch are one. Where it does not close, returns the raw element.
fn followed(raw_elements: &Raw, stretches: &[ClearStretch], nodes: &Nodes) -> Result<Loops, usize> {
    let alive: Vec<usize> = (0..stretches.len())
        .filter(|&index| stretches[index].is_alive)
        .collect();
    let mut beginning: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
    for &index in &alive {
        beginning
            .entry(stretches[index].from)
            .or_default()
            .push(index);
    }
    let mut is_done = vec![false; stretches.len()];
    let mut loops = Loops::new();
    for &first in &alive {
        if is_done[first] {
            continue;
        }
        let mut pieces: Vec<(usize, Element)> = Vec::new();
        let mut here = first;
        loop {
            if std::mem::replace(&mut is_done[here], true) {
                return Err(stretches[here].raw);
            }
            let ClearStretch { raw, from, to, .. } = stretches[here];
            append(
                raw_elements,
                &mut pieces,
                raw,
                nodes.points[from],
                nodes.points[to],
            );
            let Some(next) = beginning.get(&to).and_then(|list| {
                list.get(list.partition_point(|&other| other <= here))
                    .or(list.first())
            }) else {
                return Err(raw);
            };
            here = *next;
            if here == first {
                break;
            }
        }
        let head = pieces.first().map(|(_, element)| element.geometry.start());
        if let (Some(head), Some((_, last))) = (head, pieces.last_mut()) {
            close_up(last, head);
        }
        loops.push(pieces);
    }
    Ok(loops)
}

/// Adds a stretch of a raw element, to the last piece where that is the stretch before it.
fn append(
    raw_elements: &Raw,
    pieces: &mut Vec<(usize, Element)>,
    raw: usize,
    start: Point,
    end: Point,
) {
    let whole = raw_elements.geometry(raw);
    let start = match pieces.last() {
        Some((last, piece)) if *last == raw && piece.geometry.end() == start => {
            let begun = piece.geometry.start();
            pieces.pop();
            begun
        }
        _ => start,
    };
    let geometry = match whole {
        Segment::Arc(arc) if arc.is_full_turn() && start == end => whole,
        whole => between(&whole, start, end),
    };
    let key = raw_elements.key(raw);
    pieces.push((raw, raw_elements.offsets.element(key, geometry)));
}

/// Points that are only distinct when they are further from each other than rounding.
struct Nodes {
    near: f64,
    points: Vec<Point>,
    by_place: Grid<usize>,
}

impl Nodes {
    fn at(&mut self, point: Point) -> usize {
        let mut known: Option<usize> = None;
        (self.by_place).near(&Bounds::of_disc(point, self.near), |node, _| {
            if (self.points[node] - point).norm() <= self.near {
                known = Some(known.map_or(node, |known| known.min(node)));
            }
        });
        known.unwrap_or_else(|| {
            let node = self.points.len();
            self.points.push(point);
            self.by_place.insert(node, Bounds::of_points(&[point]));
            node
        })
    }
}
