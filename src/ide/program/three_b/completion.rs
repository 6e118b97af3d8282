//! Completion of a block: G, J and Z from X and Y, the way back to the start of the contour, the words between blocks.

use super::super::step::ways_back;
use crate::geometry::{Arc, Point, Segment};
use crate::ide::amounts::{mm, point, turn};
use crate::ide::{Completion, CompletionKind};
use crate::program::steps::{self, Program};
use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, CountingAxis, Motion, Node, Quadrant};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::{encode, line_block, point_of, snap};
use crate::program::three_b::layout::push_fields;
use crate::program::three_b::pieces::{Field, pieces};
use crate::settings::Layout;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How many lines before the cursor are read to find the machine's position.
const LOOKED_BACK: usize = 500;

/// What can stand at a byte, the most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    let text = document.text();
    let line = text.line_range(text.line_of(offset));
    let before = text
        .bytes()
        .get(line.start..offset.clamp(line.start, line.end))
        .unwrap_or_default();
    let typed = Typed::of(before, document);
    match typed {
        Some(typed) => typed.tails(document, line.start, offset),
        None => {
            // An unfinished word is replaced.
            let letters = before
                .iter()
                .rev()
                .take_while(|byte| byte.is_ascii_alphabetic())
                .count();
            let rest = &before[..before.len() - letters];
            let is_new =
                rest.iter().all(|byte| matches!(byte, b' ' | b'\t')) || rest.ends_with(b": ");
            if is_new {
                beginnings(document, offset - letters, offset)
            } else {
                Vec::new()
            }
        }
    }
}

/// The unfinished block at the end of some text.
#[derive(Default)]
struct Typed {
    numbers: Vec<Option<i64>>,
    axis: Option<CountingAxis>,
    /// Byte of the line at which an unfinished word begins: `G`, `N`, `S`.
    begun: Option<usize>,
}

impl Typed {
    fn of(before: &[u8], document: &Document) -> Option<Typed> {
        let mut typed: Option<Typed> = None;
        for piece in pieces(before, &document.words()) {
            let bytes = before.get(piece.range.clone()).unwrap_or_default();
            let number = || std::str::from_utf8(bytes).ok()?.parse::<i64>().ok();
            match (piece.field, &mut typed) {
                (Field::Separator, typed) => typed.get_or_insert_default().numbers.push(None),
                (Field::X | Field::Y | Field::J, Some(typed)) => {
                    if let Some(last) = typed.numbers.last_mut() {
                        *last = number();
                    }
                }
                (Field::Axis, Some(typed)) => {
                    typed.axis = match bytes.last() {
                        Some(b'X' | b'x') => Some(CountingAxis::X),
                        _ => Some(CountingAxis::Y),
                    }
                }
                (Field::Strange, Some(typed)) if piece.range.end == before.len() => {
                    typed.begun = Some(piece.range.start)
                }
                _ => typed = None,
            }
        }
        typed.filter(|typed| typed.numbers.len() == 3)
    }

    /// What can follow the given numbers, each with its end.
    fn tails(&self, document: &Document, line_start: usize, offset: usize) -> Vec<Completion> {
        let (x, y) = (self.numbers[0].unwrap_or(0), self.numbers[1].unwrap_or(0));
        let start = stand(document, line_start);
        let range = self.begun.map_or(offset, |begun| line_start + begun)..offset;
        let candidates = match (self.numbers[2], self.axis) {
            (None, None) => shapes(x, y, document.largest()),
            (Some(j), None) => [CountingAxis::X, CountingAxis::Y]
                .into_iter()
                .flat_map(|axis| motions(x, y, j, axis))
                .collect(),
            (Some(j), Some(axis)) => motions(x, y, j, axis),
            (None, Some(_)) => Vec::new(),
        };
        let completion = |block: Block| {
            let whole = written(&block)?;
            // The part that is already there is left out.
            let skipped = match (self.numbers[2], self.axis) {
                (None, _) => whole.rfind('B')? + 1,
                (Some(_), None) => whole.rfind('G')?,
                (Some(_), Some(_)) => whole.rfind('G')? + 2,
            };
            let about = about(&decode(&block, start).ok()?);
            let text = whole.get(skipped..)?;
            Some(Completion::new(text, about, &range, CompletionKind::Word))
        };
        candidates.into_iter().filter_map(completion).collect()
    }
}

/// Blocks with these X and Y: straight lines into each quadrant; circles, half and quarter turns
/// that start in each of them.
fn shapes(x: i64, y: i64, largest: i64) -> Vec<Block> {
    let origin = Node { x: 0, y: 0 };
    let mut corners = corners(x, y);
    corners.retain(|corner| *corner != origin);
    let lines = corners.iter().map(|corner| line_block(origin, *corner));
    let mut blocks: Vec<Block> = lines.collect();
    for sweep in [TAU, PI, FRAC_PI_2] {
        for turn in [1.0, -1.0] {
            for &corner in &corners {
                let start = point_of(corner);
                let arc = Arc::from_center(
                    Point::origin(),
                    start.coords.norm(),
                    start.y.atan2(start.x),
                    sweep * turn,
                );
                let Some(end) = snap(arc.end) else { continue };
                let mut encoded = Vec::new();
                let piece = Segment::Arc(Arc {
                    start,
                    end: point_of(end),
                    ..arc
                });
                if encode(&piece, corner, end, largest, &mut encoded).is_some()
                    && let [one] = encoded[..]
                    && !one.block.motion.is_line()
                {
                    blocks.push(one.block);
                }
            }
        }
    }
    blocks
}

/// The points whose coordinates have these absolute values.
fn corners(x: i64, y: i64) -> Vec<Node> {
    let mut corners: Vec<Node> = Vec::new();
    for (x, y) in [(x, y), (-x, y), (-x, -y), (x, -y)] {
        let corner = Node { x, y };
        if !corners.contains(&corner) {
            corners.push(corner);
        }
    }
    corners
}

/// Blocks with these numbers and each Z that they can have.
fn motions(x: i64, y: i64, j: i64, axis: CountingAxis) -> Vec<Block> {
    let corners = corners(x, y);
    let lines = corners
        .iter()
        .map(|corner| Quadrant::counter_clockwise(corner.x, corner.y));
    let arcs = [true, false].into_iter().flat_map(|is_left| {
        let corners = corners.iter();
        corners.map(move |corner| Motion::arc(is_left, corner.x, corner.y))
    });
    let block = |motion: Motion| Block {
        x,
        y,
        j,
        axis,
        motion,
    };
    lines.map(Motion::Line).chain(arcs).map(block).collect()
}

/// The end of a piece, in words.
fn about(piece: &Segment) -> String {
    match piece {
        Segment::Line(line) => say!(line_to, point(line.end)),
        Segment::Arc(arc) if arc.is_full_turn() => {
            say!(
                circle_about,
                mm(arc.radius),
                turn(arc.sweep),
                point(arc.center)
            )
        }
        Segment::Arc(arc) => {
            let degrees = arc.sweep.abs().to_degrees();
            say!(
                arc_with_its_turn_to,
                mm(arc.radius),
                degrees,
                turn(arc.sweep),
                point(arc.end)
            )
        }
    }
}

/// The machine's position at a byte.
fn stand(document: &Document, offset: usize) -> Point {
    let text = document.text();
    let line = text.line_of(offset);
    let from = text.line_start(line.saturating_sub(LOOKED_BACK));
    let steps = document.steps_in(from..offset);
    steps
        .iter()
        .rfind(|step| step.range.end <= offset)
        .map_or_else(|| document.begin().0, |step| step.end)
}

/// The ways to begin a line.
fn beginnings(document: &Document, start: usize, offset: usize) -> Vec<Completion> {
    let range = start..offset;
    let word = |text: &str, about| Completion::new(text, about, &range, CompletionKind::Word);
    let mut found = Vec::new();
    let from = snap(stand(document, start));
    for (target, about) in ways_back(&steps::way_before(document, start)) {
        if let (Some(from), Some(to)) = (from, snap(target))
            && from != to
        {
            found.extend(written(&line_block(from, to)).map(|text| word(&text, about)));
        }
    }
    found.push(Completion::snippet(
        "B X B Y B",
        say!(a_block_whose_rest_is_offered),
        "B${1:0}B${2:0}B$0",
        &range,
    ));
    let words = document.words();
    found.push(word(words.pause, say!(pause_for_the_wire)));
    found.push(word(words.end, say!(end_of_the_program)));
    found
}

fn written(block: &Block) -> Option<String> {
    let mut out = Vec::new();
    push_fields(&mut out, Layout::Compact, block, None);
    String::from_utf8(out).ok()
}
