//! Paths to the text of one program that is proved block by block while it is written.

use super::block::Node;
use super::encode::{END_TOLERANCE, Encoded, encode, point_of, snap};
use super::layout::{push_block, push_start_point};
use super::parse::{Item, Word, Words, read_line};
use super::proof::Proof;
use crate::geometry::{Arc, Point, Segment};
use crate::settings::{Effective, Jumps, Layout};
use crate::toolpath::WirePath;
use std::fmt;

/// A program that has been decoded again and held against its path.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedProgram {
    pub text: String,
    /// Number of blocks.
    pub blocks: usize,
    /// Length of the path in mm, jumps included.
    pub length: f64,
    /// Drift in µm that a controller which only counts J accumulates on the way round.
    pub closure: [f64; 2],
    /// Largest distance in µm between a decoded block's end and the path's node.
    pub deviation: f64,
}

/// Why no program came out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProofError {
    /// The program would not have been the path: an internal error, never the drawing's fault.
    Mismatch(String),
    /// The program was not wanted any more.
    Cancelled,
}

impl fmt::Display for ProofError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ProofError::Mismatch(sentence) => f.write_str(sentence),
            ProofError::Cancelled => f.write_str("cancelled"),
        }
    }
}

impl std::error::Error for ProofError {}

/// Writes the paths as one program and proves it. `unit_mm` is the drawing's unit in mm.
pub fn write(paths: &[WirePath], unit_mm: f64, settings: &Effective) -> Result<ProvedProgram, ProofError> {
    write_with(paths, unit_mm, settings, &mut |_, _| true)
}

/// As [`write()`]; `go_on` hears every few thousand segments how many are done and how many there are, and ends the work with `false`.
pub fn write_with(
    paths: &[WirePath],
    unit_mm: f64,
    settings: &Effective,
    go_on: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<ProvedProgram, ProofError> {
    let total = paths.iter().map(|path| path.segments.len()).sum();
    let mut writer = Writer::new(settings, unit_mm * 1000.0, total, go_on);
    for path in paths.iter().filter(|path| !path.segments.is_empty()) {
        writer.path(path)?;
    }
    writer.finish()
}

struct Writer<'a> {
    settings: &'a Effective,
    words: Words<'a>,
    /// µm in one drawing unit.
    scale: f64,
    out: Vec<u8>,
    /// Where the program stands; `None` before its first block.
    node: Option<Node>,
    blocks: usize,
    /// µm.
    length: f64,
    proof: Proof,
    encoded: Vec<Encoded>,
    done: usize,
    total: usize,
    go_on: &'a mut dyn FnMut(usize, usize) -> bool,
}

impl<'a> Writer<'a> {
    fn new(settings: &'a Effective, scale: f64, total: usize, go_on: &'a mut dyn FnMut(usize, usize) -> bool) -> Writer<'a> {
        Writer {
            settings,
            words: Words { pause: settings.pause.trim(), end: settings.end.trim() },
            scale,
            out: Vec::new(),
            node: None,
            blocks: 0,
            length: 0.0,
            proof: Proof::default(),
            encoded: Vec::new(),
            done: 0,
            total,
            go_on,
        }
    }

    fn path(&mut self, path: &WirePath) -> Result<(), ProofError> {
        let (Some(first), Some(last)) = (path.segments.first(), path.segments.last()) else { return Ok(()) };
        let (begin, end) = (self.scaled_point(first.geometry.start()), self.scaled_point(last.geometry.end()));
        let first_node = node_of(begin)?;
        match self.node {
            None if self.settings.layout != Layout::Compact => push_start_point(&mut self.out, first_node),
            None => {}
            Some(node) => self.jump(node, first_node)?,
        }
        self.node = Some(first_node);
        let mut reached = begin;
        for segment in &path.segments {
            if self.done.is_multiple_of(4096) && !(self.go_on)(self.done, self.total) {
                return Err(ProofError::Cancelled);
            }
            self.done += 1;
            let piece = scaled(&segment.geometry, self.scale);
            let gap = (piece.start() - reached).norm();
            if gap > END_TOLERANCE || gap.is_nan() {
                return Err(ProofError::Mismatch(format!("the path has a gap of {gap:.3} µm before segment {}", self.done)));
            }
            reached = piece.end();
            self.piece(&piece)?;
        }
        let closed = (begin - end).norm() <= 1e-3;
        let last_node = self.node.unwrap_or(first_node);
        self.proof.finish_contour(closed, first_node, last_node).map_err(ProofError::Mismatch)
    }

    /// From one contour to the next: the wire is taken out, the table moves, the wire is threaded.
    fn jump(&mut self, from: Node, to: Node) -> Result<(), ProofError> {
        self.word(Word::Pause)?;
        if self.settings.jumps == Jumps::Blocks && from != to {
            self.piece(&Segment::line(point_of(from), point_of(to)))?;
            self.word(Word::Pause)?;
        }
        Ok(())
    }

    /// Writes the blocks of one piece, µm, and proves each of them.
    fn piece(&mut self, piece: &Segment) -> Result<(), ProofError> {
        let to = node_of(piece.end())?;
        let from = self.node.unwrap_or(to);
        let mut encoded = std::mem::take(&mut self.encoded);
        encoded.clear();
        encode(piece, from, to, &mut encoded)
            .ok_or_else(|| ProofError::Mismatch(format!("no blocks within tolerance lead from {from:?} to {to:?}")))?;
        for block in &encoded {
            self.blocks += 1;
            let start = self.out.len();
            push_block(&mut self.out, self.settings.layout, self.blocks, &block.block, block.to);
            let line = &self.out[start..self.out.len() - 1];
            self.proof.check_line(line, &self.words, block).map_err(ProofError::Mismatch)?;
        }
        // A skipped piece leaves the node where it is, and both its ends are that node.
        self.node = Some(to);
        self.length += piece.length();
        self.encoded = encoded;
        Ok(())
    }

    /// Writes a pause or end word, and reads it again: it comes from the settings.
    fn word(&mut self, meaning: Word) -> Result<(), ProofError> {
        let word = match meaning {
            Word::Pause => self.words.pause,
            Word::End => self.words.end,
        };
        let mut read = Vec::new();
        read_line(word.as_bytes(), 1, &self.words, |item| read.push(item));
        let sound = matches!(read[..], [Item::Word { .. }]) && word.bytes().all(|byte| byte.is_ascii_alphanumeric());
        if !sound {
            return Err(ProofError::Mismatch(format!(
                "the word {word:?} between blocks cannot be read again, expected letters and digits"
            )));
        }
        self.out.extend_from_slice(word.as_bytes());
        self.out.push(b'\n');
        Ok(())
    }

    fn finish(mut self) -> Result<ProvedProgram, ProofError> {
        if self.blocks == 0 {
            return Err(ProofError::Mismatch("the path holds no block".into()));
        }
        self.word(Word::End)?;
        let text = String::from_utf8(self.out).map_err(|_| ProofError::Mismatch("the program is not text".into()))?;
        Ok(ProvedProgram {
            text,
            blocks: self.blocks,
            length: self.length / 1000.0,
            closure: [self.proof.drift.x, self.proof.drift.y],
            deviation: self.proof.deviation,
        })
    }

    fn scaled_point(&self, point: Point) -> Point {
        point * self.scale
    }
}

fn node_of(point: Point) -> Result<Node, ProofError> {
    snap(point).ok_or_else(|| ProofError::Mismatch(format!("the path passes {point:?} µm, too far out for a program")))
}

/// The same segment in µm.
fn scaled(segment: &Segment, scale: f64) -> Segment {
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
