//! The control, as far as geometry goes: the modal state, the wire's position, and the move of each line.

use super::block::{Block, Compensation, Corner, Motion, Register, Stop};
use super::variables::Variables;
use super::word::Number;
use crate::finding::Side;

use super::moves::{
    Bend, CenterRule, Course, Move, Place, Reading, added, apart, bend_about, nanometres,
};

/// The modal state, and the wire's position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Machine {
    /// The wire's position, nm.
    pub(crate) at: Place,
    /// The zero of the program's coordinates: G92 moves it.
    pub(crate) zero: Place,
    /// The position is unknown, since a coordinate could not be read.
    pub(crate) lost: [bool; 2],
    /// It was unknown at some time since the last rapid or stop.
    pub(crate) torn: bool,
    pub(crate) motion: Motion,
    pub(crate) incremental: bool,
    /// G90.1 or G91.1 is in force.
    pub(crate) center: Option<CenterRule>,
    pub(crate) inch: bool,
    pub(crate) side: Option<Side>,
    pub(crate) offset: Option<Register>,
    /// The last G40, G41 or G42 has not been followed by a move yet.
    pub(crate) switches: Option<bool>,
    /// The wire has moved since the beginning or the last stop.
    pub(crate) moved: bool,
    /// The kind of the last action.
    pub(crate) behind: Behind,
    /// G92 has set the position.
    pub(crate) stated: bool,
    pub(crate) ended: bool,
    /// An electrode has been fed downwards: it mills layer by layer, and no wire cuts.
    pub(crate) mills: bool,
    /// The corner after the last move was cut off: the distance of the next move's start from its sharp point.
    pub(crate) cut_short: Option<Place>,
    /// What the lines so far say of the control's variables.
    pub(crate) variables: Variables,
    /// A mark by which a line that repeats the last cut is recognised; 0 where a stop or a rapid stands between.
    pub(crate) said: u64,
}

/// The last action of a program that moves or stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Behind {
    /// Nothing of the following.
    #[default]
    Rest,
    Cut,
    /// A stop after a cut.
    Stop,
}

/// The effect of a line that moves the wire.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steered {
    /// As its words say: from the sharp corner, where the one before it is cut off.
    pub(crate) said: Move,
    /// The distance of its start from there.
    cut_short: Option<Place>,
}

impl Steered {
    /// The move that the wire makes.
    pub(crate) fn made(&self, reading: &Reading) -> Move {
        let Some(by) = self.cut_short else {
            return self.said;
        };
        let mut made = self.said;
        // The words of an arc count from the sharp corner.
        if let Course::Arc(arc) = made.course(reading) {
            let center = match made.center(reading.rule(made.incremental)) {
                Some(center) => center,
                None => nanometres(arc.center.coords),
            };
            made.bend = bend_about(center, added(made.from, by), made.incremental, reading);
        }
        made.from = added(made.from, by);
        made
    }
}

/// A line that runs, and its effect.
pub(super) struct Ran<'a> {
    pub(super) line: usize,
    pub(super) block: &'a Block,
    /// What the lines before it say of the control's variables.
    pub(super) variables: Variables,
    /// Its move, and the corner that the control makes at its end.
    pub(super) made: [Option<Move>; 2],
    /// The state after it.
    pub(super) machine: &'a Machine,
}

impl Ran<'_> {
    pub(super) fn moves(&self) -> impl Iterator<Item = Move> {
        self.made.into_iter().flatten()
    }

    /// A step for each move, and one for a stop.
    pub(super) fn step_count(&self) -> usize {
        self.moves().count() + usize::from(self.block.stop.is_some())
    }
}

impl Machine {
    /// Executes a line. Returns its move; none where the wire stands still, or its position is unknown.
    pub(crate) fn run(&mut self, block: &Block, reading: &Reading) -> Option<Move> {
        self.steer(block, reading)
            .map(|steered| steered.made(reading))
    }

    /// The same; returns the move as its words say it, and where it begins.
    pub(crate) fn steer(&mut self, block: &Block, reading: &Reading) -> Option<Steered> {
        self.inch = block.inch.unwrap_or(self.inch);
        // Whether a line is followed depends on its words alone, not on where the wire is.
        let is_unread = block.broken || self.leads_too_far(block, reading).is_some();
        if let Some(incremental) = block.incremental {
            self.incremental = incremental;
        }
        self.center = block.center.or(self.center);
        if let Some(motion) = block.motion {
            self.motion = motion;
        }
        if let Some(offset) = block.offset {
            self.offset = Some(offset);
        }
        if let Some(compensation) = block.compensation {
            let side = match compensation {
                Compensation::Off => None,
                Compensation::Left => Some(Side::Left),
                Compensation::Right => Some(Side::Right),
            };
            if side != self.side {
                self.switches = Some(side.is_some());
            }
            self.side = side;
        }
        let feeds_down = block.z.is_some_and(|z| z.mantissa < 0) && self.motion != Motion::Rapid;
        self.mills |= feeds_down && !block.sets_position && !block.takes_coordinates;
        let moved = if block.sets_position {
            self.set_position(block, reading, is_unread);
            None
        } else {
            self.travel(block, reading, is_unread)
        };
        self.behind = match (&moved, self.behind) {
            (Some(moved), _) if moved.said.is_cut() => Behind::Cut,
            (Some(_), _) => Behind::Rest,
            (None, behind) => behind,
        };
        if block.stop.is_some() && self.behind == Behind::Cut {
            self.behind = Behind::Stop;
        }
        match block.stop {
            Some(Stop::End) => self.ended = true,
            Some(Stop::Pause) => self.moved = false,
            None => {}
        }
        let parts = block.stop.is_some() || moved.is_some_and(|moved| !moved.said.is_cut());
        self.torn = self.lost != [false, false] || (self.torn && !parts);
        moved
    }

    /// The letter of the line's first word of the wire's way (X, Y, I, J, R, a corner) whose length, in the units of this
    /// state or its own, is more than [`FARTHEST`].
    pub(super) fn leads_too_far(&self, block: &Block, reading: &Reading) -> Option<char> {
        if block.takes_coordinates {
            return None;
        }
        let inch = block.inch.unwrap_or(self.inch);
        let words = [
            ('X', block.x),
            ('Y', block.y),
            ('I', block.i),
            ('J', block.j),
            ('R', block.r),
        ];
        let words = words
            .into_iter()
            .filter_map(|(letter, number)| Some((letter, number?)));
        let corner = block
            .corner
            .map(|corner| (if corner.round { 'R' } else { 'C' }, corner.size));
        words
            .chain(corner)
            .find(|(_, number)| reading.is_too_far(*number, inch))
            .map(|(letter, _)| letter)
    }

    /// G92. At the beginning, and where the wire has not moved since a stop, it sets the wire's position: the wire was
    /// taken there by hand. Else the wire stays where it is and the zero moves.
    fn set_position(&mut self, block: &Block, reading: &Reading, is_unread: bool) {
        if is_unread && !block.broken {
            self.lost = [true, true];
            return;
        }
        for (axis, number) in [block.x, block.y].into_iter().enumerate() {
            if let Some(number) = number {
                let stated = reading.length(number, self.inch);
                self.stated = true;
                if self.moved && !self.lost[axis] {
                    self.zero[axis] = self.at[axis].wrapping_sub(stated);
                } else {
                    self.at[axis] = self.zero[axis].wrapping_add(stated);
                    self.lost[axis] = false;
                }
            }
        }
        if block.broken {
            self.lost = [true, true];
        }
    }

    /// How an arc from a place runs about the centre of its I and J: as G90.1 or G91.1 has them, else as those of the
    /// program are read.
    fn bend(&self, from: Place, words: [Option<i64>; 2], reading: &Reading) -> Bend {
        let along = words.map(|word| word.unwrap_or(0));
        // An omitted coordinate of an absolute centre is that of the start.
        let absolute: Place = std::array::from_fn(|axis| match words[axis] {
            Some(at) => self.zero[axis].wrapping_add(at),
            None => from[axis],
        });
        let center = match self.center {
            Some(stated) if stated != reading.rule(self.incremental) => match stated {
                CenterRule::StartToCenter => added(from, along),
                CenterRule::CenterToStart => apart(from, along),
                CenterRule::Absolute => absolute,
            },
            _ => {
                let [i, j] = along;
                let absolute = if self.incremental { [0, 0] } else { absolute };
                return Bend::Center { i, j, absolute };
            }
        };
        bend_about(center, from, self.incremental, reading)
    }

    fn travel(&mut self, block: &Block, reading: &Reading, is_unread: bool) -> Option<Steered> {
        if block.takes_coordinates {
            return None;
        }
        if is_unread {
            self.lost = [true, true];
        }
        let is_arc = self.motion.is_arc();
        let full_circle = is_arc && block.has_center();
        if !block.has_coordinates() && !full_circle {
            return None;
        }
        let length =
            |number: Option<Number>| number.map(|number| reading.length(number, self.inch));
        let from = self.at;
        let cut_short = self.cut_short.take();
        let mut to = from;
        let mut found = self.lost;
        let coordinates = match is_unread && !block.broken {
            true => [None; 2],
            false => [length(block.x), length(block.y)],
        };
        for (axis, coordinate) in coordinates.into_iter().enumerate() {
            match coordinate {
                Some(by) if self.incremental => to[axis] = from[axis].wrapping_add(by),
                Some(at) => {
                    to[axis] = self.zero[axis].wrapping_add(at);
                    found[axis] = false;
                }
                None => {}
            }
        }
        let was_lost = self.lost != [false, false];
        self.lost = if is_unread { [true, true] } else { found };
        self.at = to;
        self.moved = true;
        let switches = self.switches.take();
        if was_lost || is_unread {
            return None;
        }
        let bend = match (length(block.i), length(block.j), length(block.r)) {
            (None, None, Some(radius)) => Bend::Radius(radius),
            (None, None, None) => Bend::Nothing,
            // An omitted coordinate of an absolute centre is that of the start.
            (i, j, _) => self.bend(from, [i, j], reading),
        };
        let bend = if is_arc { bend } else { Bend::Nothing };
        let corner = match self.motion {
            Motion::Rapid => None,
            Motion::Line => block
                .corner
                .or(block.r.map(|size| Corner { round: true, size })),
            Motion::Clockwise | Motion::CounterClockwise => block.corner,
        };
        let (incremental, side, offset) = (self.incremental, self.side, self.offset);
        let said = Move {
            motion: self.motion,
            from,
            to,
            bend,
            incremental,
            side,
            offset,
            switches,
            corner,
        };
        Some(Steered { said, cut_short })
    }
}

/// Lines with an equal move have an equal mark, whatever their number.
pub(super) fn mark_of(block: &Block, made: &Move) -> u64 {
    let numbers = [
        block.x,
        block.y,
        block.i,
        block.j,
        block.r,
        block.corner.map(|corner| corner.size),
    ];
    numbers
        .into_iter()
        .fold(1 + made.motion as u64, |mark, number| match number {
            Some(number) => mixed(
                mark,
                number.mantissa as u64 ^ u64::from(number.decimals) << 56,
            ),
            None => mixed(mark, 1 << 55),
        })
}

/// The mark of something with one more field.
fn mixed(mark: u64, field: u64) -> u64 {
    (mark ^ field)
        .wrapping_mul(0x2545_f491_4f6c_dd1d)
        .rotate_left(23)
}
