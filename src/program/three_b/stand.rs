//! Each block is planned from where the machine stands.
//!
//! A block does not name its end: the control counts J from where it stands, so what one block misses, all behind it
//! miss too. There are two readings of a program, and both are followed: a control steps by whole micrometres
//! ([`travel`]), a reader runs exact arcs ([`decode`]). The block between the two nodes of its piece is written as long
//! as both readings then stand near its end; else the one that leads both of them nearest to it.

use super::block::{Block, CountingAxis};
use super::decode::decode;
use super::encode::{Encoded, block_of, counted_axis, line_block, point_of, raw_block, snap};
use super::machine::travel;
use crate::geometry::{Arc, Point, Segment, Vector, turn};
use crate::program::encode::{ASIDE_TOLERANCE, aside};
use crate::program::grid::{Node, chord_count, in_pieces};
use rustc_hash::FxHashSet;

/// A micrometre more where arcs are run exactly weighs as much as this more where steps are counted.
const EXACT_WEIGHS: f64 = 0.7;

/// At least this many times what it costs to stand somewhere is as far as the machine can be from the target: whatever
/// lies between the two readings and the target costs the rest, √(2 / (1 + w² / (1 + w²))).
const MACHINE_ALONE: f64 = 1.23;

/// Both readings stand near the end of a piece where the mean of their distances from it and from each other is at most
/// this, µm: a control that stands on the node itself may be 0.7 µm off.
const NEAR: f64 = 1.0;

/// Where the best block ends further away than this as a control counts, µm, more of them are tried.
const FAR: f64 = 1.5;

/// Where none ends within this, near the 2 µm that are promised, an arc is cut in two: two blocks have more ends to
/// choose from.
const TOO_FAR: f64 = 1.8;

/// How often, and down to which length, µm.
const CUTS: u32 = 2;
const SHORTEST: f64 = 12.0;
/// Where it is cut.
const SHARES: [f64; 5] = [0.5, 0.25, 0.75, 0.125, 0.875];

/// A tiny arc becomes at most so many chords, each so far beside it, µm.
const MOST_CHORDS: i64 = 6;
const CHORD_SAGITTA: f64 = 0.75;

/// How far another block may move the wire of 4B at a joint, µm: the control offsets each block by its own direction.
const JOINT_STEP: f64 = 0.5;

/// A place and its neighbours, the place itself first.
const REACHES: &[&[i64]] = &[&[0, 1, -1], &[0, 1, -1, 2, -2]];

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
        Stand {
            machine: node,
            exact: point_of(node),
        }
    }

    fn stepped(&self, by: Node) -> Point {
        point_of(self.machine) + point_of(by).coords
    }

    /// A block as it runs from here in the exact reading, and where the program then stands. `None` where it leads
    /// nowhere.
    fn after(&self, block: &Block) -> Option<(Segment, Stand)> {
        let run = decode(block, self.exact).ok()?;
        // Numbers of kilometres are not stepped.
        let by = travel(block).or_else(|| snap(Point::from(run.end() - self.exact)))?;
        let machine = Node {
            x: self.machine.x + by.x,
            y: self.machine.y + by.y,
        };
        let exact = run.end();
        Some((run, Stand { machine, exact }))
    }

    /// The distances of both readings from a place, in µm of one that counts.
    fn off(&self, place: Point) -> [f64; 2] {
        let exact = (self.exact - place).norm() * EXACT_WEIGHS;
        [(point_of(self.machine) - place).norm(), exact]
    }

    fn is_off(&self, place: Point, by: f64) -> bool {
        self.off(place).into_iter().any(|off| off > by)
    }

    /// How badly it stands there. What lies between the two readings counts as well: no line can take it back.
    fn cost(&self, place: Point) -> f64 {
        let [machine, exact] = self.off(place);
        let apart = (point_of(self.machine) - self.exact).norm();
        ((machine * machine + exact * exact + apart * apart) / 2.0).sqrt()
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
    /// Where its piece ends; the node, where that was moved.
    pub(super) fn target(&self) -> Point {
        target(&self.encoded)
    }

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
}

fn target(encoded: &Encoded) -> Point {
    let end = encoded.piece.end();
    match snap(end) == Some(encoded.to) {
        true => end,
        false => point_of(encoded.to),
    }
}

/// What blocks may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowed {
    pub(super) largest_number: i64,
    /// The correction of a control for 4B, µm, which offsets each block: blocks keep their direction within
    /// [`JOINT_STEP`], and arcs of about that radius their radius.
    pub(super) correction: Option<f64>,
}

impl Allowed {
    fn holds(&self, block: &Block) -> bool {
        block.x.max(block.y).max(block.j) <= self.largest_number
    }

    /// Whether an arc may get another radius, or become two.
    fn may_change(&self, arc: &Arc) -> bool {
        self.correction.is_none_or(|own| arc.radius > 2.0 * own)
    }
}

/// Appends the block between two nodes, or those that take its place, as they are run from `stand`, which then is where
/// they end. `None` where the block leads nowhere.
pub(super) fn plan(
    stand: &mut Stand,
    encoded: Encoded,
    allowed: Allowed,
    out: &mut Vec<Planned>,
) -> Option<()> {
    plan_in_parts(stand, encoded, allowed, CUTS, out)
}

fn plan_in_parts(
    stand: &mut Stand,
    encoded: Encoded,
    allowed: Allowed,
    cuts: u32,
    out: &mut Vec<Planned>,
) -> Option<()> {
    // Of parts there are many to choose from.
    let reaches = if cuts == CUTS { REACHES } else { &REACHES[..1] };
    let whole = best(*stand, encoded, allowed, reaches)?;
    let target = whole.target();
    let mut taken = (whole.after, vec![whole]);
    if cuts > 0 {
        let parts = SHARES.iter().map(|share| in_two(&encoded, *share, allowed));
        for parts in parts.chain([chords(&encoded, allowed)]).flatten() {
            if !taken.0.is_off(target, TOO_FAR) {
                break;
            }
            let (mut own, mut made) = (*stand, Vec::new());
            let planned = parts
                .into_iter()
                .try_for_each(|part| plan_in_parts(&mut own, part, allowed, cuts - 1, &mut made));
            if planned.is_some() && own.cost(target) < taken.0.cost(target) {
                taken = (own, made);
            }
        }
    }
    *stand = taken.0;
    out.append(&mut taken.1);
    Some(())
}

/// An arc in two; `None` where it is none, or too short for two.
fn in_two(encoded: &Encoded, share: f64, allowed: Allowed) -> Option<Vec<Encoded>> {
    let arc = encoded.piece.as_arc()?;
    let may = !encoded.block.motion.is_line() && allowed.may_change(arc);
    if !may || encoded.piece.length() < SHORTEST {
        return None;
    }
    let middle = snap(arc.point_at(share))?;
    let part = |first: f64, last: f64, from: Node, to: Node| {
        let piece = encoded.piece.part(first, last);
        let block = block_of(piece.as_arc()?, from, to)?;
        allowed.holds(&block).then_some(Encoded {
            block,
            from,
            to,
            piece,
        })
    };
    Some(vec![
        part(0.0, share, encoded.from, middle)?,
        part(share, 1.0, middle, encoded.to)?,
    ])
}

/// The chords of a tiny arc, of which none takes the two readings further apart.
fn chords(encoded: &Encoded, allowed: Allowed) -> Option<Vec<Encoded>> {
    let is_arc = !encoded.block.motion.is_line() && allowed.correction.is_none();
    let arc = encoded.piece.as_arc().filter(|_| is_arc)?;
    let count = chord_count(arc, CHORD_SAGITTA).filter(|count| *count <= MOST_CHORDS)?;
    let mut chords = Vec::new();
    in_pieces(
        &encoded.piece,
        encoded.from,
        encoded.to,
        count,
        |piece, from, to| {
            let block = line_block(from, to);
            chords.push(Encoded {
                block,
                from,
                to,
                piece,
            });
            Some(())
        },
    )?;
    Some(chords)
}

/// The block between the nodes where both readings stand near its end behind it, else the best one.
fn best(stand: Stand, encoded: Encoded, allowed: Allowed, reaches: &[&[i64]]) -> Option<Planned> {
    let target = target(&encoded);
    let planned = |block: Block| {
        let (run, after) = stand.after(&block)?;
        Some(Planned {
            encoded: Encoded { block, ..encoded },
            before: stand,
            after,
            run,
        })
    };
    let first = planned(encoded.block)?;
    let mut best = first;
    let mut least = first.after.cost(target);
    // Exact arcs are only run where the steps alone do not rule a block out.
    let is_hopeless = |block: &Block, least: f64| {
        let by = travel(block);
        by.is_some_and(|by| (stand.stepped(by) - target).norm() >= MACHINE_ALONE * least)
    };
    if least <= NEAR {
        return Some(best);
    }
    // Where it stands too far away already, every block begins there.
    let widest = ASIDE_TOLERANCE.max(first.aside());
    for reach in reaches {
        let mut look = |block: Block| {
            let may = allowed.holds(&block) && !is_hopeless(&block, least);
            let made = may.then(|| planned(block)).flatten();
            if let Some(made) = made
                && made.after.cost(target) < least
                && is_alike(&first, &made, allowed)
                && made.aside() <= widest
            {
                (best, least) = (made, made.after.cost(target));
            }
            least > NEAR
        };
        match &encoded.piece {
            Segment::Arc(arc) if !encoded.block.motion.is_line() => {
                arcs(stand.machine, &encoded, arc, reach, &mut look);
            }
            _ => lines(stand.machine, &encoded, reach, &mut look),
        }
        if !best.after.is_off(target, FAR) {
            break;
        }
    }
    Some(best)
}

/// Whether a block is of the same kind as the one between the nodes, counts on the axis that it has to, and, in 4B, can
/// be offset in its place.
fn is_alike(first: &Planned, other: &Planned, allowed: Allowed) -> bool {
    let joins = |share: f64| {
        let [one, other] = [first, other].map(|planned| planned.run.tangent_at(share));
        let correction = allowed.correction.unwrap_or(0.0);
        turn(one, other).abs() * correction <= JOINT_STEP
    };
    let is_kind = match (&first.run, &other.run) {
        (Segment::Line(_), Segment::Line(_)) => true,
        (Segment::Arc(one), Segment::Arc(own)) => {
            one.is_full_turn() == own.is_full_turn()
                && (allowed.may_change(one) || one.radius.round() == own.radius.round())
                && counts_rightly(own.end - own.center, other.encoded.block.axis)
        }
        _ => false,
    };
    is_kind && joins(0.0) && joins(1.0)
}

/// Whether an arc that ends here, seen from its centre, counts on the axis that it has to: within 1 µm of a tie on either.
fn counts_rightly(end: Vector, axis: CountingAxis) -> bool {
    axis == counted_axis(end) || (end.x.abs() - end.y.abs()).abs() <= 1.0
}

/// Lines from where the machine stands to the node and those around it, onwards; `look` says whether to go on.
fn lines(from: Node, encoded: &Encoded, reach: &[i64], look: &mut dyn FnMut(Block) -> bool) {
    let Encoded {
        from: start, to, ..
    } = *encoded;
    let along = point_of(to) - point_of(start);
    for end in around(to, reach) {
        let leads_on = (point_of(end) - point_of(from)).dot(&along) > 0.0;
        if leads_on && !look(line_block(from, end)) {
            return;
        }
    }
}

/// The arc of the same turn from where the machine stands to the node and those around it, about the grid centres
/// around its own, each counting 1 µm more or less. A full turn ends where it begins.
fn arcs(
    from: Node,
    encoded: &Encoded,
    arc: &Arc,
    reach: &[i64],
    look: &mut dyn FnMut(Block) -> bool,
) {
    let full_turn = encoded.from == encoded.to;
    let bulge = (arc.sweep / 4.0).tan();
    let mut seen = FxHashSet::default();
    let ends = around(encoded.to, reach).take(if full_turn { 1 } else { usize::MAX });
    for to in ends {
        let (to, center) = match full_turn {
            true => (from, Some(arc.center)),
            false => {
                let fitted = Segment::from_bulge(point_of(from), point_of(to), bulge);
                (to, fitted.as_arc().map(|fitted| fitted.center))
            }
        };
        for center in center
            .and_then(snap)
            .into_iter()
            .flat_map(|center| around(center, reach))
        {
            let Some(block) = raw_block(center, arc.sweep, from, to, full_turn) else {
                continue;
            };
            for by in reach {
                let block = Block {
                    j: block.j + by,
                    ..block
                };
                // Of two ends the arcs may be about one centre.
                if seen.insert(block) && !look(block) {
                    return;
                }
            }
        }
    }
}

/// A node and those around it.
fn around(node: Node, reach: &[i64]) -> impl Iterator<Item = Node> {
    let at = move |x: &i64, y: &i64| Node {
        x: node.x + x,
        y: node.y + y,
    };
    reach
        .iter()
        .flat_map(move |x| reach.iter().map(move |y| at(x, y)))
}
