//! A stretch of consecutive lines: their content, the faults of each block by itself, and the sum of their blocks'
//! ways.
//!
//! Places count from the stretch's first byte and line, so that an edit elsewhere changes nothing here.

use super::around::StatedPoint;
use super::block::Block;
use super::decode::meant;
use super::entry::{BlockEntry, Entry, Move, NO_NUMBER, What, travel_of};
use super::fault::Flaw;
use super::parse::{Item, read_line};
use super::rules::position_mismatch::Positions;
use super::rules::{self, Counts, Limits, Observation, Spot};
use super::sum::{Sum, is_jump, may_cross_itself};
use super::words::{Word, Words};
use crate::finding::{Fault, Rule};
use crate::geometry::{Bounds, Point, Segment, Vector};
use crate::program::numbering::Numbering;
use crate::program::of_cut::{Counted, count};
use crate::program::path::{HeldWay, Lay, Node, Writing, may_be_odd, odd_joint};
use std::borrow::Cow;
use std::ops::{Deref, Range};

/// A finding at bytes of the stretch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Local {
    pub(crate) range: Range<usize>,
    observation: Observation,
    /// Index of the part that it lies in.
    pub(crate) part: usize,
}

impl Deref for Local {
    type Target = Observation;

    fn deref(&self) -> &Observation {
        &self.observation
    }
}

/// Blocks up to a word or to the end of the stretch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    entries: (u32, u32),
    /// The word after it, at the end of its entries.
    pub(crate) word: Option<(Word, bool)>,
    /// There is a block in it, readable or not.
    pub(crate) has_blocks: bool,
    /// Between two pauses it is the way from one contour to the next, perhaps.
    pub(crate) may_be_jump: bool,
    /// `None` for a part that is sound by itself: it can be read again from its blocks.
    whole: Option<Box<Whole>>,
}

/// The totals of the blocks of a part.
#[derive(Clone, Debug, PartialEq)]
struct Whole {
    sum: Sum,
    lay: Lay,
}

impl Part {
    pub(crate) fn entries(&self) -> Range<usize> {
        self.entries.0 as usize..self.entries.1 as usize
    }
}

/// The curve of a block from the origin; none where it is unknown.
pub(super) fn shape(block: &Block) -> Segment {
    meant(block, Point::origin()).unwrap_or_else(nowhere)
}

fn nowhere() -> Segment {
    Segment::line(Point::origin(), Point::origin())
}

/// The beginning or end of a stretch, as far as the joint with its neighbour needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    /// The outermost block, from the origin on.
    pub(crate) block: Segment,
    /// Its joint with the other blocks of the stretch may be odd.
    pub(crate) is_odd: bool,
}

/// An unfinished part.
struct Open {
    /// Its first entry.
    first: usize,
    sum: Sum,
    way: HeldWay,
    /// The last three blocks, the last one first, each from the origin on.
    trail: [Option<Segment>; 3],
    /// Its two ends.
    edges: [Option<Edge>; 2],
    /// Blocks that begin at an odd joint, by their number in the part.
    odd: Vec<(usize, Fault)>,
}

impl Open {
    fn at(first: usize) -> Open {
        Open {
            first,
            sum: Sum::default(),
            way: HeldWay::from(Node::at(Point::origin()), Writing::default()),
            trail: [None; 3],
            edges: [None; 2],
            odd: Vec::new(),
        }
    }

    fn push(&mut self, block: &Block) {
        let segment = meant(block, Point::origin());
        self.join(segment.unwrap_or_else(nowhere));
        let [x, y] = self.sum.travel.meant_um();
        let (start, by) = (Point::new(x, y), Vector::new(x, y));
        let way = segment
            .as_ref()
            .map_or(Segment::line(start, start), |segment| segment.moved(by));
        let arcs = self.sum.arcs;
        self.sum.push(block, travel_of(block), segment.as_ref());
        let is_arc = self.sum.arcs > arcs;
        self.way.push(way, is_arc, self.sum.travel.node());
    }

    /// Checks the joint at which the last block begins, now that the next block is known.
    fn join(&mut self, next: Segment) {
        let [made, before, came] = self.trail;
        let is_odd = made.is_some_and(|made| may_be_odd(&made, &next));
        if let (Some(made), Some(before)) = (made, before) {
            let fault = odd_joint(came, before, made, &next);
            let nth = self.sum.blocks - 1;
            self.odd.extend(fault.map(|fault| (nth, fault)));
        }
        if let (Some(first), 1) = (&mut self.edges[0], self.sum.blocks) {
            first.is_odd = is_odd;
        }
        let block = next;
        self.edges[0].get_or_insert(Edge {
            block,
            is_odd: false,
        });
        self.edges[1] = Some(Edge { block, is_odd });
        self.trail = [Some(next), made, before];
    }

    /// The part up to an entry, with the word there; the lays of some parts before it, and of some
    /// that are gone, may be reused.
    fn closed<'a>(
        self,
        end: usize,
        word: Option<(Word, bool)>,
        is_whole: bool,
        known: impl Iterator<Item = &'a Lay>,
        old: &[Stretch],
    ) -> Part {
        let sum = self.sum;
        let old = old.iter().flat_map(|old| &old.parts);
        let old = old.filter_map(|part| Some(&part.whole.as_ref()?.lay));
        let lay = Lay::known(known, old, sum.mark, is_whole)
            .unwrap_or_else(|| Lay::of(&self.way, sum.mark, is_whole));
        Part {
            entries: (self.first as u32, end as u32),
            word,
            has_blocks: sum.blocks + sum.unread > 0,
            may_be_jump: is_jump(&sum),
            whole: Some(Box::new(Whole { sum, lay })),
        }
    }
}

/// Consecutive lines of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Stretch {
    pub(crate) entries: Vec<Entry>,
    pub(crate) faults: Vec<Local>,
    /// How many faults of each rule; `None` where one of them counts only under conditions.
    pub(crate) tally: Option<Vec<Counted>>,
    pub(crate) parts: Vec<Part>,
    pub(crate) blocks: usize,
    pub(crate) arcs: usize,
    pub(crate) texts: usize,
    /// Blocks that could not be read.
    pub(crate) unread: usize,
    /// Entries with a number, and blocks with an end point after them.
    pub(crate) numbered: usize,
    pub(crate) stated: usize,
    pub(crate) numbering: Numbering,
    pub(crate) positions: Positions,
    pub(crate) travel: Move,
    /// Around its way, µm from its start.
    pub(crate) bounds: Option<Bounds>,
    pub(crate) words: usize,
    /// Entries: the controller's own first end word, the last end word of any, the last word.
    pub(crate) own_end: Option<usize>,
    pub(crate) last_end: Option<usize>,
    pub(crate) last_word: Option<usize>,
    /// Parts between two words of the stretch without a closed contour, and those that come near themselves, until they
    /// are known not to cross.
    pub(crate) open: Vec<usize>,
    pub(crate) may_cross: Vec<usize>,
    /// The beginning of its first part, and the end of its last one; `None` where there is no block in it.
    pub(crate) edges: [Option<Edge>; 2],
}

impl Stretch {
    /// Reads lines that begin at `offset` of the text. `lines` are ranges of the text without line ends, `bytes` all of it;
    /// `old` stretches may know how some of their parts lie.
    pub(crate) fn read(
        text: &[u8],
        offset: usize,
        lines: impl Iterator<Item = Range<usize>>,
        words: &Words<'_>,
        limits: &Limits,
        old: &[Stretch],
    ) -> Stretch {
        let mut stretch = Stretch::default();
        let mut open = Open::at(0);
        for (line, range) in lines.enumerate() {
            let start = range.start;
            read_line(&text[range], start, words, |item| {
                stretch.take(item, line as u32, offset, &mut open, (limits, old))
            });
        }
        let end = stretch.entries.len();
        stretch.close(open, end, None, old);
        stretch.entries.shrink_to_fit();
        stretch.parts.shrink_to_fit();
        stretch.faults.shrink_to_fit();
        stretch.sum_up();
        stretch
    }

    /// Ends a part: its oddities count once its contour is known.
    fn close(&mut self, mut open: Open, end: usize, word: Option<(Word, bool)>, old: &[Stretch]) {
        if self.parts.is_empty() {
            self.edges[0] = open.edges[0];
        }
        self.edges[1] = open.edges[1];
        let odd = std::mem::take(&mut open.odd);
        // A part between two words is a cut by itself.
        let is_whole = word.is_some() && !self.parts.is_empty() && may_cross_itself(&open.sum);
        let wholes = self
            .parts
            .iter()
            .rev()
            .filter_map(|part| part.whole.as_ref());
        let part = open.closed(end, word, is_whole, wholes.map(|whole| &whole.lay), old);
        let own = self.entries.get(part.entries()).unwrap_or_default();
        let blocks = || own.iter().filter(|entry| entry.block().is_some());
        for (nth, fault) in odd {
            let observation = Observation {
                counts: Counts::IfAlone,
                ..Observation::at(Spot::Block, fault)
            };
            self.faults.push(Local {
                range: blocks().nth(nth).map_or(0..0, Entry::range),
                observation,
                part: self.parts.len(),
            });
        }
        self.parts.push(part);
    }

    fn sum_up(&mut self) {
        let last = self.parts.len().saturating_sub(1);
        for (index, part) in self.parts.iter().enumerate() {
            let Some(Whole { sum, lay }) = part.whole.as_deref() else {
                continue;
            };
            if sum.blocks > 0 {
                let [x, y] = self.travel.meant_um();
                let placed = lay.bounds.moved(Vector::new(x, y));
                let known = self.bounds.get_or_insert(placed);
                known.merge(&placed);
            }
            self.travel = self.travel.plus(sum.travel);
            self.arcs += sum.arcs;
            if let Some((word, is_own)) = part.word {
                self.words += 1;
                let end = part.entries().end;
                self.last_word = Some(end);
                if word == Word::End {
                    self.own_end = self.own_end.or(is_own.then_some(end));
                    self.last_end = Some(end);
                }
            }
            if index > 0 && index < last {
                self.open
                    .extend((!is_jump(sum) && !lay.goes_round).then_some(index));
                let may_cross = lay.may_cross() && may_cross_itself(sum);
                self.may_cross.extend(may_cross.then_some(index));
            }
        }
        self.tally = self.tallied();
        self.let_go();
    }

    fn tallied(&self) -> Option<Vec<Counted>> {
        let mut tally = Vec::new();
        for fault in &self.faults {
            let rule = (fault.counts == Counts::Always).then_some(fault.rule)?;
            count(&mut tally, rule, rule.default_severity());
        }
        Some(tally)
    }

    /// Drops the details of parts that are sound by themselves.
    pub(crate) fn let_go(&mut self) {
        let of_faults = self.faults.iter().map(|fault| fault.part);
        let told = of_faults.chain(self.open.iter().chain(&self.may_cross).copied());
        let mut is_told = vec![false; self.parts.len()];
        told.for_each(|index| {
            if let Some(is_told) = is_told.get_mut(index) {
                *is_told = true;
            }
        });
        let inner = 1..self.parts.len().saturating_sub(1);
        for index in inner.filter(|&index| !is_told[index]) {
            let is_read = |whole: &mut Box<Whole>| whole.sum.errors + whole.sum.unread == 0;
            self.parts[index].whole.take_if(is_read);
        }
    }

    fn blocks_of(&self, part: &Part) -> impl Iterator<Item = &BlockEntry> {
        let own = self.entries.get(part.entries()).unwrap_or_default();
        own.iter().filter_map(Entry::block)
    }

    /// The totals of a part.
    pub(crate) fn sum(&self, part: &Part) -> Sum {
        match &part.whole {
            Some(whole) => whole.sum,
            None => {
                let mut sum = Sum::default();
                for block in self.blocks_of(part).map(BlockEntry::block) {
                    sum.push(
                        &block,
                        travel_of(&block),
                        meant(&block, Point::origin()).as_ref(),
                    );
                }
                sum
            }
        }
    }

    /// How a part lies relative to itself.
    pub(crate) fn lay<'a>(&self, part: &'a Part) -> Cow<'a, Lay> {
        match &part.whole {
            Some(whole) => Cow::Borrowed(&whole.lay),
            None => {
                let mut open = Open::at(part.entries().start);
                let blocks = self.blocks_of(part).map(BlockEntry::block);
                blocks.for_each(|block| open.push(&block));
                Cow::Owned(Lay::of(&open.way, open.sum.mark, false))
            }
        }
    }

    fn observe(&mut self, range: Range<usize>, observation: Observation) {
        self.faults.push(Local {
            range,
            observation,
            part: self.parts.len(),
        });
    }

    fn take(
        &mut self,
        item: Item,
        line: u32,
        base: usize,
        open: &mut Open,
        (limits, old): (&Limits, &[Stretch]),
    ) {
        let local = |range: Range<usize>| range.start - base..range.end - base;
        match item {
            Item::Block {
                block,
                range,
                number,
                stated_end,
                part,
            } => {
                let entry = BlockEntry::new(block, part, stated_end);
                let range = local(range);
                for observation in rules::check(&block, part, limits) {
                    // An unusual block, or one too tight, leads where it says.
                    open.sum.errors += usize::from(
                        observation.counts == Counts::Always
                            && observation.rule != Rule::SmallRadius,
                    );
                    self.observe(range.clone(), observation);
                }
                self.stated += usize::from(entry.stated_end().is_some());
                open.push(&block);
                self.positions
                    .block(self.blocks, self.entries.len(), &entry);
                self.blocks += 1;
                self.push(range, line, number, What::Block(entry));
            }
            Item::Word {
                word,
                is_own,
                range,
                number,
            } => {
                let end = self.entries.len();
                self.push(local(range), line, number, What::Word { word, is_own });
                let before = std::mem::replace(open, Open::at(end + 1));
                self.close(before, end, Some((word, is_own)), old);
            }
            Item::StartPoint { at, range } => {
                self.positions.anchor = Some(Some(StatedPoint { at, decimals: 3 }));
                self.push(local(range), line, None, What::StartPoint(at));
            }
            Item::Text { range, column } => {
                self.texts += 1;
                self.push(local(range), line, None, What::Text { column });
            }
            Item::CommentedBlock { range, column } => {
                self.texts += 1;
                self.push(local(range), line, None, What::CommentedBlock { column });
            }
            Item::Fault(fault) => {
                let is_unread = matches!(fault.flaw, Flaw::Unreadable(_) | Flaw::NotPlain(_));
                // Without its coordinates a block leads where it says.
                open.sum.errors +=
                    usize::from(!matches!(fault.flaw, Flaw::DecimalCommas | Flaw::FarStart));
                open.sum.unread += usize::from(is_unread);
                self.unread += usize::from(is_unread);
                if is_unread {
                    // Its number has its turn, but its end is unknown.
                    self.positions.anchor = Some(None);
                    self.push(local(fault.range.clone()), line, fault.number, What::Unread);
                }
                self.observe(local(fault.range.clone()), Observation::of(&fault));
            }
        }
    }

    fn push(&mut self, range: Range<usize>, line: u32, number: Option<u32>, what: What) {
        self.numbered += usize::from(number.is_some());
        self.numbering = self
            .numbering
            .with(number, matches!(what, What::Block(_) | What::Unread));
        self.entries.push(Entry {
            start: range.start as u32,
            length: range.len() as u32,
            line,
            number: number.unwrap_or(NO_NUMBER),
            what,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Effective;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_a_part_comes_to_is_told_by_its_blocks_once_it_is_let_go(
            blocks in prop::collection::vec("B[0-9]{1,4}B[0-9]{1,4}B[0-9]{1,10}G[XY](L|SR|NR)[1-4]|D|D|;", 0..40),
        ) {
            let text = blocks.join("\n");
            let limits = Limits::of(&Effective::default());
            let mut from = 0;
            let lines = text.split('\n').map(|line| {
                from += line.len() + 1;
                from - 1 - line.len()..from - 1
            });
            let stretch = Stretch::read(text.as_bytes(), 0, lines, &Words::default(), &limits, &[]);
            for part in &stretch.parts {
                let held = Part { whole: None, ..part.clone() };
                let [own, told] = [part, &held].map(|part| stretch.sum(part));
                prop_assert_eq!(Sum { errors: 0, unread: 0, ..own }, told);
                let [own, told] = [part, &held].map(|part| stretch.lay(part).into_owned());
                prop_assert_eq!((own.mark, own.bounds, own.near, own.goes_round), (told.mark, told.bounds, told.near, told.goes_round));
            }
        }
    }
}
