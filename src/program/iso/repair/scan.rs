//! Weighs the evidence against a way, move by move: faults and oddities.

pub(crate) use super::against::Against;
pub(crate) use super::line::Line;
use crate::geometry::{Segment, Vector};
use crate::program::iso::block::{Block, Motion, Stop};
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Bend, Course, Move, Place, Reading, added, apart, distance};
use crate::program::iso::shape::directions;
use crate::program::path::{BACK, CLEAR, ROUNDING, TANGENT, tolerance, turn};

/// From this turn on a line lies on the one before, radians; below it, it may be a way out close beside that.
const ON_ITSELF: f64 = 3.139;

/// The cut that is under way.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CutUnderWay {
    start: Place,
    /// Where its first move ends.
    entered: Place,
    moves: u32,
    arcs: u32,
    last: Move,
    /// The direction of the last move at its end.
    heading: Option<Vector>,
    /// All of it could be read.
    whole: bool,
    /// The last line went back close beside the one before: a spur where another one follows, and else the way out.
    turned_back: bool,
}

/// A way as far as it has been run.
#[derive(Clone, Copy, Debug)]
struct Scan {
    machine: Machine,
    against: Against,
    cut: Option<CutUnderWay>,
    torn: bool,
    said: Option<Block>,
}

/// The last move of a cut that has ended, and the cost of its closing.
#[derive(Clone, Copy, Debug)]
struct End {
    from: Place,
    to: Place,
    cost: Against,
}

/// The lines of a cut with the state and the evidence before each.
pub(crate) struct Scanned<'a> {
    pub(crate) reading: &'a Reading,
    pub(crate) lines: Vec<Line>,
    /// Before each line, and after the last.
    before: Vec<Scan>,
    /// The end of the present cut before each line.
    ends: Vec<Option<End>>,
    /// From this line on nothing depends on the wire's position.
    loose_from: usize,
}

impl<'a> Scanned<'a> {
    pub(crate) fn new(reading: &'a Reading, lines: Vec<Line>, machine: Machine) -> Scanned<'a> {
        let mut scan = Scan {
            machine,
            against: Against::default(),
            cut: None,
            torn: false,
            said: None,
        };
        let mut before = Vec::with_capacity(lines.len() + 1);
        let mut ends: Vec<Option<End>> = vec![None; lines.len() + 1];
        let mut loose_from = 0;
        let mut begun = 0;
        for (index, line) in lines.iter().enumerate() {
            before.push(scan);
            let cut = scan.cut;
            let ended = scan.step(line, reading);
            if let Some(end) = ended {
                ends[begun..=index].fill(Some(end));
            }
            if scan.cut.is_none() || (cut.is_none() && scan.cut.is_some()) {
                begun = index + 1;
            }
            if (line.block.has_coordinates() && !scan.machine.incremental)
                || line.block.sets_position
            {
                loose_from = index + 1;
            }
        }
        if let Some(end) = scan.finish(reading) {
            ends[begun..].fill(Some(end));
        }
        before.push(scan);
        Scanned {
            reading,
            lines,
            before,
            ends,
            loose_from,
        }
    }

    /// All evidence against the way.
    pub(crate) fn total(&self) -> Against {
        self.before[self.lines.len()].against
    }

    /// The direction at the end of the last move of the present cut before a line.
    pub(crate) fn heading_before(&self, index: usize) -> Option<Vector> {
        self.before[index].cut.and_then(|cut| cut.heading)
    }

    pub(crate) fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.lines.iter().map(|line| &line.block)
    }

    pub(crate) fn machine_before(&self, index: usize) -> &Machine {
        &self.before[index].machine
    }

    /// The evidence against the way with other lines in place of `count` ones, and how many lines were run for it.
    pub(crate) fn with(&self, index: usize, count: usize, lines: &[Line]) -> (Against, usize) {
        let mut scan = self.before[index];
        let mut runs = 0;
        for line in lines {
            scan.step(line, self.reading);
            runs += 1;
        }
        for at in index + count..self.lines.len() {
            if let Some(total) = self.rest(&scan, at) {
                return (total, runs);
            }
            scan.step(&self.lines[at], self.reading);
            runs += 1;
        }
        scan.finish(self.reading);
        (scan.against, runs)
    }

    /// The total, where from a line on everything is as before, or only moved.
    fn rest(&self, scan: &Scan, at: usize) -> Option<Against> {
        let known = &self.before[at];
        let by = apart(scan.machine.at, known.machine.at);
        if by != [0, 0] && at < self.loose_from {
            return None;
        }
        if (Machine {
            at: known.machine.at,
            ..scan.machine
        }) != known.machine
            || scan.torn != known.torn
            || scan.said != known.said
        {
            return None;
        }
        let whole = scan.against.plus(self.total().minus(known.against));
        match (&scan.cut, &known.cut) {
            (None, None) => Some(whole),
            (Some(own), Some(its)) => {
                let is_alike = own.last.seen_from(own.last.to) == its.last.seen_from(its.last.to)
                    || own.heading == its.heading;
                let is_alike = is_alike && own.turned_back == its.turned_back;
                if !is_alike || own.whole != its.whole || own.moves < 2 || its.moves < 2 {
                    return None;
                }
                let end = self.ends[at]?;
                let [from, to] = [end.from, end.to].map(|place| added(place, by));
                let open = against_end(own, from, to, self.reading);
                Some(whole.plus(open).minus(end.cost))
            }
            _ => None,
        }
    }

    /// From the end of a line's cut to its closing point: its beginning, or the end of its way in; none where it
    /// closes.
    pub(crate) fn gaps(&self, index: usize) -> Vec<Place> {
        let Some((end, cut)) =
            self.ends[index].zip(self.before[index].cut.or(self.before[index + 1].cut))
        else {
            return Vec::new();
        };
        if end.cost.open == 0 {
            return Vec::new();
        }
        vec![
            apart(cut.start, end.to),
            apart(cut.entered, end.to),
            apart(cut.entered, end.from),
        ]
    }

    /// All moves with a length, with other lines in place of `count` ones, each relative to its centre or with its
    /// radius: equal ways are equal here.
    pub(crate) fn moves_with(&self, index: usize, count: usize, lines: &[Line]) -> Vec<Move> {
        let alike = |made: Move| Move {
            bend: match made.center(self.reading.rule(made.incremental)) {
                Some(absolute) => Bend::Center {
                    i: 0,
                    j: 0,
                    absolute,
                },
                None => made.bend,
            },
            incremental: false,
            offset: None,
            switches: None,
            corner: None,
            ..made
        };
        let leads = |made: &Move| made.from != made.to || made.is_arc();
        let moves = self.run_with(index, count, lines);
        moves.filter(leads).map(alike).collect()
    }

    /// Nothing but that so few straight cuts do not close, which is as well a part that is parted off: nearly any change would close
    /// them.
    pub(crate) fn tells_too_little(&self) -> bool {
        const FEWEST: usize = 4;
        let cuts = self.run_with(0, 0, &[]).filter(Move::is_cut);
        let cuts: Vec<Move> = cuts.take(FEWEST).collect();
        let total = self.total();
        cuts.len() < FEWEST && !cuts.iter().any(Move::is_arc) && total.hard == total.open
    }

    /// The pieces that are cut, with other lines in place of `count` ones, µm. An arc that cannot be is left out.
    pub(crate) fn pieces_with(&self, index: usize, count: usize, lines: &[Line]) -> Vec<Segment> {
        self.run_with(index, count, lines)
            .filter(|made| made.is_cut() && made.goes_anywhere())
            .filter_map(|made| made.curve(self.reading))
            .collect()
    }

    /// All moves, with other lines in place of `count` ones.
    fn run_with<'b>(
        &'b self,
        index: usize,
        count: usize,
        lines: &'b [Line],
    ) -> impl Iterator<Item = Move> + use<'a, 'b> {
        let mut machine = self.before[0].machine;
        let all = self.lines[..index]
            .iter()
            .chain(lines)
            .chain(&self.lines[(index + count).min(self.lines.len())..]);
        all.filter_map(move |line| machine.run(&line.block, self.reading))
    }
}

impl Scan {
    /// Runs a line; returns the end of the cut that ends with it.
    fn step(&mut self, line: &Line, reading: &Reading) -> Option<End> {
        self.against.hard += line.faults;
        let block = &line.block;
        let made = self.machine.run(block, reading);
        if block.has_stray_center(self.machine.motion) {
            self.against.hard += 1;
        }
        let mut ended = None;
        match made {
            Some(made) if !made.is_cut() => ended = self.finish(reading),
            Some(made) => self.cut(&made, block, reading),
            None if self.machine.torn => {
                if let Some(cut) = &mut self.cut {
                    cut.whole = false;
                }
                self.torn = true;
            }
            None => {}
        }
        if block.stop.is_some() {
            let end = self.finish(reading);
            ended = ended.or(end);
            if block.stop == Some(Stop::End) && self.machine.side.is_some() {
                self.against.hard += 1;
            }
        }
        ended
    }

    fn cut(&mut self, made: &Move, block: &Block, reading: &Reading) {
        let is_again = self.said.replace(*block) == Some(*block);
        if !made.goes_anywhere() {
            self.against.soft += 4.0;
            return;
        }
        if is_again && !made.incremental {
            self.against.hard += 1;
        } else if is_again {
            self.against.soft += 1.5;
        }
        if let Some(cut) = &mut self.cut
            && std::mem::take(&mut cut.turned_back)
        {
            self.against.hard += 1;
            self.against.slits += 1;
        }
        let begins = self.cut.as_ref().map(|cut| (cut.last, cut.heading));
        let mut heading = None;
        let mut slack = TANGENT;
        // Controls switch the correction on straight cuts alone.
        self.against.hard += u32::from(made.is_arc() && made.switches.is_some());
        match made.course(reading) {
            Course::Line => self.against.soft += slant(made),
            Course::Arc(arc) => {
                slack += ROUNDING / arc.radius;
                let miss = made
                    .center(reading.rule(made.incremental))
                    .map_or(0.0, |center| {
                        (distance(made.from, center) - distance(made.to, center)).abs()
                    });
                self.against.vague += (miss / 1e3).min(3.0) * 0.6;
            }
            course @ (Course::OffRadius { .. } | Course::NoRadius) => {
                self.against.hard += 1;
                self.against.radiusless += u32::from(matches!(course, Course::NoRadius));
            }
        }
        if let Some((start, end)) = directions(made, reading) {
            heading = Some(end);
            if let Some((last, Some(before))) = begins {
                self.joint(&last, before, made, start, slack, reading);
            }
        }
        if made.motion == Motion::Rapid {
            return;
        }
        match &mut self.cut {
            Some(cut) => {
                if let (Some(one), Some(other)) = (cut.last.side, made.side)
                    && one != other
                {
                    self.against.hard += 1;
                }
                cut.moves += 1;
                cut.arcs += u32::from(made.is_arc());
                (cut.last, cut.heading) = (*made, heading);
            }
            None => {
                let whole = !std::mem::take(&mut self.torn);
                let (start, entered, arcs) = (made.from, made.to, u32::from(made.is_arc()));
                self.cut = Some(CutUnderWay {
                    start,
                    entered,
                    moves: 1,
                    arcs,
                    last: *made,
                    heading,
                    whole,
                    turned_back: false,
                });
            }
        }
    }

    /// The evidence against the joint of two moves.
    fn joint(
        &mut self,
        last: &Move,
        before: Vector,
        made: &Move,
        start: Vector,
        slack: f64,
        reading: &Reading,
    ) {
        let turned = turn(before, start);
        let has_arc = made.is_arc() || last.is_arc();
        // Two lines do so, an arc may, and a way in goes out and in.
        let is_way_in = self.cut.as_ref().is_some_and(|cut| cut.moves == 1);
        let is_lead = made.switches.is_some() || last.switches.is_some();
        let is_on_itself = turned > ON_ITSELF;
        if turned > BACK && (has_arc || is_way_in || is_lead && !is_on_itself) {
            self.against.back += 1;
            self.against.soft += 1.2;
            self.against.vague += 3.8;
            return;
        }
        if turned > BACK {
            match &mut self.cut {
                Some(cut) if !is_on_itself => cut.turned_back = true,
                _ => {
                    self.against.hard += 1;
                    self.against.slits += 1;
                }
            }
            return;
        }
        let slack = match last.center(reading.rule(last.incremental)) {
            Some(center) if last.is_arc() => {
                slack + ROUNDING * 1e3 / distance(last.from, center).max(1.0)
            }
            _ => slack,
        };
        // A joint that is tangent to an arc may be so by chance, two are meant.
        let (soft, vague) = match (has_arc, turned) {
            (_, turned) if turned < slack => (0.0, 0.0),
            (true, turned) if turned < CLEAR => (1.2, 3.8),
            (true, _) => (1.2, 1.8),
            (false, turned) if turned < 0.05 => (0.0, 3.0),
            (false, _) => (0.0, 0.0),
        };
        self.against.soft += soft;
        self.against.vague += vague;
    }

    /// Ends the cut that is under way.
    fn finish(&mut self, reading: &Reading) -> Option<End> {
        let cut = self.cut.take();
        self.torn = false;
        self.said = None;
        let cut = cut?;
        let (from, to) = (cut.last.from, cut.last.to);
        let cost = against_end(&cut, from, to, reading);
        self.against = self.against.plus(cost);
        Some(End { from, to, cost })
    }
}

/// The evidence against a cut that ends with a move. Whether it closes in the end is asked of [`crate::program::path`];
/// this weighs thousands of ways by their ends alone, the way out before the thread hole among them.
fn against_end(cut: &CutUnderWay, from: Place, to: Place, reading: &Reading) -> Against {
    if !cut.whole {
        return Against::default();
    }
    let is_unlike = cut.moves > 3 && apart(to, from) != apart(cut.start, cut.entered);
    let unlike = u32::from(is_unlike);
    let pairs = [
        (cut.start, to),
        (cut.entered, to),
        (cut.start, from),
        (cut.entered, from),
    ];
    let taken = if cut.moves > 2 { 4 } else { 1 };
    let missed = pairs
        .into_iter()
        .take(taken)
        .map(|(begin, end)| distance(begin, end))
        .fold(f64::INFINITY, f64::min);
    let tolerance = (1_000.0 * tolerance(cut.arcs as usize)).max(reading.tolerance as f64);
    if missed > tolerance {
        return Against {
            hard: 1,
            soft: 0.0,
            open: 1,
            unlike,
            ..Against::default()
        };
    }
    // A program is written so that it closes to the last digit, and returns to the thread hole.
    let is_beside = distance(cut.start, to) > tolerance;
    let odd = |is_odd: bool| if is_odd { 2.0 } else { 0.0 };
    let soft = odd(missed > 0.0) + odd(is_beside) + odd(is_unlike);
    Against {
        hard: 0,
        soft,
        open: 0,
        beside: u32::from(is_beside),
        unlike,
        ..Against::default()
    }
}

/// A line that is not along an axis is odder than one that is: how much it leans says nothing of what was meant.
fn slant(made: &Move) -> f64 {
    let is_along = apart(made.to, made.from).contains(&0);
    if is_along { 0.0 } else { 1.0 }
}
