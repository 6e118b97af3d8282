//! The ways of the wire round the contours of a drawing, as places along which a program moves.

mod pieces;

use super::drawn::{Contour, Drawn};
use super::infer::circle;
use crate::drawing::EntityId;
use crate::geometry::{Arc, Bounds, Grid, Point, Segment, Side, Vector, left_normal};
use crate::program::write::scaled;
use crate::settings::{Compensation, Effective};
use crate::toolpath::{self, PathSegment, Source};
use rustc_hash::FxHashMap;
use std::cell::OnceCell;
use std::ops::Range;

/// Where the wire goes round a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Course {
    /// The contour itself: it is the path, or the control offsets it.
    Drawn,
    /// The part's contour as 4B has it.
    FourB,
    /// Beside it by this many mm.
    Beside(f64),
}

/// A piece of a round and its segment of the drawing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub segment: Segment,
    /// The same against the direction of the round.
    back: Segment,
    pub source: Option<(EntityId, usize)>,
    /// Where it begins along the round, µm.
    pub before: f64,
}

/// A way round a contour, µm.
#[derive(Debug)]
pub(super) struct Round {
    pub contour: usize,
    pub closed: bool,
    /// An open one that the wire runs beside: it is cut from its one end to the other.
    pub(crate) from_end: bool,
    pub pieces: Vec<Piece>,
    pub length: f64,
    /// Centre and radius, where it is a circle.
    pub circle: Option<(Point, f64)>,
    /// How far to the left of it the wire runs, where the control offsets it: 4B moves it there where the wire
    /// begins.
    beside: Option<f64>,
}

/// A place on a round, with the direction of travel from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub round: usize,
    pub piece: usize,
    /// Against the direction of the round.
    pub back: bool,
    pub at: Point,
}

/// Pieces up to this length, µm, are left out: nothing of them may be left on the grid of a program.
const CRUMB: f64 = 1.0;

/// A round and a piece of it.
type Place = (u32, u32);

/// All rounds with which a program is compared.
#[derive(Debug, Default)]
pub(super) struct Rounds {
    pub rounds: Vec<Round>,
    index: Grid<Place>,
    /// Rounds of each course that have been laid.
    laid: Vec<(usize, Side, Course)>,
    /// Pieces by the vector from their start to their end, in cells.
    leads: OnceCell<FxHashMap<(i64, i64), Vec<Place>>>,
    /// Those that are arcs by their radii, in cells of the same width.
    radii: OnceCell<FxHashMap<i64, Vec<Place>>>,
}

/// How far a transition of 4B may differ from the one in the other direction, µm.
const SAME: f64 = 6.0;

impl Rounds {
    /// Adds a course beside all contours, or one of them, unless it is there.
    pub(super) fn add(&mut self, drawn: &Drawn, courses: &[Course], only: Option<usize>) {
        for (index, contour) in drawn.contours().iter().enumerate() {
            if only.is_some_and(|only| only != index) {
                continue;
            }
            let sides = match contour.side {
                Some(side) => vec![side],
                None => vec![Side::Left, Side::Right],
            };
            for side in sides {
                let mut new = courses.to_vec();
                new.retain(|course| !self.is_laid(index, side, *course));
                self.laid
                    .extend(new.iter().map(|course| (index, side, *course)));
                let is_four_b = contour.closed && new.contains(&Course::FourB);
                for (nth, pieces) in along(contour, side, &new, drawn).into_iter().enumerate() {
                    self.push((index, contour), pieces, drawn.unit_mm * 1e3);
                    if nth == 0 && is_four_b {
                        self.turn_back(contour, side, drawn);
                    }
                }
            }
        }
    }

    /// 4B's transitions are rounded differently when its contour is cut in the other direction.
    fn turn_back(&mut self, contour: &Contour, side: Side, drawn: &Drawn) {
        let scale = drawn.unit_mm * 1e3;
        let reversed = own(contour).into_iter().rev().map(|piece| PathSegment {
            geometry: piece.geometry.reversed(),
            ..piece
        });
        let path = joined(reversed.collect(), true);
        let (settings, unit_mm) = (&*drawn.settings, drawn.unit_mm);
        let Some(mut path) = of_four_b(path, (side.reversed(), contour.closed), settings, unit_mm)
        else {
            return;
        };
        path.retain(|piece| piece.geometry.length() * scale > CRUMB);
        let Some(round) = self.rounds.last_mut() else {
            return;
        };
        round.beside = Some(side.sign() * settings.correction * 1e3);
        for piece in &mut round.pieces {
            let own = piece.segment.reversed();
            let is_same = |other: &Segment| {
                (other.start() - own.start()).norm() <= SAME
                    && (other.end() - own.end()).norm() <= SAME
            };
            let all = path.iter().map(|piece| scaled(&piece.geometry, scale));
            if let Some(back) = all.into_iter().find(is_same) {
                piece.back = back;
            }
        }
    }

    fn is_laid(&self, contour: usize, side: Side, course: Course) -> bool {
        self.laid.iter().any(|(of, other, laid)| {
            *of == contour
                && match (laid, course) {
                    (Course::Beside(one), Course::Beside(two)) => {
                        *other == side && (one - two).abs() < 2e-4
                    }
                    // The contour itself has no side.
                    (Course::Drawn, Course::Drawn) => true,
                    (Course::FourB, Course::FourB) => *other == side,
                    _ => false,
                }
        })
    }

    fn push(&mut self, (index, contour): (usize, &Contour), path: Vec<PathSegment>, scale: f64) {
        let mut round = Round {
            contour: index,
            closed: contour.closed,
            from_end: !contour.closed && contour.side.is_some(),
            pieces: Vec::with_capacity(path.len()),
            length: 0.0,
            circle: None,
            beside: None,
        };
        for piece in path {
            let source = piece.source.segment();
            match scaled(&piece.geometry, scale) {
                // A circle has no place where it begins.
                Segment::Arc(arc) if arc.is_full_turn() => {
                    round.circle = Some((arc.center, arc.radius));
                    for quarter in 0..4 {
                        let share = f64::from(quarter) / 4.0;
                        let segment = Segment::Arc(arc).part(share, share + 0.25);
                        round.push(segment, source);
                    }
                }
                segment => round.push(segment, source),
            }
        }
        let segments = round.pieces.iter().map(|piece| &piece.segment);
        round.circle = round.circle.or_else(|| circle(segments));
        let number = self.rounds.len() as u32;
        self.leads.take();
        self.radii.take();
        self.index.reserve(round.pieces.len());
        for (index, piece) in round.pieces.iter().enumerate() {
            self.index
                .insert((number, index as u32), piece.segment.bounds());
        }
        if !round.pieces.is_empty() {
            self.rounds.push(round);
        }
    }

    pub(super) fn piece(&self, spot: &Spot) -> &Piece {
        &self.rounds[spot.round].pieces[spot.piece]
    }

    /// A piece in the direction of a spot's way.
    pub(super) fn whole(&self, spot: &Spot) -> Segment {
        let piece = self.piece(spot);
        if spot.back { piece.back } else { piece.segment }
    }

    /// The rest of a spot's piece from it on.
    pub(super) fn rest(&self, spot: &Spot) -> Segment {
        let whole = self.whole(spot);
        if whole.start() == spot.at {
            return whole;
        }
        let share = whole.share_of(spot.at).clamp(0.0, 1.0);
        match whole.part(share, 1.0) {
            Segment::Line(line) => Segment::line(spot.at, line.end),
            arc => arc,
        }
    }

    /// Where the next piece begins; `None` at the end of an open round.
    pub(super) fn next(&self, spot: &Spot) -> Option<Spot> {
        let round = &self.rounds[spot.round];
        let count = round.pieces.len();
        let piece = match (spot.back, spot.piece) {
            (false, piece) if piece + 1 < count => piece + 1,
            (true, piece) if piece > 0 => piece - 1,
            _ if !round.closed => return None,
            (false, _) => 0,
            (true, _) => count - 1,
        };
        Some(self.at_begin(spot.round, piece, spot.back))
    }

    /// Where the piece before one begins; `None` at the beginning of an open round.
    pub(super) fn before(&self, spot: &Spot) -> Option<Spot> {
        let back = self.next(&Spot {
            back: !spot.back,
            ..*spot
        })?;
        Some(self.at_begin(back.round, back.piece, spot.back))
    }

    /// The spot at the beginning of a piece, seen in its way.
    pub(crate) fn at_begin(&self, round: usize, piece: usize, back: bool) -> Spot {
        let piece_of = &self.rounds[round].pieces[piece];
        let at = if back {
            piece_of.back.start()
        } else {
            piece_of.segment.start()
        };
        Spot {
            round,
            piece,
            back,
            at,
        }
    }

    /// A spot at the beginning of a piece, not within it.
    pub(crate) fn is_begin(&self, spot: &Spot) -> bool {
        *spot == self.at_begin(spot.round, spot.piece, spot.back)
    }

    /// How far a spot lies along its round, µm.
    pub(super) fn along(&self, spot: &Spot) -> f64 {
        let piece = self.piece(spot);
        let share = match &piece.segment {
            segment if segment.start() == spot.at => 0.0,
            segment if segment.end() == spot.at => 1.0,
            segment => segment.share_of(spot.at).clamp(0.0, 1.0),
        };
        piece.before + share * piece.segment.length()
    }

    /// The distance of one spot of a round ahead of another on its way, µm.
    pub(crate) fn ahead(&self, from: &Spot, to: &Spot) -> f64 {
        let way = self.along(to) - self.along(from);
        let way = if from.back { -way } else { way };
        way.rem_euclid(self.rounds[from.round].length)
    }

    /// The stretches of a round that are cut by going this far from a spot.
    pub(crate) fn cover(&self, from: &Spot, length: f64, mut cut: impl FnMut(Range<f64>)) {
        let whole = self.rounds[from.round].length;
        let along = self.along(from);
        let (begin, end) = if from.back {
            (along - length, along)
        } else {
            (along, along + length)
        };
        if begin < -1e-9 {
            cut(0.0..end);
            cut(begin + whole..whole);
        } else if end > whole + 1e-9 {
            cut(begin..whole);
            cut(0.0..(end - whole).min(whole));
        } else {
            cut(begin..end);
        }
    }

    /// The distance by which 4B moves a contour that begins at a spot, µm; `None` where the wire runs as written.
    pub(super) fn beside(&self, spot: &Spot) -> Option<Vector> {
        let round = &self.rounds[spot.round];
        let segment = &round.pieces[spot.piece].segment;
        let tangent = segment.tangent_at(segment.share_of(spot.at).clamp(0.0, 1.0));
        Some(left_normal(tangent) * round.beside?)
    }

    /// Spots from which 4B begins at a point, in either direction, and the vector by which it moves the contour there.
    pub(crate) fn near_beside(&self, point: Point, reach: f64) -> Vec<(Spot, Vector)> {
        let all = self.rounds.iter().filter_map(|round| round.beside);
        let farthest = all.map(f64::abs).fold(0.0, f64::max) + reach;
        let mut found = Vec::new();
        self.index
            .near(&Bounds::of_disc(point, farthest), |(round, piece), _| {
                let (round, piece) = (round as usize, piece as usize);
                let segment = &self.rounds[round].pieces[piece].segment;
                let share = segment.share_of(point);
                if !(0.0..=1.0).contains(&share) {
                    return;
                }
                let at = segment.point_at(share);
                for back in [false, true] {
                    let spot = Spot {
                        round,
                        piece,
                        back,
                        at,
                    };
                    let by = self.beside(&spot);
                    let by = by.filter(|by| (at + by - point).norm() <= reach);
                    found.extend(by.map(|by| (spot, by)));
                }
            });
        found.sort_by_key(|(spot, _)| (spot.round, spot.piece, spot.back));
        found
    }

    /// Spots within reach of a point, in either way.
    pub(super) fn near(&self, point: Point, reach: f64) -> Vec<Spot> {
        let mut found = Vec::new();
        self.index
            .near(&Bounds::of_disc(point, reach), |(round, piece), _| {
                let (round, piece) = (round as usize, piece as usize);
                let own = &self.rounds[round].pieces[piece];
                if own.segment.distance_to(point) > reach {
                    return;
                }
                for back in [false, true] {
                    let way = if back { own.back } else { own.segment };
                    let share = way.share_of(point).clamp(0.0, 1.0);
                    let at = match share * way.length() {
                        begin if begin <= reach => way.start(),
                        // The rest is no way.
                        end if way.length() - end <= reach => continue,
                        _ => way.point_at(share),
                    };
                    found.push(Spot {
                        round,
                        piece,
                        back,
                        at,
                    });
                }
            });
        found.sort_by_key(|spot| (spot.round, spot.piece, spot.back));
        found
    }
}

impl Round {
    fn push(&mut self, segment: Segment, source: Option<(EntityId, usize)>) {
        let length = segment.length();
        if length > CRUMB {
            self.pieces.push(Piece {
                segment,
                back: segment.reversed(),
                source,
                before: self.length,
            });
            self.length += length;
        }
    }
}

/// The ways of some courses on one side of a contour, in the drawing's unit.
fn along(
    contour: &Contour,
    side: Side,
    courses: &[Course],
    drawn: &Drawn,
) -> Vec<Vec<PathSegment>> {
    let settings = &*drawn.settings;
    let has_side = contour.closed || contour.side.is_some();
    let (mut ways, mut corrections) = (Vec::new(), Vec::new());
    for course in courses {
        match course {
            Course::Drawn => ways.push(joined(own(contour), contour.closed)),
            Course::FourB if has_side => ways.extend(of_four_b(
                joined(own(contour), contour.closed),
                (side, contour.closed),
                settings,
                drawn.unit_mm,
            )),
            Course::Beside(mm) if *mm > 0.0 => corrections.push(*mm),
            Course::Beside(_) | Course::FourB => {}
        }
    }
    if !corrections.is_empty() && has_side {
        let of_path = Effective {
            compensation: Compensation::Path,
            ..settings.clone()
        };
        let rounds = toolpath::rounds(
            &contour.segments,
            (side, contour.closed),
            &corrections,
            &of_path,
            drawn.unit_mm,
        );
        ways.extend(rounds.into_iter().flatten());
    }
    ways
}

/// The contour itself, in the drawing's unit.
fn own(contour: &Contour) -> Vec<PathSegment> {
    let segments = contour.segments.iter().map(|segment| PathSegment {
        geometry: segment.geometry,
        source: Source::Segment {
            entity: segment.entity,
            segment: segment.segment,
        },
    });
    segments.collect()
}

/// A circle that is drawn as one arc comes back to its start.
fn joined(mut path: Vec<PathSegment>, closed: bool) -> Vec<PathSegment> {
    if let [only] = &mut path[..]
        && let Segment::Arc(arc) = only.geometry
        && closed
    {
        only.geometry = Segment::Arc(Arc::about(
            arc.center,
            arc.start,
            arc.start,
            arc.sweep > 0.0,
        ));
    }
    path
}

/// The part's contour with the transitions of 4B, in the drawing's unit; none where it cannot be written.
fn of_four_b(
    mut path: Vec<PathSegment>,
    (side, closed): (Side, bool),
    settings: &Effective,
    unit_mm: f64,
) -> Option<Vec<PathSegment>> {
    let first = *path.first()?;
    if closed {
        // It may not begin in a corner.
        path[0].geometry = first.geometry.part(0.5, 1.0);
        path.push(PathSegment {
            geometry: first.geometry.part(0.0, 0.5),
            ..first
        });
    }
    crate::program::three_b::of_part(path, side, settings, unit_mm)
}
