//! Writes paths as a program in any language: the walk along the paths, and the proved program.
//!
//! A language supplies a [`Writer`] that writes one piece after another and proves each. The walk snaps the ends to the
//! language's grid, so that a writer gets pieces that always join and return to their start.

use super::grid::{Node, point_of, snap};
use crate::finding::{Finding, sentence};
use crate::geometry::{Arc, Locus, Point, Segment};
use crate::settings::{Effective, Jumps, Lead};
use crate::toolpath::{Finished, Milled, PathSegment, Source, WirePath};
use std::fmt;

/// A program that has been decoded again and compared with its path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProvedProgram {
    pub text: String,
    /// Number of blocks.
    pub blocks: usize,
    /// Length of the cuts in mm, without the ways between contours.
    pub length: f64,
    /// Length of the ways without a cut in mm.
    pub(crate) jumps: f64,
    /// How far the program ends beside its last node, µm, of exact arcs; 0 where ends are written. A controller that counts
    /// steps of whole micrometres stops elsewhere.
    pub(crate) closure: [f64; 2],
    /// Largest distance in µm of the decoded blocks from the path, over their whole length, each from where the program
    /// stands.
    pub(crate) deviation: f64,
    /// How far at most the outlines that the paths follow lie from chords of the drawing for which they hold arcs, µm.
    pub(crate) off_chords: f64,
    /// What the control has to offset by, mm, where it does: the correction of each pass, with the word that says where
    /// the control finds it, which is empty where there is one for all.
    pub(crate) offsets: Vec<(String, f64)>,
    /// What the corners of the program leave of the part, in drawing units, where it holds others than the path.
    pub(crate) corners: Option<Finished>,
    /// The corners that the wire goes round and cuts off, in the order of the cut.
    pub(crate) cut_corners: Vec<CutCorner>,
    /// The totals of milling, for an electrode.
    pub milled: Option<Milled>,
}

/// A corner of a part in place of which the program holds an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CutCorner {
    /// What the piece behind it follows.
    pub(crate) source: Source,
    /// How far it is cut off, and the radius of the arc, mm.
    pub(crate) depth: f64,
    pub(crate) radius: f64,
}

impl ProvedProgram {
    /// The program of a text, whose totals have been counted in steps of its grid.
    pub(super) fn finished(self, text: Vec<u8>, step_um: f64) -> Proved<ProvedProgram> {
        let text = String::from_utf8(text)
            .map_err(|_| ProofError::Mismatch(say!(the_program_is_not_text).into()))?;
        let [length, jumps] = [self.length, self.jumps].map(|steps| steps * step_um / 1000.0);
        Ok(ProvedProgram {
            text,
            length,
            jumps,
            ..self
        })
    }
}

/// What is written, or why it is not.
pub(crate) type Proved<T = ()> = Result<T, ProofError>;

/// Why there is no program.
#[derive(Clone, Debug, PartialEq)]
pub enum ProofError {
    /// The program would differ from the path: an internal error, never the drawing's fault.
    Mismatch(String),
    /// The path, or the settings, cannot be written in this language: a plain sentence.
    Refused(String),
    /// The same for one place of the drawing.
    Unwritable(Box<Finding>),
    /// The program was no longer wanted.
    Cancelled,
}

impl fmt::Display for ProofError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ProofError::Mismatch(sentence) | ProofError::Refused(sentence) => f.write_str(sentence),
            ProofError::Unwritable(finding) => f.write_str(&sentence(finding, 1.0)),
            ProofError::Cancelled => f.write_str(say!(the_path_was_given_up)),
        }
    }
}

impl std::error::Error for ProofError {}

/// The path is shorter than a step of the grid.
pub(crate) fn nothing_to_write() -> ProofError {
    ProofError::Refused(say!(the_path_is_shorter_than_the_smallest_step).into())
}

/// The word that is set under `key` does not stop the machine in this language.
pub(super) fn does_not_stop(key: &str, word: &str) -> ProofError {
    ProofError::Refused(say!(a_word_does_not_stop, key, word))
}

/// The keys of the words that stop the machine before a tab is cut off, and between passes.
pub(super) const TAB_STOP: &str = "program.tab-stop";
pub(super) const BETWEEN_PASSES: &str = "program.pause-between-passes";

/// No number of a program reaches `point`, which is in steps of its grid.
pub(crate) fn too_far_out(point: Point) -> ProofError {
    ProofError::Refused(say!(
        the_path_passes_too_far_out_for_a_program,
        point.x,
        point.y
    ))
}

/// The largest gap between consecutive pieces of a path, µm.
const GAP: f64 = 1.5;

/// What is as short as this between two pieces that are at least as long as [`LONG`], µm, is left out: a control reads it as no block at all,
/// or as one that turns back.
const SPECK: f64 = 2.0;
const LONG: f64 = 10.0;

/// Pieces that are handed to a writer at a time.
const PIECES: usize = 4096;

/// The most blocks of a program: no control, and no person, takes as many.
pub(super) const MOST_BLOCKS: usize = 2_000_000;
/// What is written to be compared or offered has at most this many blocks for each segment or block that it comes from,
/// and, in a comparison, as many more.
pub(super) const MOST_FOR_EACH: usize = 16;
const MORE: usize = 1_000;

/// The room for blocks in a program along these paths; less where it is only written to be `compared`.
pub(super) fn room(paths: &[WirePath], compared: bool) -> usize {
    let segments: usize = paths.iter().map(|path| path.segments.len()).sum();
    match compared {
        true => MOST_BLOCKS.min(MOST_FOR_EACH * segments + MORE),
        false => MOST_BLOCKS,
    }
}

/// A program along the path would have more blocks than there is room for.
pub(super) fn too_many_blocks() -> ProofError {
    ProofError::Refused(say!(the_program_would_have_too_many_blocks, MOST_BLOCKS))
}

/// A piece of a path between two nodes, which are its snapped ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) segment: Segment,
    pub(crate) from: Node,
    pub(crate) to: Node,
    pub(crate) source: Source,
}

/// Puts pieces of a path into the text of one language and proves them. Nodes and pieces are in steps of the language's grid.
pub(crate) trait Writer {
    /// A path begins at `first`. `from` is the program's position, `None` before the first path: the wire must be taken
    /// there.
    fn begin(&mut self, from: Option<Node>, first: Node, path: &WirePath) -> Proved;
    /// Pieces of the path, one after the other.
    fn pieces(&mut self, pieces: &[Piece]) -> Proved;
    /// The path ends at `last`. `goes_on`: after a stop the next one continues it from here.
    fn end(&mut self, last: Node, goes_on: bool) -> Proved;
    /// A path along an open contour ended at `last`. `for_good`: the contour is complete, and the wire does not return
    /// to the thread hole. `stops` more stops, two with those before the next path, show that this is meant.
    fn end_open(&mut self, last: Node, for_good: bool, stops: usize) -> Proved;

    /// The machine stops, or an automatic one takes the wire out and threads it.
    fn stop(&mut self, at: Node) -> Proved;
    /// The next pass of the same contour begins: the machine stops by a `word` of the settings, an empty one for no stop, else as it does
    /// in this language.
    fn between_passes(&mut self, at: Node, word: Option<&str>) -> Proved;
    /// The machine stops for certain, by a `word` of the settings if one is set: a tab is cut off next.
    fn stop_before_tab(&mut self, at: Node, word: Option<&str>) -> Proved;
    /// The table moves without the wire.
    fn move_over(&mut self, from: Node, to: Node) -> Proved;
    /// The table has been moved by hand.
    fn moved_by_hand(&mut self, to: Node) -> Proved;

    /// From one path to the next: the wire is taken out, the table moves, the wire is threaded; from pass to pass it stays where it is.
    fn go_over(&mut self, from: Node, to: Node, path: &WirePath, settings: &Effective) -> Proved {
        if path.goes_back_along_tab() && from == to {
            return Ok(());
        }
        let is_skim = path.pass > 1 && !path.is_way_back && from == to;
        // Where a tab stands, a pass runs on past its start, or arcs lead to it, only stops show where it ends.
        let is_simple = settings.closing_overlap == 0.0 && settings.lead != Lead::Arc;
        let shows = path.returns() && is_simple;
        let word = settings.pause_between_passes.as_deref();
        match path.cut_off && path.pass == 1 {
            true => self.stop_before_tab(from, settings.tab_stop.as_deref())?,
            false if is_skim && (shows || word.is_some_and(|word| !word.is_empty())) => {
                self.between_passes(from, word)?;
            }
            false => self.stop(from)?,
        }
        match settings.jumps {
            _ if from == to => Ok(()),
            Jumps::Blocks => {
                self.move_over(from, to)?;
                self.stop(to)
            }
            Jumps::None => self.moved_by_hand(to),
        }
    }
}

/// Walks along the paths. `steps` is the drawing's unit in steps of the grid, `step_um` one step in µm. `go_on` gets the progress every few
/// thousand segments, and ends the work with `false`.
pub(crate) fn walk(
    paths: &[WirePath],
    steps: f64,
    step_um: f64,
    go_on: &mut dyn FnMut(usize, usize) -> bool,
    writer: &mut dyn Writer,
) -> Proved {
    let total = paths.iter().map(|path| path.segments.len()).sum();
    let (mut done, mut told) = (0, 0);
    let mut node: Option<Node> = None;
    let mut pieces: Vec<Piece> = Vec::new();
    for (index, path) in paths.iter().enumerate() {
        // Where the wire can only stand, it is threaded and cuts nothing.
        let (begin, end) = (path.begin() * steps, path.end() * steps);
        let first_node = node_of(begin)?;
        writer.begin(node, first_node, path)?;
        let mut from = first_node;
        let mut reached = begin;
        let (mut place, mut left_out) = (0, 0);
        for segments in path.segments.chunks(PIECES) {
            if done >= told {
                told = done + PIECES;
                if !go_on(done, total) {
                    return Err(ProofError::Cancelled);
                }
            }
            pieces.clear();
            for own in segments {
                done += 1;
                let segment = scaled(&own.geometry, steps);
                let gap = (segment.start() - reached).norm() * step_um;
                if gap > GAP || gap.is_nan() {
                    return Err(ProofError::Mismatch(say!(
                        the_path_has_a_gap_before_a_segment,
                        gap,
                        done
                    )));
                }
                reached = segment.end();
                place += 1;
                if left_out > 0 {
                    left_out -= 1;
                    continue;
                }
                let to = match specks_behind(path, place - 1, steps * step_um) {
                    Some((count, meeting)) => {
                        left_out = count;
                        node_of(meeting * steps)?
                    }
                    None => node_of(reached)?,
                };
                pieces.push(Piece {
                    segment,
                    from,
                    to,
                    source: own.source,
                });
                // A skipped piece leaves the node where it is, as both its ends.
                from = to;
            }
            writer.pieces(&pieces)?;
        }
        let closed = (begin - end).norm() * step_um <= 1e-3;
        let goes_on = paths.get(index + 1).is_some_and(|next| {
            next.cut_off
                && (next.pass, next.side) == (path.pass, path.side)
                && next.begin() == path.end()
        });
        if closed && first_node != from {
            let sentence = say!(the_cut_begins_at_and_ends_at, first_node, from);
            return Err(ProofError::Mismatch(sentence));
        }
        writer.end(from, goes_on)?;
        if path.is_open() {
            let next = paths.get(index + 1);
            let is_last = next.is_none_or(|next| next.outline != path.outline);
            let for_good = is_last && path.end() != path.thread_hole;
            writer.end_open(from, for_good, 1 + usize::from(next.is_none()))?;
        }
        node = Some(from);
    }
    Ok(())
}

/// How many pieces behind one of a path beside its contour are left out, and where the ones before and behind them meet, in drawing units;
/// `um` is the drawing's unit.
fn specks_behind(path: &WirePath, at: usize, um: f64) -> Option<(usize, Point)> {
    if path.side.is_some() || path.correction <= 0.0 {
        return None;
    }
    let is_of_contour = |piece: &&PathSegment| {
        matches!(piece.source, Source::Segment { .. } | Source::Corner { .. })
    };
    let is_long = |piece: &&PathSegment| piece.geometry.length() * um >= LONG;
    let before = path
        .segments
        .get(at)
        .filter(is_of_contour)
        .filter(is_long)?;
    let mut behind = path.segments[at + 1..].iter();
    let (mut count, mut length) = (0, 0.0);
    let next = loop {
        let piece = behind.next().filter(is_of_contour)?;
        if is_long(&piece) {
            break piece;
        }
        count += 1;
        length += piece.geometry.length() * um;
        if length > SPECK {
            return None;
        }
    };
    if count == 0 {
        return None;
    }
    let (before, next) = (&before.geometry, &next.geometry);
    let middle = nalgebra::center(&before.end(), &next.start());
    let met = Locus::of(before).meet(&Locus::of(next)).into_iter();
    let met = met.min_by(|a, b| (a - middle).norm().total_cmp(&(b - middle).norm()));
    let is_there = |point: &Point| (point - middle).norm() * um <= SPECK / 2.0;
    Some((count, met.filter(is_there).unwrap_or(middle)))
}

/// True where there is anything to cut: not where the wire only stands in each hole.
pub(crate) fn cuts(paths: &[WirePath]) -> bool {
    paths.is_empty() || paths.iter().any(|path| !path.segments.is_empty())
}

pub(crate) fn node_of(point: Point) -> Proved<Node> {
    snap(point).ok_or_else(|| too_far_out(point))
}

/// The way between two paths.
pub(crate) fn way(from: Node, to: Node) -> Segment {
    Segment::line(point_of(from), point_of(to))
}

/// The same segment in other units.
pub(crate) fn scaled(segment: &Segment, scale: f64) -> Segment {
    match segment {
        Segment::Line(line) => Segment::line(line.start * scale, line.end * scale),
        Segment::Arc(arc) => Segment::Arc(Arc {
            center: arc.center * scale,
            radius: arc.radius * scale,
            start: arc.start * scale,
            end: arc.end * scale,
            ..*arc
        }),
    }
}

/// Appends a number, right-aligned in `width` columns, wider where it does not fit.
pub(super) fn push_number(out: &mut Vec<u8>, mut value: u64, width: usize) {
    let mut digits = [b' '; 20];
    let mut first = digits.len();
    loop {
        first -= 1;
        digits[first] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[first.min(digits.len() - width.min(digits.len()))..]);
}

/// Appends the last `count` digits of a number, zeros in front of them too.
pub(super) fn push_places(out: &mut Vec<u8>, value: u64, count: u32) {
    for place in (0..count).rev() {
        out.push(b'0' + (value / 10_u64.pow(place) % 10) as u8);
    }
}
