//! Paths to the text of one 3B program that is proved block by block while it is written.

use super::block::Node;
use super::encode::{Encoded, encode};
use super::layout::{push_block, push_start_point};
use super::parse::{Item, Word, Words, read_line};
use super::proof::Proof;
use crate::finding::Side;
use crate::geometry::Segment;
use crate::program::write::{ProofError, ProvedProgram, Writer, walk, way};
use crate::settings::{Effective, Jumps, Layout};
use crate::toolpath::{Source, WirePath};

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
    let mut blocks = Blocks {
        settings,
        words: Words { pause: settings.pause.trim(), end: settings.end.trim() },
        out: Vec::new(),
        blocks: 0,
        length: 0.0,
        proof: Proof::default(),
        encoded: Vec::new(),
    };
    walk(paths, unit_mm * 1000.0, 1.0, go_on, &mut blocks)?;
    blocks.finish()
}

struct Blocks<'a> {
    settings: &'a Effective,
    words: Words<'a>,
    out: Vec<u8>,
    blocks: usize,
    /// µm.
    length: f64,
    proof: Proof,
    encoded: Vec<Encoded>,
}

impl Writer for Blocks<'_> {
    /// From one contour to the next the wire is taken out, the table moves, the wire is threaded.
    fn begin(&mut self, from: Option<Node>, first: Node, side: Option<Side>) -> Result<(), ProofError> {
        if side.is_some() {
            return Err(ProofError::Refused(
                "a 3B program cannot leave the correction to the controller: set compensation to path, or to none where the contour is the wire's path".into(),
            ));
        }
        let Some(from) = from else {
            if self.settings.layout != Layout::Compact {
                push_start_point(&mut self.out, first);
            }
            return Ok(());
        };
        self.word(Word::Pause)?;
        if self.settings.jumps == Jumps::Blocks && from != first {
            self.piece(&way(from, first), from, first, Source::LeadIn)?;
            self.word(Word::Pause)?;
        }
        Ok(())
    }

    fn piece(&mut self, piece: &Segment, from: Node, to: Node, _source: Source) -> Result<(), ProofError> {
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
        self.length += piece.length();
        self.encoded = encoded;
        Ok(())
    }

    fn end(&mut self, closed: bool, first: Node, last: Node) -> Result<(), ProofError> {
        self.proof.finish_contour(closed, first, last).map_err(ProofError::Mismatch)
    }
}

impl Blocks<'_> {
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
}
