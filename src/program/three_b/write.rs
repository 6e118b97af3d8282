//! Writes paths as one 3B program, which is proved block by block while it is written.

use super::block::Node;
use super::block::PartArc;
use super::encode;
use super::layout::{push_block, push_start_point};
use super::parse::{Item, read_line};
use super::part::{CutCorners, is_concave, mm, rounded_with_tab, unwritable, wire_step};
use super::proof::{Proof, check_line};
use super::stand::Planned;
use super::words::{Word, Words};
use crate::finding::{Side, Unwritable};
use crate::geometry::{Point, Segment, Vector, turn};
use crate::program::encode::encode_all;
use crate::program::grid::point_of;
use crate::program::path::is_tight_in_four_b;
use crate::program::write::{
    BETWEEN_PASSES, CutCorner, Piece, ProofError, Proved, ProvedProgram, TAB_STOP, Writer, cuts,
    does_not_stop, nothing_to_write, room, walk, way,
};
use crate::settings::Effective;
use crate::toolpath::{Finished, Source, WirePath, each};
use std::ops::Range;

/// Blocks that one core reads back at a time.
const AT_A_TIME: usize = 128;

/// Writes the paths as one program and proves it. `unit_mm` is the drawing's unit in mm.
pub fn write(paths: &[WirePath], unit_mm: f64, settings: &Effective) -> Proved<ProvedProgram> {
    write_with(paths, unit_mm, settings, None, &mut |_, _| true)
}

/// As [`write()`]; `go_on` gets the progress every few thousand segments, and ends the work with `false`. `sources` get
/// what each block follows.
pub(crate) fn write_with(
    paths: &[WirePath],
    unit_mm: f64,
    settings: &Effective,
    sources: Option<&mut Vec<Source>>,
    go_on: &mut dyn FnMut(usize, usize) -> bool,
) -> Proved<ProvedProgram> {
    let mut blocks = Blocks::new(settings, None, sources, paths);
    walk(paths, unit_mm * 1000.0, 1.0, go_on, &mut blocks)?;
    blocks.finish(cuts(paths))
}

/// The same for 4B: the part's contour, which the controller offsets by the correction of the settings. Corners between
/// lines get transition arcs of the correction and the margin; a contour that cannot be offset this way is refused.
pub(crate) fn write_four_b(
    paths: &[WirePath],
    unit_mm: f64,
    settings: &Effective,
    sources: Option<&mut Vec<Source>>,
    go_on: &mut dyn FnMut(usize, usize) -> bool,
) -> Proved<ProvedProgram> {
    let (correction, radius) = transitions(settings);
    // Its control offsets all of a program.
    if paths.iter().any(|path| path.on_line) {
        return Err(ProofError::Refused(
            say!(four_b_offsets_all_of_a_program).into(),
        ));
    }
    let is_of_tab = |path: &WirePath| path.cut_off && path.pass > 1;
    if paths.iter().any(is_of_tab) || settings.closing_overlap > 0.0 {
        return Err(ProofError::Refused(say!(four_b_has_no_tab).into()));
    }
    let mut before_last = paths.iter().rev().skip(1);
    if before_last.any(WirePath::is_open) {
        return Err(ProofError::Refused(
            say!(four_b_ends_with_an_open_contour).into(),
        ));
    }
    let mut made = Vec::with_capacity(paths.len());
    let mut corners = CutCorners::default();
    for (index, path) in paths.iter().enumerate().filter(|(_, path)| !path.cut_off) {
        let tab = paths.get(index + 1).filter(|next| next.cut_off);
        made.extend(rounded_with_tab(
            path,
            tab,
            unit_mm * 1000.0,
            correction,
            radius,
            &mut corners,
        )?);
    }
    let paths = made;
    let mut blocks = Blocks::new(
        settings,
        Some(FourB {
            correction,
            radius,
            side: Side::Left,
            direction: None,
        }),
        sources,
        &paths,
    );
    walk(&paths, 1.0, 1.0, go_on, &mut blocks)?;
    let corrections = settings.each_correction().into_iter();
    blocks.made.offsets = corrections.map(|mm| (String::new(), mm)).collect();
    blocks.made.corners = left_in(&corners, settings, unit_mm * 1000.0);
    let rest = rest(settings);
    blocks.made.cut_corners = corners
        .outside
        .iter()
        .map(|&(away, source)| CutCorner {
            source,
            depth: (away - rest) / 1000.0,
            radius: radius / 1000.0,
        })
        .collect();
    blocks.finish(cuts(&paths))
}

/// What the passes leave of a part whose corners are these, in drawing units of so many µm: about a transition the wire runs at the correction
/// of each pass, and takes half its kerf.
fn left_in(corners: &CutCorners, settings: &Effective, scale: f64) -> Option<Finished> {
    let (inside, at) = corners.inside.unzip();
    let outside = corners.outside.iter().map(|(away, _)| *away);
    let outside = outside.fold(0.0, f64::max);
    if inside.is_none() && outside <= 0.0 {
        return None;
    }
    let rest = rest(settings);
    Some(Finished {
        uncut: (inside.unwrap_or(0.0) + rest).max(0.0) / scale,
        at: at.unwrap_or_else(Point::origin) / scale,
        overcut: (outside - rest).max(0.0) / scale,
    })
}

/// What all passes leave along the path, µm.
fn rest(settings: &Effective) -> f64 {
    let corrections = settings.each_correction();
    let rest = corrections.iter().enumerate().map(|(pass, correction)| {
        let half = settings.half_kerf(pass);
        // Half the kerf of the last pass is its correction where nothing else is known.
        let last = (pass + 1 == corrections.len()).then_some(*correction);
        Some((correction - half.or(last)?) * 1000.0)
    });
    rest.flatten().fold(f64::INFINITY, f64::min)
}

/// The correction of the controller and the radius of the transitions, µm.
fn transitions(settings: &Effective) -> (f64, f64) {
    let correction = settings.correction * 1000.0;
    // Whole micrometres, and above the correction whatever the margin.
    let radius = (correction + (settings.margin * 1000.0).max(1.0)).ceil();
    (correction, radius)
}

/// The additional data for proving a 4B program.
struct FourB {
    /// µm.
    correction: f64,
    /// Of its transitions, µm.
    radius: f64,
    side: Side,
    /// The end of the contour's last block.
    direction: Option<Vector>,
}

/// The largest gap in the wire's path at a joint of a part's contour, µm: the blocks' directions are those of a grid.
const WIRE_GAP: f64 = 3.0;

struct Blocks<'a> {
    part: Option<FourB>,
    settings: &'a Effective,
    words: Words<'a>,
    out: Vec<u8>,
    /// The totals so far, in µm.
    made: ProvedProgram,
    proof: Proof,
    sources: Option<&'a mut Vec<Source>>,
    /// The most blocks.
    room: usize,
}

/// A block as it is written.
struct Line {
    /// Bytes of the text, without the line end.
    range: Range<usize>,
    planned: Planned,
    part: Option<PartArc>,
}

impl Writer for Blocks<'_> {
    fn begin(&mut self, from: Option<Node>, first: Node, path: &WirePath) -> Proved {
        if let (Some(part), Some(side)) = (&mut self.part, path.side) {
            (part.side, part.direction) = (side, None);
        } else if path.side.is_some() {
            return Err(ProofError::Refused(
                say!(a_3b_program_cannot_leave_the_correction_to_the_controller).into(),
            ));
        }
        if let Some(from) = from {
            return self.go_over(from, first, path, self.settings);
        }
        self.proof = Proof::from(first);
        if self.settings.header {
            push_start_point(&mut self.out, first);
        }
        Ok(())
    }

    fn pieces(&mut self, pieces: &[Piece]) -> Proved {
        let largest = self.settings.largest_number();
        let left = self.room.saturating_sub(self.made.blocks);
        let encoded = encode_all(
            &encode::Blocks { largest },
            pieces,
            left,
            |Piece { from, to, .. }| say!(no_blocks_within_tolerance_lead_from_to, from, to),
        )?;
        // 4B's radius is the block's own.
        let largest = self.part.is_none().then_some(largest);
        let mut lines = Vec::with_capacity(encoded.iter().map(Vec::len).sum());
        for (piece, block) in encoded.into_iter().flatten() {
            let planned = self.proof.plan(block, largest);
            for planned in planned.map_err(ProofError::Mismatch)? {
                lines.push(self.push_planned(planned, pieces[piece].source)?);
            }
        }
        for piece in pieces {
            self.made.length += piece.segment.length();
        }
        self.prove(&lines)
    }

    fn end(&mut self, _: Node, _: bool) -> Proved {
        self.proof.finish_contour().map_err(ProofError::Mismatch)
    }

    /// Some straight blocks between two pauses would be read as the way to the next contour.
    fn end_open(&mut self, last: Node, _: bool, stops: usize) -> Proved {
        (0..stops).try_for_each(|_| self.stop(last))
    }

    fn stop(&mut self, _: Node) -> Proved {
        self.push_word(self.words.pause, Word::Pause)
    }

    /// In 4B the correction of the next pass is set at the machine.
    fn between_passes(&mut self, at: Node, word: Option<&str>) -> Proved {
        match word {
            Some("") if self.part.is_none() => Ok(()),
            None | Some("") => self.stop(at),
            Some(word) => self.stop_by(BETWEEN_PASSES, word),
        }
    }

    fn stop_before_tab(&mut self, at: Node, word: Option<&str>) -> Proved {
        match word {
            None => self.stop(at),
            Some(word) => self.stop_by(TAB_STOP, word),
        }
    }

    fn move_over(&mut self, from: Node, to: Node) -> Proved {
        let cut = self.made.length;
        self.pieces(&[Piece {
            segment: way(from, to),
            from,
            to,
            source: Source::LeadIn,
        }])?;
        self.made.jumps += self.made.length - cut;
        self.made.length = cut;
        Ok(())
    }

    /// The blocks count from the table's position.
    fn moved_by_hand(&mut self, to: Node) -> Proved {
        self.proof.moved_by_hand(to);
        Ok(())
    }
}

impl<'a> Blocks<'a> {
    fn new(
        settings: &'a Effective,
        part: Option<FourB>,
        sources: Option<&'a mut Vec<Source>>,
        paths: &[WirePath],
    ) -> Blocks<'a> {
        Blocks {
            part,
            room: room(paths, sources.is_some()),
            sources,
            settings,
            words: Words::of(settings),
            out: Vec::new(),
            made: ProvedProgram::default(),
            proof: Proof::from(Node { x: 0, y: 0 }),
        }
    }

    /// A stop by the word that is set under `key`.
    fn stop_by(&mut self, key: &str, word: &str) -> Proved {
        let made = self.push_word(word, Word::Pause);
        made.map_err(|_| does_not_stop(key, word))
    }

    /// Writes a block.
    fn push_planned(&mut self, planned: Planned, source: Source) -> Proved<Line> {
        self.made.blocks += 1;
        if let Some(sources) = &mut self.sources {
            sources.push(source);
        }
        let start = self.out.len();
        let part = self.part_of(&planned, source)?;
        let encoded = &planned.encoded;
        push_block(
            &mut self.out,
            self.settings.layout,
            self.made.blocks,
            &encoded.block,
            part.as_ref(),
            encoded.to,
        );
        Ok(Line {
            range: start..self.out.len() - 1,
            planned,
            part,
        })
    }

    /// Reads lines back, and compares them with the path.
    fn prove(&mut self, lines: &[Line]) -> Proved {
        let (out, words, drift) = (&self.out, &self.words, self.proof.allowed());
        let read = each(lines.len(), AT_A_TIME, |nth| {
            let line = &lines[nth];
            let written = &out[line.range.clone()];
            check_line(written, words, &line.planned, line.part, drift)
        });
        for aside in read {
            let aside = aside.map_err(ProofError::Mismatch)?;
            self.proof.deviation = self.proof.deviation.max(aside);
        }
        Ok(())
    }

    /// The additional part of an arc's 4B block, proved: the wire's arc has a radius, and the wire's path joins before
    /// it.
    fn part_of(
        &mut self,
        Planned { encoded, run, .. }: &Planned,
        source: Source,
    ) -> Proved<Option<PartArc>> {
        let Some(part) = &mut self.part else {
            return Ok(None);
        };
        if matches!(source, Source::LeadIn | Source::LeadOut) {
            part.direction = None;
            return Ok(None);
        }
        if let Some(direction) = part.direction {
            let turn = turn(direction, run.start_tangent());
            if wire_step(turn, part.correction) > WIRE_GAP {
                // As of a side that is hardly longer than a step of the grid.
                let fault = Unwritable::NoTransition {
                    at: mm(point_of(encoded.from)),
                    radius: part.radius / 1e3,
                    turn,
                };
                return Err(unwritable(source, fault));
            }
        }
        part.direction = Some(run.end_tangent());
        let Segment::Arc(arc) = run else {
            return Ok(None);
        };
        let concave = is_concave(arc, part.side);
        let radius = arc.radius.round();
        if concave && is_tight_in_four_b(radius, part.correction) {
            return Err(ProofError::Refused(say!(
                n4b_cannot_have_an_arc_inside_of_which_the_wire_runs,
                radius / 1e3,
                part.correction / 1e3
            )));
        }
        Ok(Some(PartArc {
            radius: radius as i64,
            concave,
        }))
    }

    /// Writes a word between blocks that does `what`, and reads it back: it comes from the settings.
    fn push_word(&mut self, word: &str, what: Word) -> Proved {
        let mut read = Vec::new();
        read_line(word.as_bytes(), 1, &self.words, |item| read.push(item));
        let does = |item: &Item| matches!(item, Item::Word { word, .. } if *word == what);
        let is_read = matches!(&read[..], [item] if does(item));
        if !is_read || !word.bytes().all(|byte| byte.is_ascii_alphanumeric()) {
            return Err(ProofError::Mismatch(say!(
                the_word_between_blocks_cannot_be_read_again,
                word
            )));
        }
        self.out.extend_from_slice(word.as_bytes());
        self.out.push(b'\n');
        Ok(())
    }

    /// `cuts` says that the paths hold more than thread holes.
    fn finish(mut self, cuts: bool) -> Proved<ProvedProgram> {
        if self.made.blocks == 0 && cuts {
            return Err(nothing_to_write());
        }
        self.push_word(self.words.end, Word::End)?;
        let made = ProvedProgram {
            closure: self.proof.drift().into(),
            deviation: self.proof.deviation,
            ..self.made
        };
        made.finished(self.out, 1.0)
    }
}
