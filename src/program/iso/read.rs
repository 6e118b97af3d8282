//! Runs lines: the meaning of each, the state after it, and its faults.

#![warn(clippy::indexing_slicing)]

use super::ahead::Ahead;
pub(crate) use super::ahead::Lines;
use super::block::{Block, Note, Stop, read_under};
use super::corner::{self, Turned, turned};
use super::evidence::FEW_BARE;
use super::machine::{Behind, Machine, Trail, mark_of};
use super::moves::{Course, Move, Reading, added, apart};
use super::part::{Hears, Part, SEVERAL, Spur, Tight, Ways};
use super::shape::Shape;
use super::stretch::{Definition, Foreign, Pathless, Stretch};
use crate::finding::{Fault, Finding, Rule};
use crate::geometry::Side;
use crate::program::path::joint;
use std::f64::consts::PI;
use std::ops::Range;

/// Arcs with a larger radius are not kept: no correction comes near, nm.
const LARGEST_CORRECTION: f64 = 5e6;

impl Stretch {
    /// Runs the first `count` of `lines`, each with the byte at which it begins, counted from `start`; the lines after
    /// complete the last of them.
    pub(crate) fn run<'a>(
        lines: impl Lines<'a>,
        count: usize,
        start: usize,
        before: Machine,
        reading: Reading,
    ) -> Pathless {
        let mut ways: Vec<Ways> = Vec::new();
        let stretch = Stretch::run_with(
            lines,
            count,
            start,
            before,
            reading,
            &mut |part, step, _| {
                if ways.len() <= part {
                    ways.resize_with(part + 1, Ways::default);
                }
                if let Some(way) = ways.get_mut(part) {
                    way.push(*step);
                }
            },
        );
        Pathless { stretch, ways }
    }

    /// The same without paths; `each` gets every move of a part.
    pub(crate) fn run_with<'a>(
        mut lines: impl Lines<'a>,
        count: usize,
        start: usize,
        before: Machine,
        reading: Reading,
        each: &mut Hears<'_>,
    ) -> Stretch {
        let mut stretch = Stretch {
            before,
            after: before,
            reading,
            numbers_rise: true,
            is_fresh: true,
            ..Stretch::default()
        };
        for left in (0..count).rev() {
            let Some((offset, line)) = lines.next() else {
                break;
            };
            let known = stretch.faults.len();
            stretch.line(
                line,
                offset - start,
                &Ahead {
                    lines: &lines,
                    left,
                },
                each,
            );
            if stretch.faults.len() > known {
                stretch.mark_fault();
            }
        }
        stretch
    }

    /// The block of a line, whether the wire's upper end may go elsewhere than before, and whether a length stands in a
    /// word beside the wire's way.
    fn block(&mut self, line: &[u8], offset: usize) -> (Block, bool, bool) {
        let Stretch {
            faults,
            foreign,
            definitions,
            lengths,
            after,
            evidence,
            ..
        } = &mut *self;
        let (inch, known_faults) = (after.inch, faults.len());
        let (mut leans, mut measures, mut is_unread) = (false, false, false);
        let block = read_under(&mut after.variables, line, offset, |note| match note {
            Note::Fault { fault, range } => {
                // One of a kind is enough for a line: the others may follow from it.
                let is_new = match fault.is_read() {
                    true => faults.len() == known_faults,
                    false => !std::mem::replace(&mut is_unread, true),
                };
                if is_new {
                    faults.push(fault.finding(line, range.start - offset, range));
                }
            }
            Note::Foreign { code, range } => {
                leans |= code.tilts();
                measures |= code.measures();
                match foreign.iter_mut().find(|word| word.code == code) {
                    Some(word) => word.count += 1,
                    None => foreign.push(Foreign {
                        code,
                        range: pair(range),
                        count: 1,
                    }),
                }
            }
            Note::Definition {
                offset,
                terms,
                range,
            } => {
                evidence.correction(&terms);
                let range = pair(range);
                definitions.push(Definition {
                    offset,
                    terms,
                    inch,
                    range,
                });
            }
            Note::Length { pointed, range } => {
                let [bare, with_point] = &mut *lengths;
                let kept = if pointed { with_point } else { bare };
                // The numbers of a single stretch may be all that are reported.
                if kept.len() < FEW_BARE as usize {
                    kept.push(pair(range));
                }
            }
            Note::Twice { letter, range } => {
                if faults.len() == known_faults {
                    let sentence = say!(stands_twice_in_this_line, letter as char);
                    faults.push(Finding::of(Fault::said(Rule::WordTwice, sentence), range));
                }
            }
        });
        (block, leans, measures)
    }

    fn line<'a>(
        &mut self,
        line: &[u8],
        offset: usize,
        ahead: &Ahead<'_, impl Lines<'a>>,
        each: &mut Hears<'_>,
    ) {
        let known_faults = self.faults.len();
        let (block, leans, measures) = self.block(line, offset);
        if block.empty {
            return;
        }
        let range = words_of(line, offset);
        self.last_words = Some(range);
        self.number(&block, range.0);
        self.calls |= block.call.is_some();
        if self.after.ended {
            self.behind_end.get_or_insert(range);
            return;
        }
        let incremental = block.incremental.unwrap_or(self.after.incremental);
        self.evidence.numbers(&block, incremental);
        self.fixed |= block.sets_position;
        let (torn, behind) = (self.after.torn, self.after.behind);
        self.faults.extend(self.too_far(&block, range));
        if measures {
            self.faults
                .extend(self.beside_too_far(line, offset, &block));
        }
        let steered = self.after.steer(&block, &self.reading);
        // A line that says where to go fixes the position even where it makes no move because the
        // position before it is unknown.
        self.fixed |= !self.after.incremental && block.has_coordinates();
        let is_free = self.faults.len() == known_faults;
        if is_free && !block.broken && block.has_stray_center(self.after.motion) {
            let sentence = say!(i_and_j_stand_beside_a_straight_cut);
            self.fault(Fault::said(Rule::CenterOnLine, sentence), range);
        }
        match steered {
            Some(steered) => {
                // The move as its words say it: whether there is a corner before it depends on the
                // meaning of I and J.
                let said = steered.said;
                match self.after.center {
                    _ if !said.is_arc() => {}
                    Some(stated) => self.evidence.states(&said, stated),
                    None if self.evidence.arc(&said, self.reading.tolerance) => {
                        self.first_center.get_or_insert(range);
                    }
                    None => {}
                }
                if is_free && let Some(fault) = self.contradicts(&block, &said) {
                    self.fault(fault, range);
                }
                let made = steered.made(&self.reading);
                self.moves += 1;
                if is_free && !leans {
                    self.said(&block, &made, range);
                }
                let Turned {
                    made,
                    corner,
                    is_fixed,
                    ..
                } = self.turned(made, range, ahead);
                self.fixed |= is_fixed;
                self.made(made, range, torn, ahead, each);
                if let Some(corner) = corner {
                    self.made(corner, range, torn, ahead, each);
                }
            }
            None if self.after.torn => self.interrupt(false),
            None => {}
        }
        if !self.leaves_cut {
            let is_rapid = steered.is_some_and(|steered| !steered.said.is_cut());
            self.leaves_cut = is_rapid || block.stop.is_some();
            let stands = steered.is_none() && !self.leaves_cut;
            self.heeds_loss |= stands || self.after.lost != [false, false];
        }
        if let Some(stop) = block.stop {
            self.stop(stop, steered.is_none() && behind == Behind::Stop, range);
        }
    }

    /// The number of a block, or where a program begins.
    fn number(&mut self, block: &Block, place: u32) {
        match block.program {
            Some(_) => self.programs.push(self.numbers.len() as u32),
            None => self.blocks += 1,
        }
        if let Some(number) = block.number {
            let last = self.numbers.last();
            self.numbers_rise &= last.is_none_or(|(before, _)| number > *before);
            self.numbers.push((number, place));
        }
    }

    /// The machine stops, `again` where nothing moves between this stop and the one before.
    fn stop(&mut self, stop: Stop, again: bool, range: (u32, u32)) {
        self.sum.stops += 1;
        self.interrupt(true);
        let known = self.parts.last_mut();
        if stop == Stop::Pause {
            self.pauses += 1;
            let (ends_open, stops) = match known {
                Some(part) => (&mut part.ends_open, &mut part.stop),
                None => (&mut self.ends_open_before, &mut self.stop_before),
            };
            *ends_open |= again;
            *stops = Some(stops.map_or(range.0, |_| SEVERAL));
        }
        if stop == Stop::End && self.after.side.is_some() && self.after.switches.is_none() {
            self.fault(Fault::StillOn, range);
        }
    }

    fn fault(&mut self, fault: Fault, range: (u32, u32)) {
        let range = range.0 as usize..range.1 as usize;
        self.faults.push(Finding::of(fault, range));
    }

    /// An arc whose I and J lead along another arc than its R: some controls take the one, some the other.
    fn contradicts(&self, block: &Block, said: &Move) -> Option<Fault> {
        let stated = block.r.filter(|_| block.has_center())?;
        let Course::Arc(arc) = said.at_origin().course(&self.reading) else {
            return None;
        };
        let stated = self.reading.length(stated, self.after.inch) as f64 / 1e3;
        let (radius, tolerance) = (arc.radius, self.reading.tolerance as f64 / 1e3);
        let half = (arc.end - arc.start).norm() / 2.0;
        // How far the centre is from the chord: nothing at a half turn, where R tells it only roughly.
        let aside = (radius * radius - half * half).max(0.0).sqrt();
        let is_plain = aside > (2.0 * radius * tolerance).sqrt() + tolerance && half > 0.0;
        let is_other_turn = is_plain && (arc.sweep.abs() > PI) != (stated < 0.0);
        let differs = (stated.abs() - radius).abs() > tolerance || is_other_turn;
        differs.then(|| {
            let sentence = say!(r_is_not_the_radius_of_i_and_j, stated / 1e3, radius / 1e3);
            Fault::said(Rule::ArcOffRadius, sentence)
        })
    }

    /// Makes the corner at the end of a move.
    fn turned<'a>(
        &mut self,
        made: Move,
        range: (u32, u32),
        ahead: &Ahead<'_, impl Lines<'a>>,
    ) -> Turned {
        if made.corner.is_none() {
            return Turned {
                made,
                corner: None,
                looked_at: 0,
                is_fixed: false,
            };
        }
        self.has_corners = true;
        let turned = turned(made, &mut self.after, ahead.lines(), &self.reading);
        self.ahead = self.ahead.max(ahead.beyond(turned.looked_at));
        if turned.corner.is_none() {
            let sentence = say!(the_word_for_a_corner_finds_none_here);
            self.fault(Fault::said(Rule::CornerWord, sentence), range);
        }
        turned
    }

    /// Whether a line repeats the last one with a move.
    fn said(&mut self, block: &Block, made: &Move, range: (u32, u32)) {
        let said = mark_of(block, made);
        let is_again = std::mem::replace(&mut self.after.trail.said, said) == said;
        if is_again
            && !made.incremental
            && made.is_cut()
            && made.from == made.to
            && made.switches.is_none()
        {
            self.fault(Fault::DoubledBlock { arc: made.is_arc() }, range);
        }
    }

    /// Marks a fault in a line of the present cut.
    fn mark_fault(&mut self) {
        match self.parts.last_mut() {
            Some(part) => part.faulty |= part.open,
            None => self.faulty_before |= self.ends_cut_before.is_none(),
        }
    }

    /// Begins a new cut; `whole` is false where lines between cannot be read.
    fn interrupt(&mut self, whole: bool) {
        self.after.trail = Trail::default();
        match self.parts.last_mut() {
            Some(part) if part.open => (part.open, part.whole) = (false, part.whole && whole),
            Some(_) => {}
            None => _ = self.ends_cut_before.get_or_insert(whole),
        }
    }

    fn made<'a>(
        &mut self,
        made: Move,
        range: (u32, u32),
        torn: bool,
        ahead: &Ahead<'_, impl Lines<'a>>,
        each: &mut Hears<'_>,
    ) {
        self.fixed |= !made.incremental || self.after.center.is_some();
        self.sum.moves += 1;
        self.sum.arcs += usize::from(made.is_arc());
        self.sum.rapids += usize::from(!made.is_cut());
        self.sum.travel = added(self.sum.travel, apart(made.to, made.from));
        if self.after.mills {
            // Layers are neither contours of a part nor passes along one.
            return self.interrupt(true);
        }
        if made.switches == Some(true) && made.offset.is_none() {
            let side = made.side.unwrap_or(Side::Left);
            self.fault(Fault::NoOffset { side }, range);
        }
        if let Some(on) = made.switches
            && (made.is_arc() || (on && !made.is_cut()))
        {
            self.fault(
                Fault::Switch {
                    on,
                    arc: made.is_arc(),
                },
                range,
            );
        }
        let cap = self.cap(made, range);
        if !made.is_cut() {
            return self.interrupt(true);
        }
        if !made.goes_anywhere() {
            return;
        }
        let odd = self.examine(&made, ahead);
        self.after.trail.push(&made);
        match self.parts.last_mut() {
            Some(part) if part.open => part.push(made, cap, range),
            last => {
                let is_first = last.is_none() && self.ends_cut_before.is_none();
                let continues = is_first && self.before.trail.last[0].is_some();
                self.heeds_loss |= !continues && !self.leaves_cut;
                self.parts
                    .push(Part::begin(made, cap, range, continues, !torn));
            }
        }
        let part = self.parts.len() - 1;
        match odd {
            // Whether it is one depends on where its cut begins.
            Some(Fault::Spur { length }) => self.spurs.push(Spur {
                tip: made.from,
                length,
                range,
                part: part as u32,
            }),
            Some(fault) => self.fault(fault, range),
            None => {}
        }
        each(part, &made, range);
    }

    /// Twice the area between a move and its chord, nm²; an arc is kept where it may be too tight, and its fault.
    fn cap(&mut self, made: Move, range: (u32, u32)) -> f64 {
        // Relative to its own start, so that the result is the same to the last bit anywhere.
        match made.at_origin().course(&self.reading) {
            Course::Arc(arc) => {
                if arc.radius * 1e3 < LARGEST_CORRECTION {
                    let goes_on = self.parts.last().is_some_and(|part| part.open);
                    let part = (self.parts.len() - usize::from(goes_on)) as u32;
                    let tightest = if made.side.is_some() {
                        &mut self.tightest.offset
                    } else {
                        &mut self.tightest.plain
                    };
                    *tightest = tightest.min(arc.radius);
                    self.tight.push(Tight {
                        arc: made,
                        radius: arc.radius,
                        range,
                        part,
                    });
                }
                // µm² to nm².
                return (arc.twice_cap_area() * 1e6).round();
            }
            Course::OffRadius { start, end, .. } => {
                self.fault(Fault::OffRadius { start, end }, range);
            }
            Course::NoRadius => self.fault(Fault::ArcWithoutRadius, range),
            Course::Line => {}
        }
        0.0
    }

    /// The odd joint, a spur or a reversed arc, at the beginning of a move.
    fn examine<'a>(&mut self, made: &Move, ahead: &Ahead<'_, impl Lines<'a>>) -> Option<Fault> {
        let reading = self.reading;
        let shape = |made: Move| Shape {
            made,
            reading: &reading,
        };
        let [before, came] = self.after.trail.last;
        let made = shape(made.at_origin());
        let joint = joint(came.map(shape), &shape(before?), made)?;
        let next = corner::next_move(self.after, ahead.lines(), &reading, Move::goes_anywhere);
        self.ahead = self.ahead.max(ahead.beyond(next.looked_at));
        self.fixed |= next.is_fixed;
        let next = next.made.map(|next| shape(next.at_origin()));
        joint.fault(next.as_ref())
    }
}

/// From the first to the last byte of a line that is not a space.
pub(crate) fn words_of(line: &[u8], offset: usize) -> (u32, u32) {
    let leading = line
        .iter()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count();
    let trailing = line
        .iter()
        .skip(leading)
        .rev()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count();
    (
        (offset + leading) as u32,
        (offset + line.len() - trailing) as u32,
    )
}

fn pair(range: Range<usize>) -> (u32, u32) {
    (range.start as u32, range.end as u32)
}
