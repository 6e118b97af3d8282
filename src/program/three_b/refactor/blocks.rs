//! The blocks of a program, read for refactoring, and the new ones in their places.

use super::header::new_header;
use super::turned::turned;
use crate::geometry::Point;
use crate::program::grid::Node;
use crate::program::path::{Kind, Trace};
use crate::program::refactor::moves::{Change, Move, Numbers, Place, Printed, Printer, Rewrite};
use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, Motion, PartArc, Quadrant};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::encode;
use crate::program::three_b::layout::{
    layout_in, push_end_point, push_fields, push_to_comment_column,
};
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, pieces};
use crate::program::write::MOST_FOR_EACH;
use crate::settings::Layout;
use crate::text::TextEdit;
use std::ops::Range;

/// Arcs that no longer fit into a block are cut as chords: a program takes at most this many blocks more than
/// [`MOST_FOR_EACH`] for each that it has.
const MORE: usize = 20_000;

/// The blocks of a program that move.
pub(in crate::program) struct Blocks<'a> {
    document: &'a Document,
    pub(super) all: Vec<Own>,
}

/// A block in its line.
pub(in crate::program) struct Own {
    /// Bytes of the text.
    pub(super) range: Range<usize>,
    pub(super) block: Block,
    part: Option<PartArc>,
    /// The text states its end point behind it.
    pub(super) states_end: bool,
}

/// A place in µm, of which all places of 3B are.
pub(super) fn node([x, y]: Place) -> Node {
    Node {
        x: x / 1000,
        y: y / 1000,
    }
}

impl<'a> Blocks<'a> {
    /// Those of a program; the error says which line cannot be read.
    pub(in crate::program) fn of(
        document: &'a Document,
        trace: &Trace,
    ) -> Result<Blocks<'a>, String> {
        let (text, words) = (document.text(), document.words());
        let mut steps = trace.steps.iter().filter(|step| step.moves());
        // Words that end programs elsewhere may stand before the one that ends this one.
        let end = trace.steps.iter().find(|step| step.kind == Kind::End);
        let (mut all, mut fault, mut is_over) = (Vec::new(), None, false);
        for line in 0..text.line_count() {
            let (start, before) = (text.line_start(line), all.len());
            read_line(text.line(line), start, &words, |item| {
                let found = match item {
                    _ if is_over => return,
                    Item::Block {
                        block,
                        part,
                        range,
                        stated_end,
                        ..
                    } => {
                        let step = steps.next().filter(|step| step.range.start == range.start);
                        all.push(Own {
                            range,
                            block,
                            part,
                            states_end: stated_end.is_some(),
                        });
                        let leads = step.is_some_and(|step| step.ideal.is_some());
                        (!leads).then(|| say!(the_block_of_a_line_leads_nowhere, line + 1))
                    }
                    Item::Fault(found) => Some(say!(line_by_number, line + 1, found.sentence())),
                    Item::Text { .. } if !all.is_empty() => {
                        Some(say!(that_line_cannot_be_read, line + 1))
                    }
                    Item::Text { .. } | Item::CommentedBlock { .. } | Item::StartPoint { .. } => {
                        None
                    }
                    Item::Word { range, .. } => {
                        is_over |= end.is_some_and(|end| range.start >= end.range.start);
                        None
                    }
                };
                fault = fault.take().or(found);
            });
            let blocks = all.len() - before;
            if blocks > 1 {
                fault.get_or_insert_with(|| say!(a_line_holds_several_blocks, line + 1, blocks));
            }
            if is_over {
                break;
            }
        }
        match fault {
            Some(sentence) => Err(sentence),
            None if all.is_empty() => Err(say!(the_program_has_no_block).into()),
            None => Ok(Blocks { document, all }),
        }
    }

    /// An error where a block has 4B's radius: the program then holds the part's contour.
    pub(super) fn refuse_four_b(&self) -> Result<(), String> {
        match self.all.iter().find(|own| own.part.is_some()) {
            Some(own) => {
                let line = self.document.text().line_of(own.range.start);
                Err(say!(a_4b_block_cannot_be_calculated_anew, line + 1))
            }
            None => Ok(()),
        }
    }

    /// The blocks of a move.
    fn blocks_of(&self, meant: &Move) -> Result<Vec<(Block, Node)>, String> {
        let [from, to] = [meant.from, meant.to].map(node);
        let own = self.all[meant.like].block;
        match (meant.numbers, own.motion) {
            (Numbers::Turned(transform), _) => Ok(vec![(turned(&own, transform), to)]),
            // The same numbers into the opposite quadrant.
            (Numbers::Reversed, Motion::Line(quadrant)) => {
                let opposite = Quadrant::ALL[(quadrant as usize + 2) % 4];
                let motion = Motion::Line(opposite);
                Ok(vec![(Block { motion, ..own }, to)])
            }
            _ => {
                let (mut blocks, largest) = (Vec::new(), self.document.largest());
                encode(&meant.piece, from, to, largest, &mut blocks)
                    .ok_or_else(|| say!(no_blocks_within_tolerance_lead_from_to, from, to))?;
                let blocks = blocks.into_iter();
                Ok(blocks.map(|made| (made.block, made.to)).collect())
            }
        }
    }

    /// The last piece of a kind in the line of a block, as bytes of the text.
    pub(super) fn beside(&self, own: &Own, field: Field) -> Option<Range<usize>> {
        let text = self.document.text();
        let line = text.line_of(own.range.start);
        let (bytes, start) = (text.line(line), text.line_start(line));
        let is_there = match field {
            Field::Coordinates => own.states_end,
            _ => memchr::memchr(b';', bytes).is_some(),
        };
        let pieces = is_there.then(|| pieces(bytes, &self.document.words()));
        let mut pieces = pieces.into_iter().flatten().rev();
        let piece = pieces.find(|piece| piece.field == field)?.range;
        Some(start + piece.start..start + piece.end)
    }

    /// The layout in which a block is written.
    pub(super) fn layout(&self, own: &Own) -> Layout {
        let text = self.document.text().bytes();
        layout_in(text.get(own.range.clone()).unwrap_or_default())
    }

    /// The replacement of one move: its number stays, its comment goes with its block.
    fn slot(
        &self,
        place: &Move,
        meant: &Move,
        blocks: &[(Block, Node)],
    ) -> Result<TextEdit, String> {
        let text = self.document.text();
        let (own, line) = (&self.all[place.like], place.line);
        let [coordinates, comment] =
            [Field::Coordinates, Field::Comment].map(|field| self.beside(own, field));
        let comment_moves = meant.like != place.like;
        if !comment_moves && blocks.len() > 1 && comment.is_some() {
            return Err(say!(
                a_comment_stands_behind_a_block_that_becomes_several,
                line + 1
            ));
        }
        let mut out = Vec::new();
        for (position, (block, to)) in blocks.iter().enumerate() {
            if position > 0 {
                out.extend_from_slice(text.line_end(line).as_bytes());
            }
            push_fields(&mut out, self.layout(own), block, meant.part.as_ref());
            if coordinates.is_some() {
                push_to_comment_column(&mut out, block);
                push_end_point(&mut out, *to);
            }
            let carried = self.beside(&self.all[meant.like], Field::Comment);
            if let (0, true, Some(carried)) = (position, comment_moves, carried) {
                out.push(b' ');
                out.extend_from_slice(text.bytes().get(carried).unwrap_or_default());
            }
        }
        let behind = comment.filter(|_| comment_moves).or(coordinates);
        let end = behind.map_or(own.range.end, |behind| behind.end);
        let new = String::from_utf8(out)
            .map_err(|_| say!(the_comment_is_in_another_code_page, line + 1))?;
        Ok(TextEdit::new(own.range.start..end, new))
    }
}

impl Printer for Blocks<'_> {
    fn count(&self) -> usize {
        self.all.len()
    }

    fn part(&self, block: usize) -> Option<PartArc> {
        self.all[block].part
    }

    /// A comment marks a place.
    fn goes_on(&self, block: usize) -> bool {
        let both = block.saturating_sub(1)..block + 1;
        self.all[both].iter().all(|own| own.part.is_none())
            && self.beside(&self.all[block], Field::Comment).is_none()
    }

    fn step(&self, _: usize) -> i64 {
        1000
    }

    fn longest(&self) -> i64 {
        1000 * self.document.largest()
    }

    fn words(&self, change: &Change<'_>) -> Result<Vec<TextEdit>, String> {
        match change {
            Change::Scale(_) => self.refuse_four_b()?,
            // The way in ends on the wire's path, beside the contour by a correction that the program does not state.
            Change::StartHere {
                is_led_elsewhere: true,
                ..
            } if self.refuse_four_b().is_err() => {
                return Err(say!(the_way_in_of_4b_ends_beside_the_contour).into());
            }
            _ => {}
        }
        Ok(Vec::new())
    }

    fn print(&self, moves: &[Move], rewrite: &Rewrite) -> Result<Printed, String> {
        let (text, mut edits, mut counts) = (self.document.text(), Vec::new(), Vec::new());
        if let (Some(start), Some(header)) = (rewrite.start, self.document.header()) {
            edits.push(new_header(text, &header, node(start)));
        }
        let most = MOST_FOR_EACH * moves.len() + MORE;
        let (mut room, mut wrong) = (most, None);
        for (place, meant) in moves.iter().zip(&rewrite.moves) {
            let keeps = meant.filter(|meant| meant.numbers != Numbers::Fitted);
            let is_wrong =
                |kept: Move| decode(&self.all[kept.like].block, Point::origin()).is_err();
            wrong = wrong.or_else(|| keeps.is_some_and(is_wrong).then_some(place.line));
            let count = match meant {
                Some(meant) if meant == place => 1,
                Some(meant) => {
                    let blocks = self.blocks_of(meant)?;
                    if blocks.is_empty() {
                        return Err(say!(the_block_becomes_shorter_than_1_um, place.line + 1));
                    }
                    edits.push(self.slot(place, meant, &blocks)?);
                    blocks.len()
                }
                // The whole line goes, its line end with it.
                None => {
                    edits.push(TextEdit::new(text.whole_line(place.line), ""));
                    0
                }
            };
            let too_many = || say!(scaled_the_program_would_take_too_many_blocks, most);
            room = room.checked_sub(count).ok_or_else(too_many)?;
            counts.push(count);
        }
        let edits = text.changing(edits);
        // Its numbers contradict each other, and it may mean another way.
        if let (Some(line), false) = (wrong, edits.is_empty()) {
            let reason = say!(the_block_does_not_run_along_its_piece);
            return Err(say!(line_by_number, line + 1, reason));
        }
        Ok(Printed {
            edits,
            blocks: counts,
        })
    }
}
