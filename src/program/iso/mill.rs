//! Writes paths of an electrode as one ISO program: layer by layer, each line read back at once.
//!
//! The electrode stands above the entry of a contour, is fed down, goes to and fro along the contour and comes up
//! again. Heights count from the surface; a line moves either along the way or in height. What is written also steers
//! a simulation of the wear.

use super::block::{Block, Motion};
use super::write::Lines;
use crate::geometry::Segment;
use crate::program::grid::Node;
use crate::program::write::{
    MOST_BLOCKS, Piece, ProofError, Proved, ProvedProgram, Writer, node_of, nothing_to_write,
    scaled, too_many_blocks,
};
use crate::settings::{Coordinates, Effective};
use crate::toolpath::milling::{Floor, Layers, Step, swept_length};
use crate::toolpath::{Milled, MilledContour, Source, WirePath};

/// The height above the surface of the ways between contours, mm.
const CLEARANCE: f64 = 1.0;

/// The most blocks of a program to be compared.
const MOST_COMPARED: usize = 200_000;

/// Writes the electrode's paths as one program and proves it. `unit_mm` is the drawing's unit in mm; `go_on` gets the
/// number of contours done and of all, and ends the work with `false`. A program that is to be compared gets the
/// `sources` of its moves, and is not written where it is long.
pub(crate) fn write_milled(
    paths: &[WirePath],
    unit_mm: f64,
    settings: &Effective,
    sources: Option<&mut Vec<Source>>,
    go_on: &mut dyn FnMut(usize, usize) -> bool,
) -> Proved<ProvedProgram> {
    let electrode = settings.electrode().map_err(ProofError::Refused)?;
    let mut lines = Lines::of(settings)?;
    let per_mm = lines.per_mm();
    if electrode.layer * per_mm < 1.0 {
        let sentence = say!(a_layer_is_finer, electrode.layer, 1.0 / per_mm);
        return Err(ProofError::Refused(sentence));
    }
    let clear = (CLEARANCE * per_mm).round() as i64;
    let (mut fed_before, mut worn) = (0.0, 0.0);
    let mut contours = Vec::with_capacity(paths.len());
    let mut tool: Option<Tool> = None;
    let mut room = match sources {
        Some(_) => MOST_COMPARED,
        None => MOST_BLOCKS,
    };
    lines.sources = sources;
    for (done, path) in paths.iter().enumerate() {
        let way = FeedPath::of(path, unit_mm, per_mm);
        let layers = Layers {
            electrode,
            length: way.length(),
            swept: FeedPath::swept(path, unit_mm, electrode.width()),
            is_closed: path.counter_clockwise.is_some(),
            fed_before,
        };
        if layers.length * per_mm < 1.0 {
            return Err(nothing_to_write());
        }
        let blocks = layers.blocks(way.pieces.len());
        room = room.checked_sub(blocks).ok_or_else(too_many_blocks)?;
        let first = node_of(path.begin() * (unit_mm * per_mm))?;
        let mut over = match tool.take() {
            None => {
                lines.begin(None, first, path)?;
                Tool {
                    at: first,
                    height: 0,
                    waiting: None,
                }
            }
            Some(tool) => tool,
        };
        over.goes_over(first, clear, &mut lines)?;
        let mut floor = Floor::new(&layers, worn);
        let mut last = 0.0;
        fed_before = layers.each(&mut |step| {
            if !go_on(done, paths.len()) {
                return Err(ProofError::Cancelled);
            }
            match step {
                Step::Feed(depth) => {
                    floor.feed(depth);
                    last = depth;
                    over.feeds(depth, &way, &mut lines)
                }
                Step::Along { from, to } => {
                    floor.along(from, to);
                    over.goes_on(from, to, &way, &mut lines)
                }
            }
        })?;
        over.goes_along(&way, &mut lines)?;
        over.goes_to(Motion::Rapid, clear, &mut lines)?;
        tool = Some(over);
        worn = floor.worn;
        let feed_along = match electrode.step > 0.0 {
            true => layers.wear_along() * electrode.layer,
            false => 0.0,
        };
        contours.push(MilledContour {
            outline: path.outline,
            length: layers.length,
            wear_of_layer: layers.wear(),
            feed: layers.feed(electrode.layer),
            last_feed: layers.feed(electrode.last_layer()),
            feed_along,
            fed: last,
            floor: floor.depths(),
            worn,
        });
    }
    Ok(ProvedProgram {
        milled: Some(Milled {
            electrode,
            contours,
        }),
        ..lines.finish(true)?
    })
}

/// The path along a contour.
struct FeedPath {
    /// Each piece in steps of the grid, and the distance of its start along the way, mm.
    pieces: Vec<(f64, Segment, Source)>,
    /// The distance at each end of a piece, mm: one more than there are pieces.
    ends: Vec<f64>,
}

impl FeedPath {
    fn of(path: &WirePath, unit_mm: f64, per_mm: f64) -> FeedPath {
        let mut ends = vec![0.0];
        let mut pieces = Vec::with_capacity(path.segments.len());
        let mut at = 0.0;
        for piece in &path.segments {
            let geometry = scaled(&piece.geometry, unit_mm * per_mm);
            pieces.push((at, geometry, piece.source));
            at += piece.geometry.length() * unit_mm;
            ends.push(at);
        }
        FeedPath { pieces, ends }
    }

    /// The length of a straight way that takes as much of this width, mm.
    fn swept(path: &WirePath, unit_mm: f64, width: f64) -> f64 {
        let pieces = path.segments.iter();
        let pieces: Vec<Segment> = pieces.map(|it| scaled(&it.geometry, unit_mm)).collect();
        swept_length(&pieces, path.counter_clockwise.is_some(), width)
    }

    fn length(&self) -> f64 {
        self.ends.last().copied().unwrap_or_default()
    }

    /// The pieces between two places, in the direction from the first to the second.
    fn between(&self, from: f64, to: f64) -> Vec<(Segment, Source)> {
        /// A smaller share of a piece is none.
        const NOTHING: f64 = 1e-9;
        let (least, most) = (from.min(to), from.max(to));
        let first = self.ends.partition_point(|end| *end <= least).max(1) - 1;
        let concerned = self.pieces.iter().zip(&self.ends[1..]).skip(first);
        let concerned = concerned.take_while(|((begin, ..), _)| *begin < most);
        let parts = concerned.filter_map(|((begin, piece, source), end)| {
            let share = |at: f64| ((at - begin) / (end - begin)).clamp(0.0, 1.0);
            let (from, to) = (share(least), share(most));
            if to - from <= NOTHING || (to - from).is_nan() {
                return None;
            }
            let is_whole = from <= NOTHING && to >= 1.0 - NOTHING;
            let part = if is_whole {
                *piece
            } else {
                piece.part(from, to)
            };
            Some((part, *source))
        });
        let mut parts: Vec<_> = parts.collect();
        if to < from {
            parts.reverse();
            parts
                .iter_mut()
                .for_each(|(part, _)| *part = part.reversed());
        }
        parts
    }
}

/// The electrode's position, in steps of the grid.
struct Tool {
    at: Node,
    /// Above the surface.
    height: i64,
    /// The way since the last feed that leads to another place of the grid.
    waiting: Option<(f64, f64)>,
}

impl Tool {
    /// Down to a depth, mm, from where the way so far has led.
    fn feeds(&mut self, depth: f64, way: &FeedPath, lines: &mut Lines<'_>) -> Proved {
        let height = -(depth * lines.per_mm()).round() as i64;
        if height == self.height {
            return Ok(());
        }
        self.goes_along(way, lines)?;
        self.goes_to(Motion::Line, height, lines)
    }

    /// A piece of the way, which is written once it ends or turns back.
    fn goes_on(&mut self, from: f64, to: f64, way: &FeedPath, lines: &mut Lines<'_>) -> Proved {
        match &mut self.waiting {
            Some((begin, end)) if *end == from && (*begin < *end) == (from < to) => *end = to,
            _ => {
                self.goes_along(way, lines)?;
                self.waiting = Some((from, to));
            }
        }
        Ok(())
    }

    /// Up, and over the entry of a contour.
    fn goes_over(&mut self, first: Node, clear: i64, lines: &mut Lines<'_>) -> Proved {
        if self.height != clear {
            self.goes_to(Motion::Rapid, clear, lines)?;
        }
        if self.at == first {
            return Ok(());
        }
        lines.move_over(self.at, first)?;
        self.at = first;
        Ok(())
    }

    fn goes_to(&mut self, motion: Motion, height: i64, lines: &mut Lines<'_>) -> Proved {
        lines.height_out(motion, self.height, height)?;
        self.height = height;
        Ok(())
    }

    fn goes_along(&mut self, way: &FeedPath, lines: &mut Lines<'_>) -> Proved {
        let Some((from, to)) = self.waiting.take() else {
            return Ok(());
        };
        let mut pieces = Vec::new();
        for (segment, source) in way.between(from, to) {
            let end = node_of(segment.end())?;
            pieces.push(Piece {
                segment,
                from: self.at,
                to: end,
                source,
            });
            self.at = end;
        }
        lines.pieces(&pieces)
    }
}

impl Lines<'_> {
    /// Writes a move up or down, and reads it back.
    fn height_out(&mut self, motion: Motion, from: i64, to: i64) -> Proved {
        let start = self.out.len();
        let mut out = std::mem::take(&mut self.out);
        let mut separate = self.push_head(&mut out, motion);
        separate.push(&mut out, b"Z");
        let written = match self.profile.coordinates {
            Coordinates::Absolute => to,
            Coordinates::Incremental => to - from,
        };
        self.push_length(&mut out, written);
        self.out = out;
        let block = Block::of(&self.out[start..]);
        let made = self.machine.run(&block, &self.reading);
        let read = block.z.map(|z| self.reading.length(z, self.machine.inch));
        let is_absolute = self.profile.coordinates == Coordinates::Absolute;
        if made.is_some()
            || read != Some(written * self.step)
            || self.machine.motion != motion
            || self.machine.incremental == is_absolute
        {
            let line = String::from_utf8_lossy(&self.out[start..]);
            return Err(self.refused(&say!(its_lines_change_heights, line)));
        }
        self.end_line();
        self.made.blocks += 1;
        Ok(())
    }
}
