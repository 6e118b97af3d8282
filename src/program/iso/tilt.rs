//! The way of the wire's upper end while a program tilts the wire.
//!
//! A program can tilt it in three ways: by an angle (G51 to the left of the way, G52 to the right, with A or T; G50
//! ends it; G141, G142 and G140 the same), by the distance of the upper guide from the lower one (U, V), or by a second
//! contour after a colon. An angle needs the height between the programmed plane and the other one: TP and TN, else
//! the workpiece's.

mod angle;
mod words;

pub(crate) use angle::{Doubtful, STEEPEST};
pub(super) use words::{Upper, upper_words};

use super::block::{Register, read_line};
use super::document::Document;
use super::machine::Machine;
use super::moves::{Move, Place, Reading, added, apart, micrometres};
use super::word::Number;
use crate::geometry::{
    Arc, Point, Segment, Side, Vector, circle_circle, left_normal, line_circle, line_line, turn,
};
use angle::degrees;
use words::Words;

/// A joint that turns by less is tangent, radians.
const TANGENT: f64 = 1e-3;

/// Where the way turns back by more, radians, the upper end follows a chord: its two ways meet nowhere near.
const TURNS_BACK: f64 = 2.6;

/// Radii and shifts that differ by less are equal, µm.
const SAME: f64 = 2.0;

/// An arc whose upper curve is no arc is shown in this many chords.
const CHORDS: u32 = 32;

/// The program's data about the wire's upper end.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Taper {
    /// For each move of the program in its order, the way of the upper end, µm; nothing where it follows the lower one.
    pub(crate) upper: Vec<Vec<Segment>>,
    /// The arcs that are cut with a tilted wire.
    pub(crate) arcs: Vec<TiltedArc>,
    /// Why some of it is unknown.
    pub(crate) unknown: Option<Unknown>,
    /// The first angle that is hardly meant.
    pub(crate) doubtful: Option<Doubtful>,
}

/// Why the way of the upper end is unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// No angle stands with G51 or G52; the line, from 0.
    Angle(usize),
    /// The line tilts the wire by more than any machine does.
    Steep(usize),
    /// Neither TP and TN nor the height of the workpiece is set; the line that tilts the wire.
    Height(usize),
}

/// An arc that is cut while the wire leans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TiltedArc {
    /// Line of the text, from 0.
    pub(crate) line: usize,
    /// µm, in the programmed plane.
    pub(crate) radius: f64,
    /// How much smaller it is in the other plane, µm; below 0 where it is larger there.
    pub(crate) narrows: f64,
    /// Of the wire against the vertical, radians.
    pub(crate) angle: f64,
    /// The control lets the wire run within the arc.
    pub(crate) is_inside: bool,
    /// Where the control finds its correction.
    pub(crate) offset: Option<Register>,
}

impl TiltedArc {
    /// The least radius that the wire passes with a correction, µm both. In a plane the wire's axis is `c / cos β` from
    /// the part, and on the side where the arc narrows it loses `H · tan β` more.
    pub(crate) fn least(&self, correction: f64) -> f64 {
        let own = if self.is_inside {
            correction / self.angle.cos()
        } else {
            0.0
        };
        own + self.narrows.max(0.0)
    }
}

/// How the wire leans.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lean {
    Upright,
    /// The upper end is this far to the left of the lower one's way, µm, under the angle in radians.
    Beside {
        by: f64,
        angle: f64,
    },
    /// The upper end is this far from the lower one at the end of the move.
    Apart(Vector),
    /// The upper end has a move of its own.
    Own(Segment),
}

/// A move with how the wire leans after it.
struct Leaning {
    line: usize,
    lower: Segment,
    is_cut: bool,
    side: Option<Side>,
    offset: Option<Register>,
    lean: Lean,
}

impl Document {
    /// The way of the wire's upper end; `None` where no word tilts the wire. The height of the workpiece replaces
    /// planes that the program does not give.
    pub(crate) fn taper(&self) -> Option<Taper> {
        let mut foreign = self.cuts.iter().flat_map(|cut| &cut.rare().foreign);
        if !foreign.any(|word| word.code.tilts()) {
            return None;
        }
        let mut reader = Reader::new(*self.reading(), self.control.limits.settings.job.thickness);
        let mut moves: Vec<Leaning> = Vec::new();
        for cut in 0..self.cuts.len() {
            self.run_lines(cut, &mut |ran| {
                let line = self.line_bytes(ran.line);
                reader.read(ran.line, line, ran.machine);
                for made in ran.moves() {
                    moves.push(reader.leaning(ran.line, &made));
                }
            });
        }
        let leans = moves.iter().any(|one| one.lean != Lean::Upright);
        (leans || reader.unknown.is_some()).then(|| Taper {
            upper: upper_of(&moves),
            arcs: moves.iter().filter_map(tilted_arc).collect(),
            unknown: reader.unknown,
            doubtful: reader.doubtful,
        })
    }
}

/// The state of everything that tilts the wire.
#[derive(Default)]
pub(super) struct Reader {
    reading: Reading,
    thickness: Option<f64>,
    /// The side to which the wire leans, and the line that set it.
    side: Option<(Side, usize)>,
    /// Radians.
    angle: Option<f64>,
    /// The programmed plane and the other one, nm.
    planes: [Option<i64>; 2],
    /// From the lower end to the upper one, nm, by U and V.
    apart: Place,
    /// The upper end by itself, once a second contour has appeared.
    upper: Option<Machine>,
    /// This line's words for it.
    own: Option<Segment>,
    unknown: Option<Unknown>,
    doubtful: Option<Doubtful>,
}

impl Reader {
    pub(super) fn new(reading: Reading, thickness: Option<f64>) -> Reader {
        Reader {
            reading,
            thickness,
            ..Reader::default()
        }
    }

    /// True where the wire leans on a move after the lines so far.
    pub(super) fn leans(&self) -> bool {
        let is_aside = self.side.is_some() && self.angle != Some(0.0);
        is_aside || self.apart != [0, 0] || self.upper.is_some()
    }

    /// Executes a line; `machine` is the state after it.
    pub(super) fn read(&mut self, line: usize, bytes: &[u8], machine: &Machine) {
        self.own = None;
        let said = Words::of(bytes);
        let switches = said.side.is_some() || said.upright;
        if said.upright {
            self.side = None;
        }
        if let Some(side) = said.side {
            self.side = Some((side, line));
        }
        // T switches other things where no word tilts the wire.
        let angle = said.angle.or(said.tool.filter(|_| said.side.is_some()));
        if let Some(angle) = angle.filter(|_| self.side.is_some()) {
            let (degrees, doubtful) = degrees(angle, self.reading.whole_numbers_are_fine, line);
            let is_steep = doubtful.is_some_and(|it| it.is_steep);
            self.angle = (!is_steep).then(|| degrees.to_radians());
            self.doubtful = self.doubtful.or(doubtful);
        }
        let length = |number: Option<Number>| self.reading.length_within(number?, machine.inch);
        for (plane, number) in self.planes.iter_mut().zip(said.planes) {
            *plane = length(number).or(*plane);
        }
        // Beside G51 they are not positions of the guide.
        for (axis, number) in said.guide.into_iter().enumerate().filter(|_| !switches) {
            let Some(length) = length(number) else {
                continue;
            };
            self.apart[axis] = match machine.incremental {
                true => self.apart[axis].wrapping_add(length),
                false => length,
            };
        }
        if let Some(second) = said.second {
            self.follow(&bytes[second..], machine);
        }
    }

    /// The move of the upper end after the colon. Omitted words are those of the lower end.
    fn follow(&mut self, bytes: &[u8], machine: &Machine) {
        let block = read_line(bytes, 1, |_| {});
        let before = self.upper.unwrap_or(Machine {
            at: machine.at,
            ..*machine
        });
        let mut upper = Machine {
            at: before.at,
            lost: before.lost,
            side: None,
            ..*machine
        };
        self.own = upper
            .run(&block, &self.reading)
            .map(|made| made.segment(&self.reading));
        self.upper = Some(upper);
    }

    /// A move, and how the wire leans after it.
    fn leaning(&mut self, line: usize, made: &Move) -> Leaning {
        let lean = self.lean(made);
        Leaning {
            line,
            lower: made.segment(&self.reading),
            is_cut: made.is_cut(),
            side: made.side,
            offset: made.offset,
            lean,
        }
    }

    fn lean(&mut self, made: &Move) -> Lean {
        if let Some(upper) = &mut self.upper {
            let Some(own) = self.own.take() else {
                // The upper end keeps its distance.
                upper.at = added(upper.at, apart(made.to, made.from));
                return Lean::apart(apart(upper.at, made.to));
            };
            return Lean::Own(own);
        }
        let Some((side, line)) = self.side else {
            return Lean::apart(self.apart);
        };
        let Some(angle) = self.angle else {
            let steep = self.doubtful.filter(|it| it.is_steep);
            let why = steep.map_or(Unknown::Angle(line), |it| Unknown::Steep(it.line));
            self.unknown.get_or_insert(why);
            return Lean::apart(self.apart);
        };
        let height = match (self.planes, self.thickness) {
            ([programmed, Some(other)], _) => (other - programmed.unwrap_or(0)) as f64 / 1e3,
            (_, Some(thickness)) => thickness * 1e3,
            _ => {
                self.unknown.get_or_insert(Unknown::Height(line));
                return Lean::apart(self.apart);
            }
        };
        Lean::Beside {
            by: angle.tan() * height * side.sign(),
            angle,
        }
    }
}

impl Lean {
    fn apart(place: Place) -> Lean {
        match place {
            [0, 0] => Lean::Upright,
            apart => Lean::Apart(micrometres(apart).coords),
        }
    }
}

/// The way of the upper end in each move.
fn upper_of(moves: &[Leaning]) -> Vec<Vec<Segment>> {
    let mut upper = Vec::with_capacity(moves.len());
    // From the lower end to the upper one, where the last move ended.
    let mut before = Vector::zeros();
    for (nth, one) in moves.iter().enumerate() {
        let (begin, end) = (one.lower.start() + before, one.lower.end());
        let pieces = match one.lean {
            Lean::Upright if before == Vector::zeros() => Vec::new(),
            Lean::Upright => vec![Segment::line(begin, end)],
            Lean::Own(own) => vec![own],
            Lean::Apart(apart) => shifted(&one.lower, before, apart),
            Lean::Beside { by, .. } => {
                let leant = nth.checked_sub(1).map(|nth| &moves[nth]);
                let next = moves.get(nth + 1);
                beside(one, by, begin, leant, next)
            }
        };
        before = match pieces.last() {
            Some(last) => last.end() - end,
            None => Vector::zeros(),
        };
        upper.push(pieces);
    }
    upper
}

/// The upper end of a move at whose beginning it is `from` apart from the lower one, and `to` at its end.
fn shifted(lower: &Segment, from: Vector, to: Vector) -> Vec<Segment> {
    let (begin, end) = (lower.start() + from, lower.end() + to);
    let Segment::Arc(arc) = lower else {
        return vec![Segment::line(begin, end)];
    };
    if (to - from).norm() <= SAME {
        return vec![lower.moved(from)];
    }
    let radii = [begin, end].map(|point| (point - arc.center).norm());
    if (radii[0] - radii[1]).abs() <= SAME && radii[0] > SAME {
        return vec![Segment::Arc(Arc::about(
            arc.center,
            begin,
            end,
            arc.sweep > 0.0,
        ))];
    }
    let at = |step: u32| {
        let share = f64::from(step) / f64::from(CHORDS);
        arc.point_at(share) + from + (to - from) * share
    };
    (0..CHORDS)
        .map(|step| Segment::line(at(step), at(step + 1)))
        .collect()
}

/// The upper end of a move that runs `by` to the left of it, from its present position.
fn beside(
    one: &Leaning,
    by: f64,
    begin: Point,
    before: Option<&Leaning>,
    next: Option<&Leaning>,
) -> Vec<Segment> {
    let leant = |other: Option<&Leaning>| match other {
        Some(Leaning {
            lean: Lean::Beside { by, .. },
            lower,
            ..
        }) => Some((*by, *lower)),
        _ => None,
    };
    let lower = &one.lower;
    let own_end = lower.end() + left_normal(lower.end_tangent()) * by;
    let end = match leant(next) {
        Some((other, behind)) if leant(before).is_none() => {
            // The move on which the wire is tilted ends where the next one begins.
            behind.start() + left_normal(behind.start_tangent()) * other
        }
        Some((other, behind)) => met(lower, by, &behind, other).unwrap_or(own_end),
        None => own_end,
    };
    if leant(before).is_none() {
        return vec![Segment::line(begin, end)];
    }
    let own_begin = lower.start() + left_normal(lower.start_tangent()) * by;
    let mut pieces = Vec::new();
    let (_, last) = leant(before).unwrap_or((by, *lower));
    let turns_back = turn(last.end_tangent(), lower.start_tangent()).abs() > TURNS_BACK;
    let from = if turns_back { own_begin } else { begin };
    if (from - begin).norm() > SAME {
        pieces.push(Segment::line(begin, from));
    }
    pieces.push(match lower {
        Segment::Arc(arc) if (from - arc.center).norm() > SAME && !collapses(arc, by) => {
            Segment::Arc(Arc::about(arc.center, from, end, arc.sweep > 0.0))
        }
        _ => Segment::line(from, end),
    });
    pieces
}

/// True for an arc that narrows to nothing on the way up.
fn collapses(arc: &Arc, by: f64) -> bool {
    arc.radius <= by * arc.sweep.signum()
}

/// Where the upper ends of two moves that follow each other meet.
fn met(one: &Segment, by: f64, other: &Segment, other_by: f64) -> Option<Point> {
    let (u, v) = (one.end_tangent(), other.start_tangent());
    let [a, b] = [left_normal(u) * by, left_normal(v) * other_by];
    let corner = one.end();
    let turned = turn(u, v).abs();
    if turned < TANGENT {
        return Some(corner + (a + b) / 2.0);
    }
    if turned > TURNS_BACK {
        return None;
    }
    let guess = line_line(corner + a, u, corner + b, v)?;
    let circle = |segment: &Segment, by: f64| {
        let arc = *segment.as_arc()?;
        Some((arc.center, arc.radius - by * arc.sweep.signum()))
    };
    let meet = match (circle(one, by), circle(other, other_by)) {
        (None, None) => return Some(guess),
        (Some((center, radius)), None) => line_circle(corner + b, v, center, radius),
        (None, Some((center, radius))) => line_circle(corner + a, u, center, radius),
        (Some(first), Some(second)) => circle_circle(first.0, first.1, second.0, second.1),
    };
    let away = |point: &Point| (point - guess).norm();
    let nearest = meet.into_iter().min_by(|p, q| away(p).total_cmp(&away(q)));
    Some(nearest.unwrap_or(guess))
}

fn tilted_arc(one: &Leaning) -> Option<TiltedArc> {
    let (Lean::Beside { by, angle }, Segment::Arc(arc), true) = (one.lean, &one.lower, one.is_cut)
    else {
        return None;
    };
    let to_left = arc.sweep > 0.0;
    Some(TiltedArc {
        line: one.line,
        radius: arc.radius,
        narrows: if to_left { by } else { -by },
        angle: angle.abs(),
        is_inside: one.side.is_some_and(|side| (side == Side::Left) == to_left),
        offset: one.offset,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_tilt_the_wire_until_others_stand_it_upright() {
        for (lines, leans) in [
            (&["G51 A3."][..], true),
            (&["G52 T2."], true),
            (&["G51"], true),
            (&["G141 A1."], true),
            (&["G51 A3.", "G50"], false),
            (&["G51 A0."], false),
            (&["G50"], false),
            (&["U1. V0."], true),
            (&["U1.", "U0."], false),
            (&["T84", "M80", "A3."], false),
            (&["X0. Y0. : X1. Y0."], true),
        ] {
            let mut reader = Reader::default();
            let lines = lines.iter().map(|line| line.as_bytes());
            lines.for_each(|line| reader.read(0, line, &Machine::default()));
            assert_eq!(reader.leans(), leans);
        }
    }
}
