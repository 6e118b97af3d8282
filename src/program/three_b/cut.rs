//! A cut: the lines from one stop to the next. Their content, the faults of each block by itself, and what they come to
//! together.
//!
//! Places count from a byte and a line of the text, so that an edit elsewhere changes nothing here.

use super::block::Block;
use super::decode::meant;
use super::entry::{BlockEntry, Entry, Move, NO_NUMBER, What, travel_of};
use super::fault::{Flaw, SyntaxFault};
use super::parse::{Item, read_line};
use super::rules::position_mismatch::Positions;
use super::rules::{self, Counts, Observation, Spot};
use super::words::{Word, Words};
use crate::geometry::{Bounds, Point, Segment};
use crate::program::path::{Found, Jointed, Node, Verdict, Way, Writing, odd_joints};
use crate::settings::Effective;
use crate::text::SourceText;
use std::borrow::Cow;
use std::ops::{Deref, Range};
use std::sync::LazyLock;

/// A way of at most this many lines between two stops leads from one contour to the next, wherever it turns.
const JUMP_BLOCKS: usize = 3;

/// A way of at most this many lines that never turns back on an axis does so, too: no contour with one fault in it
/// looks like that.
const STAIR_BLOCKS: usize = 8;

/// How much longer than a straight line a way that leads straight on may be, for each of its blocks, µm: they end on
/// whole µm.
const NOT_STRAIGHT: f64 = 0.01;

/// A finding at bytes of the cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Local {
    pub(crate) range: Range<usize>,
    observation: Observation,
}

impl Deref for Local {
    type Target = Observation;

    fn deref(&self) -> &Observation {
        &self.observation
    }
}

/// The lines from one stop to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cut {
    /// The last block or word of them is the stop.
    pub(crate) entries: Vec<Entry>,
    /// The stop, and whether it is the controller's own word; `None` for lines after the last.
    pub(crate) stop: Option<(Word, bool)>,
    /// Blocks that can be read, and arcs among them.
    pub(crate) blocks: u32,
    arcs: u32,
    pub(crate) travel: Move,
    /// Twice the area between the way and its chord, µm²; above 0 where it runs to the left.
    pub(crate) twice_area: f64,
    /// Around its way, µm from its start.
    pub(crate) bounds: Option<Bounds>,
    pub(crate) closes: bool,
    pub(crate) goes_round: bool,
    /// Between two stops it is the way from one contour to the next, perhaps.
    pub(crate) may_be_jump: bool,
    /// Entries with a number.
    pub(crate) numbered: u32,
    rare: Option<Box<Rare>>,
}

/// What few cuts have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rare {
    pub(crate) faults: Vec<Local>,
    /// Where it crosses itself.
    pub(crate) found: Found,
    /// All that is known of one that does not go round, and is no way between two.
    open: Option<Verdict>,
    /// How far the last block leads on from the start, to which the way had come back, µm.
    pub(crate) leads_on: Option<f64>,
    /// The end points that stand after its blocks.
    pub(crate) positions: Positions,
    pub(crate) texts: usize,
    /// Blocks that could not be read: the end of the way is unknown.
    pub(crate) unread: usize,
    /// Faults that change where the way leads.
    pub(crate) errors: usize,
}

/// Reads lines from one on, up to one that ends with a stop: the cuts that they are, each with its lines, of which several
/// lie in a line where stops stand in the middle of it; and the first line behind them.
pub(super) fn read(
    text: &SourceText,
    first: usize,
    settings: &Effective,
) -> (Vec<(Range<usize>, Cut)>, usize) {
    let (base, words) = (text.line_start(first), Words::of(settings));
    let (mut all, mut cut) = (Vec::new(), Cut::default());
    let (mut from, mut line) = (first, first);
    while line < text.line_count() && cut.stop.is_none() {
        read_line(text.line(line), text.line_start(line), &words, |item| {
            if cut.stop.is_some() && goes_on(&item) {
                all.push((from..line + 1, std::mem::take(&mut cut)));
                from = line;
            }
            cut.take(item, (line - first) as u32, base, settings);
        });
        line += 1;
    }
    all.push((from..line, cut));
    (all, line)
}

/// Whether it belongs to the cut behind a stop in its line: a block, readable or not, or another stop.
fn goes_on(item: &Item) -> bool {
    match item {
        Item::Block { .. } | Item::Word { .. } => true,
        Item::Fault(fault) => is_unread(fault),
        _ => false,
    }
}

/// It stands for a block that cannot be read.
fn is_unread(fault: &SyntaxFault) -> bool {
    matches!(fault.flaw, Flaw::Unreadable(_) | Flaw::NotPlain(_))
}

impl Cut {
    pub(crate) fn has_blocks(&self) -> bool {
        self.blocks > 0 || self.rare().unread > 0
    }

    pub(crate) fn blocks(&self) -> impl DoubleEndedIterator<Item = &BlockEntry> {
        self.entries.iter().filter_map(Entry::block)
    }

    /// The index of its stop among the entries.
    pub(crate) fn stop_entry(&self) -> Option<usize> {
        let is_stop = |entry: &Entry| matches!(entry.what, What::Word { .. });
        self.entries.iter().rposition(is_stop)
    }

    /// Its way from the origin. A block that leads nowhere is a piece of no length.
    pub(crate) fn way(&self) -> Way {
        way_of(self.blocks().map(BlockEntry::block)).0
    }

    /// All that is known of its way.
    pub(crate) fn verdict(&self) -> Cow<'_, Verdict> {
        match &self.rare().open {
            Some(verdict) => Cow::Borrowed(verdict),
            None => Cow::Owned(Verdict::of(&self.way())),
        }
    }

    pub(crate) fn rare(&self) -> &Rare {
        static NONE: LazyLock<Rare> = LazyLock::new(Rare::default);
        self.rare.as_deref().unwrap_or(&NONE)
    }

    fn rare_mut(&mut self) -> &mut Rare {
        self.rare.get_or_insert_default()
    }

    /// What takes time, and depends on its blocks alone.
    pub(crate) fn finished(mut self, settings: &Effective) -> Cut {
        self.entries.shrink_to_fit();
        let (way, travel) = way_of(self.blocks().map(BlockEntry::block));
        let verdict = Verdict::of(&way);
        self.blocks = verdict.ends.blocks as u32;
        self.arcs = verdict.ends.arcs as u32;
        self.travel = travel;
        self.twice_area = verdict.twice_area;
        self.bounds = (self.blocks > 0).then_some(verdict.bounds);
        (self.closes, self.goes_round) = (verdict.closes(), verdict.goes_round);
        self.may_be_jump = self.may_be_jump();
        self.join(&way);
        let is_open = !self.goes_round && !self.may_be_jump;
        let mut rare = self.rare.take().map_or_else(Rare::default, |rare| *rare);
        if rare.positions.say_nothing() {
            rare.positions = Positions::default();
        }
        rare.leads_on = verdict.ends.lead_on();
        rare.open = is_open.then_some(verdict);
        rare.faults.shrink_to_fit();
        if rare.errors == 0 {
            let offset = rules::control_offset(settings, self.blocks(), self.twice_area);
            rare.found = Found::of(&way, offset);
        }
        self.rare = (rare != Rare::default()).then(|| Box::new(rare));
        self
    }

    /// Finds its odd joints: they count once its contour is known.
    fn join(&mut self, way: &Way) {
        let pieces = way.pieces();
        let odd = odd_joints(pieces.len(), |nth| {
            pieces.get(nth).copied().map(Jointed::of)
        });
        if odd.is_empty() {
            return;
        }
        let blocks = self.entries.iter().filter(|entry| entry.block().is_some());
        let ranges: Vec<Range<usize>> = blocks.map(Entry::range).collect();
        let odd = odd.into_iter().map(|(nth, fault)| Local {
            range: ranges[nth].clone(),
            observation: Observation {
                counts: Counts::IfAlone,
                ..Observation::at(Spot::Block, fault)
            },
        });
        self.rare_mut().faults.extend(odd);
    }

    /// True for what may be the way between two stops from one contour to the next. A way that returns to its start is not
    /// one: that is how a tab is cut off, from and to the thread hole.
    fn may_be_jump(&self) -> bool {
        let travel = self.travel.machine.map(|um| um as f64);
        let count = self.blocks as usize;
        if count == 0 || self.arcs > 0 || self.travel.machine == [0, 0] {
            return false;
        }
        let (mut along, mut length) = ([0.0, 0.0], 0.0);
        for block in self.blocks() {
            let [x, y] = block.travel().machine.map(|um| um as f64);
            along = [along[0] + x.abs(), along[1] + y.abs()];
            length += x.hypot(y);
        }
        let turns_back = |axis: usize| along[axis] - travel[axis].abs() > count as f64;
        let straight = travel[0].hypot(travel[1]);
        count <= JUMP_BLOCKS
            || (count <= STAIR_BLOCKS && !turns_back(0) && !turns_back(1))
            || length - straight <= NOT_STRAIGHT * count as f64
    }

    fn observe(&mut self, range: Range<usize>, observation: Observation) {
        self.rare_mut().faults.push(Local { range, observation });
    }

    fn take(&mut self, item: Item, line: u32, base: usize, settings: &Effective) {
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
                for observation in rules::check(&block, part, settings) {
                    // An unusual block, or one too tight, leads where it says.
                    let leads_astray = observation.counts == Counts::Always
                        && observation.rule != crate::finding::Rule::SmallRadius;
                    self.rare_mut().errors += usize::from(leads_astray);
                    self.observe(range.clone(), observation);
                }
                let nth = self.entries.len();
                self.rare_mut().positions.block(nth, &entry);
                self.push(range, line, number, What::Block(entry));
            }
            Item::Word {
                word,
                is_own,
                range,
                number,
            } => {
                self.stop = Some((word, is_own));
                self.push(local(range), line, number, What::Word { word, is_own });
            }
            Item::StartPoint { at, range } => {
                self.rare_mut().positions.start(at);
                self.push(local(range), line, None, What::StartPoint(at));
            }
            Item::Text { range, column } => {
                self.rare_mut().texts += 1;
                self.push(local(range), line, None, What::Text { column });
            }
            Item::CommentedBlock { range, column } => {
                self.rare_mut().texts += 1;
                self.push(local(range), line, None, What::CommentedBlock { column });
            }
            Item::Fault(fault) => {
                // Without its coordinates a block leads where it says.
                self.rare_mut().errors +=
                    usize::from(!matches!(fault.flaw, Flaw::DecimalCommas | Flaw::FarStart));
                if is_unread(&fault) {
                    self.rare_mut().unread += 1;
                    // Its number has its turn, but its end is unknown.
                    self.rare_mut().positions.lost();
                    self.push(local(fault.range.clone()), line, fault.number, What::Unread);
                }
                self.observe(local(fault.range.clone()), Observation::of(&fault));
            }
        }
    }

    fn push(&mut self, range: Range<usize>, line: u32, number: Option<u32>, what: What) {
        self.numbered += u32::from(number.is_some());
        self.entries.push(Entry {
            start: range.start as u32,
            length: range.len() as u32,
            line,
            number: number.unwrap_or(NO_NUMBER),
            what,
        });
    }
}

/// The way of some blocks from the origin, and where they lead.
pub(super) fn way_of(blocks: impl Iterator<Item = Block>) -> (Way, Move) {
    let mut at = Move::default();
    let mut way = Way::from(Node::at(Point::origin()), Writing::default());
    for block in blocks {
        let [x, y] = at.meant_um();
        let start = Point::new(x, y);
        let piece = meant(&block, start).unwrap_or(Segment::line(start, start));
        at = at.plus(travel_of(&block));
        way.push(piece, !block.motion.is_line(), at.node());
    }
    (way, at)
}
