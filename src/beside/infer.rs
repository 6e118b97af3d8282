//! Infers corrections from a program.
//!
//! Beside a contour every line keeps its direction and every arc its sweep: the length of the one and the radius of the
//! other tell how far away the program runs, wherever it lies. Each pair of a block and a segment that may belong
//! together has a vote.

use super::drawn::Contour;
use crate::geometry::{Bounds, Point, Segment, Vector, positive_angle, turn};

/// The range of corrections, µm.
const LEAST: f64 = 5.0;
const MOST: f64 = 3_000.0;
/// The most blocks and segments that vote.
const ASKED: usize = 400;
/// Angles of one corner, radians.
const ANGLE: f64 = 0.01;
/// The angle by which an arc may be cut off at either end, radians.
const CUT_OFF: f64 = 0.2;
/// Votes for one correction lie within this, µm.
const ONE: f64 = 2.0;
/// The most corrections that are returned.
const TOLD: usize = 5;

/// A segment with the turns before and after it.
#[derive(Clone, Debug)]
struct Turned {
    segment: Segment,
    before: f64,
    behind: f64,
}

/// The blocks of a program by the direction in which they begin.
struct Program(Vec<Vec<Turned>>);

impl Program {
    /// Each is wider than the angle by which two that belong together may differ.
    const SECTORS: usize = (std::f64::consts::TAU / CUT_OFF) as usize;

    fn of(blocks: Vec<Turned>) -> Program {
        let mut sectors: Vec<Vec<Turned>> = Vec::new();
        sectors.resize_with(Program::SECTORS, Vec::new);
        for block in blocks {
            sectors[Program::sector(block.segment.start_tangent())].push(block);
        }
        Program(sectors)
    }

    fn sector(direction: Vector) -> usize {
        let share = positive_angle(direction.y.atan2(direction.x)) / std::f64::consts::TAU;
        ((share * Program::SECTORS as f64) as usize).min(Program::SECTORS - 1)
    }

    /// The blocks that may have a vote for a segment: they begin about as it begins, or as it ends.
    fn beside(&self, own: &Turned) -> impl Iterator<Item = &Turned> {
        let ends = [own.segment.start_tangent(), own.segment.end_tangent()].map(Program::sector);
        // The same sector, or one beside it.
        let is_about = move |sector: usize| {
            let is_it = |end: usize| (sector + 1 + Program::SECTORS - end) % Program::SECTORS <= 2;
            ends.into_iter().any(is_it)
        };
        let about = (0..Program::SECTORS).filter(move |sector| is_about(*sector));
        about.flat_map(|sector| &self.0[sector])
    }
}

/// Corrections in mm, the one with the most votes first. `scale` is the drawing's unit in µm.
pub(super) fn corrections<'a>(
    contours: impl Iterator<Item = &'a Contour>,
    scale: f64,
    blocks: &[Segment],
) -> Vec<f64> {
    most(votes(contours, scale, blocks))
}

/// The same for the first of several passes, each of which runs nearer to the wall than that by its distance, µm: all
/// of them vote.
pub(super) fn of_passes(
    contours: &[Contour],
    scale: f64,
    passes: &[Vec<Segment>],
    steps: &[f64],
) -> Vec<f64> {
    let all = passes.iter().zip(steps).flat_map(|(pass, step)| {
        let own = votes(contours.iter(), scale, pass);
        own.into_iter().map(move |vote| vote + step)
    });
    most(all.collect())
}

/// The votes of each block for a correction, µm.
fn votes<'a>(
    contours: impl Iterator<Item = &'a Contour>,
    scale: f64,
    blocks: &[Segment],
) -> Vec<f64> {
    let program = Program::of(turned(blocks, false));
    let mut votes = Vec::new();
    let mut box_of_program = Bounds::EMPTY;
    blocks
        .iter()
        .for_each(|block| box_of_program.merge(&block.bounds()));
    for contour in contours {
        let segments: Vec<Segment> = contour
            .segments
            .iter()
            .map(|segment| crate::program::write::scaled(&segment.geometry, scale))
            .collect();
        let mut bounds = Bounds::EMPTY;
        segments
            .iter()
            .for_each(|segment| bounds.merge(&segment.bounds()));
        let wider = (box_of_program.width() - bounds.width()) / 2.0;
        let higher = (box_of_program.height() - bounds.height()) / 2.0;
        if (wider - higher).abs() <= ONE {
            votes.extend([wider.abs(); 3]);
        }
        // A circle has no corners: each arc of the program votes, wherever it begins.
        if let Some((_, radius)) = circle(segments.iter()) {
            let arcs = blocks.iter().filter_map(Segment::as_arc);
            votes.extend(arcs.map(|arc| (arc.radius - radius).abs()));
        }
        let forward = turned(&segments, contour.closed);
        let reversed: Vec<Segment> = segments.iter().rev().map(Segment::reversed).collect();
        let back = turned(&reversed, contour.closed);
        for own in forward.iter().chain(&back) {
            votes.extend(program.beside(own).filter_map(|block| vote(own, block)));
        }
    }
    votes
}

/// The correction with the most votes, mm.
fn most(mut votes: Vec<f64>) -> Vec<f64> {
    votes.retain(|vote| (LEAST..=MOST).contains(vote));
    votes.sort_by(f64::total_cmp);
    let mut found: Vec<(usize, f64)> = Vec::new();
    let mut from = 0;
    while from < votes.len() {
        let count = votes[from..]
            .iter()
            .take_while(|vote| **vote - votes[from] <= ONE)
            .count();
        let mean = votes[from..from + count].iter().sum::<f64>() / count as f64;
        found.push((count, (mean * 10.0).round() / 1e4));
        from += count;
    }
    found.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)));
    found.truncate(TOLD);
    found.into_iter().map(|(_, mm)| mm).collect()
}

/// Centre and radius of segments that are one circle.
pub(super) fn circle<'a>(mut segments: impl Iterator<Item = &'a Segment>) -> Option<(Point, f64)> {
    let first = segments.next()?.as_arc()?;
    let is_of_it = |segment: &Segment| {
        let arc = segment.as_arc();
        arc.is_some_and(|arc| {
            (arc.center - first.center).norm() + (arc.radius - first.radius).abs() < ONE
        })
    };
    segments
        .all(is_of_it)
        .then_some((first.center, first.radius))
}

fn turned(segments: &[Segment], closed: bool) -> Vec<Turned> {
    let count = segments.len();
    let joint =
        |one: usize, next: usize| turn(segments[one].end_tangent(), segments[next].start_tangent());
    let at = |index: usize| Turned {
        segment: segments[index],
        before: match index {
            0 if closed => joint(count - 1, 0),
            0 => f64::NAN,
            _ => joint(index - 1, index),
        },
        behind: match index + 1 {
            end if end == count && closed => joint(index, 0),
            end if end == count => f64::NAN,
            _ => joint(index, index + 1),
        },
    };
    (0..count.min(ASKED)).map(at).collect()
}

/// The correction from a block, if it runs beside a segment or round the corner after it; µm.
fn vote(own: &Turned, block: &Turned) -> Option<f64> {
    let (along, run) = (&own.segment, &block.segment);
    let turned = turn(along.start_tangent(), run.start_tangent()).abs();
    let same_way = turned <= ANGLE;
    match (along.as_arc(), run.as_arc()) {
        // Its neighbours cut off a block that meets them at an angle.
        (Some(own), Some(arc)) if turned.max((own.sweep - arc.sweep).abs()) <= CUT_OFF => {
            Some((own.radius - arc.radius).abs())
        }
        (None, None) if same_way => {
            let alike = (own.before - block.before).abs() <= ANGLE
                && (own.behind - block.behind).abs() <= ANGLE;
            let grows = (own.before / 2.0).tan() + (own.behind / 2.0).tan();
            (alike && grows.abs() > 0.05)
                .then(|| (run.length() - along.length()).abs() / grows.abs())
        }
        (_, Some(arc)) => {
            let round_corner = (own.behind - arc.sweep).abs() <= ANGLE
                && arc.sweep.abs() > 0.05
                && turn(along.end_tangent(), run.start_tangent()).abs() <= ANGLE;
            round_corner.then_some(arc.radius)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction;
    use proptest::prelude::*;

    /// A line or an arc of any direction.
    fn segment() -> impl Strategy<Value = Segment> {
        let bulge = prop_oneof![Just(0.0), -2.0..2.0];
        let place = || (-100i32..100).prop_map(|it| f64::from(it) / 10.0);
        (place(), place(), 0.0..std::f64::consts::TAU, bulge).prop_map(|(x, y, angle, bulge)| {
            let start = Point::new(x, y);
            let end = start + 7.0 * direction(angle);
            Segment::from_bulge(start, end, bulge)
        })
    }

    /// The same with neighbours that its votes may depend on.
    fn turned_segment() -> impl Strategy<Value = Turned> {
        (segment(), -1.5..1.5, -1.5..1.5).prop_map(|(segment, before, behind)| Turned {
            segment,
            before,
            behind,
        })
    }

    /// A segment, and a block that runs beside it or round its end.
    fn pair() -> impl Strategy<Value = (Turned, Turned)> {
        let alike = (turned_segment(), -0.25..0.25, any::<bool>());
        alike.prop_map(|(own, by, is_behind)| {
            let towards = match is_behind {
                true => own.segment.end_tangent(),
                false => own.segment.start_tangent(),
            };
            let from = own.segment.end();
            let sweep = if is_behind {
                own.behind
            } else {
                own.segment.as_arc().map_or(0.0, |arc| arc.sweep)
            };
            // An arc that begins that way bends away from its chord by half of its sweep.
            let chord = direction(towards.y.atan2(towards.x) + by + sweep / 2.0);
            let block = Turned {
                segment: Segment::from_bulge(from, from + 5.0 * chord, (sweep / 4.0).tan()),
                before: own.before,
                behind: own.behind,
            };
            (own, block)
        })
    }

    proptest! {
        #[test]
        fn each_block_that_votes_is_looked_at((own, block) in pair()) {
            let voted = vote(&own, &block);
            let program = Program::of(vec![block]);
            let looked_at: Vec<f64> =
                program.beside(&own).filter_map(|block| vote(&own, block)).collect();
            prop_assert_eq!(looked_at, voted.into_iter().collect::<Vec<f64>>());
        }
    }

    #[test]
    fn pairs_of_the_property_vote() {
        use proptest::strategy::ValueTree;
        use proptest::test_runner::TestRunner;
        let mut runner = TestRunner::deterministic();
        let votes = (0..200).filter(|_| {
            let tree = pair().new_tree(&mut runner);
            tree.is_ok_and(|tree| {
                let (own, block) = tree.current();
                vote(&own, &block).is_some()
            })
        });
        assert!(votes.count() > 20);
    }
}
