//! Each block is planned from where the machine stands.
//!
//! A block does not name its end: the control counts J from where it stands, so what one block misses, all behind it
//! miss too. There are two readings of a program, and both are followed: a control steps by whole micrometres
//! ([`travel`]), a reader runs exact arcs ([`decode`]). The block between the two nodes of its piece is written as long
//! as both readings then stand near its end; else the one that leads both of them nearest to it. Arcs take up what has
//! been missed: a straight side is never tilted by more than its nodes are rounded.

use super::block::Block;
use super::decode::decode;
use super::encode::{Encoded, encode, line_block, point_of, raw_block, snap};
use super::machine::travel;
use crate::geometry::{Point, Segment, turn};
use crate::program::encode::aside;
use crate::program::grid::Node;

/// The block between the nodes is written where it costs at most this, µm: one µm in each reading, as blocks of textbooks
/// miss their ends.
const NEAR: f64 = 1.4;

/// Where another block is sought, the first that costs at most this is taken.
const GOOD: f64 = 1.0;

/// The largest distance on the way counts less than that at its end, which all behind it have to take back.
const ASIDE_WEIGHS: f64 = 0.6;

/// Where the best block costs more than this, an arc is cut in two: two blocks have more ends to choose from.
const FAR: f64 = 1.8;

/// How often.
const CUTS: u32 = 3;

/// How far another block may turn a line at its other end, µm.
const TILT: f64 = 0.5;

/// Where a program stands in both readings, µm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    /// As the control counts.
    pub(super) machine: Node,
    /// Where arcs are run exactly.
    pub(super) exact: Point,
}

impl Stand {
    pub(super) fn at(node: Node) -> Stand {
        let exact = point_of(node);
        Stand {
            machine: node,
            exact,
        }
    }

    /// A block as it is run from here. `None` where it leads nowhere.
    fn run(&self, block: Block, encoded: &Encoded) -> Option<Planned> {
        let run = decode(&block, self.exact).ok()?;
        // Numbers of kilometres are not stepped.
        let by = travel(&block).or_else(|| snap(Point::from(run.end() - self.exact)))?;
        let machine = Node {
            x: self.machine.x + by.x,
            y: self.machine.y + by.y,
        };
        let exact = run.end();
        Some(Planned {
            encoded: Encoded { block, ..*encoded },
            before: *self,
            after: Stand { machine, exact },
            run,
        })
    }

    /// How badly it stands there. What lies between the two readings counts as well: no line can take it back.
    fn cost(&self, place: Point) -> f64 {
        let machine = point_of(self.machine);
        (machine - place)
            .norm()
            .hypot((machine - self.exact).norm())
    }
}

/// A block from where the program stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planned {
    pub(super) encoded: Encoded,
    pub(super) before: Stand,
    pub(super) after: Stand,
    /// How it runs in the exact reading.
    pub(super) run: Segment,
}

impl Planned {
    /// How it runs from where the machine stands.
    pub(super) fn run_of_machine(&self) -> Segment {
        self.run
            .moved(point_of(self.before.machine) - self.before.exact)
    }

    /// The largest distance from its piece in both readings.
    fn aside(&self) -> f64 {
        let [exact, machine] =
            [self.run, self.run_of_machine()].map(|run| aside(&run, &self.encoded.piece));
        exact.max(machine)
    }

    /// How badly it runs, and where it then stands.
    fn cost(&self) -> f64 {
        let end = self.after.cost(self.encoded.target());
        end.max(ASIDE_WEIGHS * self.aside())
    }

    /// Whether another block may stand in place of this one.
    fn may_be(&self, other: &Planned) -> bool {
        let piece = &self.encoded.piece;
        match (&self.run, &other.run) {
            (Segment::Line(line), Segment::Line(_)) => {
                let turned = turn(piece.start_tangent(), other.run.start_tangent());
                turned.abs() * line.length() <= TILT
            }
            (Segment::Arc(one), Segment::Arc(own)) => one.is_full_turn() == own.is_full_turn(),
            _ => false,
        }
    }
}

/// The block of a piece as it is run from where the program stands, or those that take its place. `None` where the block
/// leads nowhere. No number is above `largest`; without it there is no other block.
pub(super) fn plan(stand: Stand, encoded: Encoded, largest: Option<i64>) -> Option<Vec<Planned>> {
    match largest {
        Some(largest) => in_halves(stand, encoded, largest, CUTS),
        None => Some(vec![stand.run(encoded.block, &encoded)?]),
    }
}

fn in_halves(stand: Stand, encoded: Encoded, largest: i64, cuts: u32) -> Option<Vec<Planned>> {
    let (cost, whole) = best(stand, encoded, largest)?;
    let arc = encoded.piece.as_arc().filter(|_| cuts > 0 && cost > FAR);
    let halves = arc.and_then(|arc| {
        let (mut halves, mut made) = (Vec::new(), Vec::new());
        let middle = snap(arc.point_at(0.5))?;
        for (share, from, to) in [(0.0, encoded.from, middle), (0.5, middle, encoded.to)] {
            let half = encoded.piece.part(share, share + 0.5);
            encode(&half, from, to, largest, &mut halves)?;
        }
        for half in halves {
            let stand = made.last().map_or(stand, |last: &Planned| last.after);
            made.append(&mut in_halves(stand, half, largest, cuts - 1)?);
        }
        let is_better = !made.is_empty() && made.iter().all(|part| part.cost() < cost);
        is_better.then_some(made)
    });
    Some(halves.unwrap_or_else(|| vec![whole]))
}

/// The block between the nodes where both readings stand near its end behind it, else the best one, and what it costs.
fn best(stand: Stand, encoded: Encoded, largest: i64) -> Option<(f64, Planned)> {
    let first = stand.run(encoded.block, &encoded)?;
    let (target, mut best) = (encoded.target(), (first.cost(), first));
    for (reach, enough) in [(1, NEAR), (2, FAR)] {
        if best.0 <= enough {
            break;
        }
        for block in others(stand.machine, &encoded, reach) {
            // Exact arcs are only run where the steps alone do not rule a block out.
            let away = |by: Node| (point_of(stand.machine) + point_of(by).coords - target).norm();
            let holds = block.j > 0 && block.x.max(block.y).max(block.j) <= largest;
            if !holds || travel(&block).is_some_and(|by| away(by) >= best.0) {
                continue;
            }
            let made = stand.run(block, &encoded);
            let is_nearer = |made: &Planned| made.after.cost(target) < best.0;
            let made = made.filter(|made| is_nearer(made) && first.may_be(made));
            let made = made.map(|made| (made.cost(), made));
            best = made.filter(|(cost, _)| *cost < best.0).unwrap_or(best);
            if best.0 <= GOOD {
                return Some(best);
            }
        }
    }
    Some(best)
}

/// The blocks for the same piece from where the machine stands: of a line to the places this near to its node, of an arc
/// about the centres this near to its own, each counting up to as many micrometres more or less.
fn others(from: Node, encoded: &Encoded, reach: i64) -> Vec<Block> {
    let to = encoded.to;
    let is_line = encoded.block.motion.is_line();
    let Some(arc) = encoded.piece.as_arc().filter(|_| !is_line) else {
        return around(to, reach)
            .filter(|to| *to != from)
            .map(|to| line_block(from, to))
            .collect();
    };
    let full_turn = encoded.from == to;
    let to = if full_turn { from } else { to };
    let center = match full_turn {
        true => Some(arc.center),
        false => {
            let bulge = (arc.sweep / 4.0).tan();
            let fitted = Segment::from_bulge(point_of(from), point_of(to), bulge);
            fitted.as_arc().map(|fitted| fitted.center)
        }
    };
    let centers = center
        .and_then(snap)
        .into_iter()
        .flat_map(|center| around(center, reach));
    centers
        .filter_map(|center| raw_block(center, arc.sweep, from, to, full_turn))
        .flat_map(|block| {
            (-reach..=reach).map(move |by| Block {
                j: block.j + by,
                ..block
            })
        })
        .collect()
}

/// A node and those around it.
fn around(node: Node, reach: i64) -> impl Iterator<Item = Node> {
    let at = move |x: i64, y: i64| Node {
        x: node.x + x,
        y: node.y + y,
    };
    (-reach..=reach).flat_map(move |x| (-reach..=reach).map(move |y| at(x, y)))
}
