//! The blocks: parts that share edges, and contours that lines divide.

use super::{Block, CommonLine, Part, Search, part_of, turned};
use crate::drawing::{ContourSegment, Outline, winding_of};
use crate::finding::Finding;
use crate::geometry::{Bounds, Point, turn};
use std::f64::consts::PI;

/// Where several common lines meet, one goes on in another that turns by less than this, radians.
pub(super) const STRAIGHT: f64 = 1e-3;

/// A stretch of an outline that no other part has.
struct Own {
    segment: ContourSegment,
    /// The next one, where its own part goes on so.
    next: Option<usize>,
    /// A common line ends before it.
    begins: bool,
}

/// An open contour without a side.
struct Open {
    outline: usize,
    workpiece: u16,
    about: Bounds,
    segments: Vec<ContourSegment>,
}

impl Search<'_> {
    /// Parts that share edges, as one outline and the lines between them.
    pub(super) fn block(&self, parts: &[Part], members: &[usize]) -> Result<Block, Finding> {
        let mut own: Vec<Own> = Vec::new();
        let mut edges: Vec<CommonLine> = Vec::new();
        for &member in members {
            let part = &parts[member];
            self.add_own(part, &mut own)?;
            // Of two parts the later one gives the edge: the outline has the name of the first.
            for shared in part.shared.iter().filter(|shared| shared.with < member) {
                edges.push(CommonLine {
                    segments: vec![part.stretch(shared)],
                    parts: vec![shared.with, member],
                    divider: None,
                });
            }
        }
        let outline = self.round(&own, &edges)?;
        let lines = self.chained(edges, &outline);
        for line in &lines {
            self.is_cut_through(line, &outline)?;
        }
        Ok(Block {
            parts: members
                .iter()
                .map(|&member| parts[member].outline)
                .collect(),
            workpiece: parts[members[0]].workpiece,
            outline,
            lines,
        })
    }

    /// What a part has alone, in its direction.
    fn add_own(&self, part: &Part, all: &mut Vec<Own>) -> Result<(), Finding> {
        // What is shared is none.
        let mut stretches: Vec<Option<ContourSegment>> = Vec::new();
        let mut shared = part.shared.iter().peekable();
        for (index, wall) in part.walls.iter().enumerate() {
            let length = wall.geometry.length();
            let alone = |from: f64, to: f64| {
                let is_any = (to - from) * length > self.least;
                is_any.then(|| Some(part_of(wall, from, to)))
            };
            let (mut done, mut is_whole) = (0.0, true);
            while let Some(next) = shared.next_if(|next| next.wall == index) {
                if next.is_alike {
                    return Err(self.refused(wall, say!(both_lie_on_one_side_of_it).into()));
                }
                if (done - next.from) * length > self.least {
                    return Err(self.refused(wall, say!(three_parts_share_it).into()));
                }
                stretches.extend(alone(done, next.from));
                stretches.push(None);
                (done, is_whole) = (next.to, false);
            }
            match is_whole {
                true => stretches.push(Some(*wall)),
                false => stretches.extend(alone(done, 1.0)),
            }
        }
        let (first, count) = (all.len(), stretches.len());
        let mut number = first;
        let numbers: Vec<Option<usize>> = stretches
            .iter()
            .map(|stretch| {
                stretch.map(|_| {
                    number += 1;
                    number - 1
                })
            })
            .collect();
        for (at, stretch) in stretches.iter().enumerate() {
            all.extend(stretch.map(|segment| Own {
                segment,
                next: numbers[(at + 1) % count],
                begins: stretches[(at + count - 1) % count].is_none(),
            }));
        }
        Ok(())
    }

    /// The way round a block.
    fn round(&self, own: &[Own], edges: &[CommonLine]) -> Result<Vec<ContourSegment>, Finding> {
        let refused = |reason: String| self.refused(&edges[0].segments[0], reason);
        let (mut outline, mut is_done) = (Vec::new(), vec![false; own.len()]);
        let mut next = 0;
        while let Some(stretch) = own.get(next)
            && !std::mem::replace(&mut is_done[next], true)
        {
            outline.push(stretch.segment);
            let end = stretch.segment.geometry.end();
            let mut meeting = own.iter().enumerate().filter(|(_, other)| {
                other.begins && (other.segment.geometry.start() - end).norm() <= self.joint()
            });
            next = match stretch.next {
                Some(next) => next,
                None => match (meeting.next(), meeting.next()) {
                    (Some((only, _)), None) => only,
                    _ => {
                        let at = end * self.unit_mm;
                        return Err(refused(say!(several_meet_at_a_corner, at.x, at.y)));
                    }
                },
            };
        }
        if let Some(enclosed) = is_done.iter().position(|is_done| !is_done) {
            let at = own[enclosed].segment.geometry.start() * self.unit_mm;
            return Err(refused(say!(they_enclose_a_place, at.x, at.y)));
        }
        Ok(outline)
    }

    /// Ends of edges of two parts that are one edge are one point within this.
    fn joint(&self) -> f64 {
        2.0 * self.same_place
    }

    /// Edges joined to lines, each as far as the outline, or as it goes on alone or straight.
    fn chained(&self, mut edges: Vec<CommonLine>, outline: &[ContourSegment]) -> Vec<CommonLine> {
        let mut lines = Vec::new();
        while let Some(mut line) = edges.pop() {
            for _ in 0..2 {
                while let Some(last) = line.segments.last().map(|last| last.geometry)
                    && !self.lies_on(outline, last.end())
                {
                    let mut met: Vec<(usize, CommonLine, f64)> = Vec::new();
                    for (place, edge) in edges.iter().enumerate() {
                        for segment in [edge.segments[0], edge.segments[0].turned()] {
                            let on = segment.geometry;
                            if (on.start() - last.end()).norm() <= self.joint() {
                                let edge = CommonLine {
                                    segments: vec![segment],
                                    parts: edge.parts.clone(),
                                    divider: None,
                                };
                                let bend = turn(last.end_tangent(), on.start_tangent());
                                met.push((place, edge, bend.abs()));
                            }
                        }
                    }
                    let is_alone = met.len() == 1;
                    met.retain(|(.., bend)| is_alone || *bend < STRAIGHT);
                    let Some((place, next, _)) = met.pop() else {
                        break;
                    };
                    edges.remove(place);
                    line.segments.extend(next.segments);
                    line.parts.extend(next.parts);
                }
                line.segments = turned(&line.segments);
            }
            line.parts.sort_unstable();
            line.parts.dedup();
            lines.push(line);
        }
        lines
    }

    fn lies_on(&self, segments: &[ContourSegment], at: Point) -> bool {
        let mut all = segments.iter();
        all.any(|segment| segment.geometry.distance_to(at) <= self.touch)
    }

    /// Whether the wire can be threaded at an end of a line, and nothing holds the parts together where it ends.
    fn is_cut_through(&self, line: &CommonLine, outline: &[ContourSegment]) -> Result<(), Finding> {
        let (Some(first), Some(last)) = (line.segments.first(), line.segments.last()) else {
            return Ok(());
        };
        let ends = [first.geometry.start(), last.geometry.end()];
        if !ends.iter().any(|end| self.lies_on(outline, *end)) {
            return Err(self.refused(first, say!(no_end_on_the_outline).into()));
        }
        let half_kerf = self.half_kerf() / self.unit_mm;
        let radius = self.settings.corner_radius() / self.unit_mm;
        for end in ends {
            let walls = outline.iter().zip(outline.iter().cycle().skip(1));
            for (before, behind) in walls {
                if (before.geometry.end() - end).norm() > self.joint() {
                    continue;
                }
                // The round of stock in a corner that turns in reaches as far along its walls, and has to lie within the kerf of the line.
                let bend = turn(
                    before.geometry.end_tangent(),
                    behind.geometry.start_tangent(),
                );
                let reach = radius / ((PI + bend) / 2.0).tan();
                if bend < 0.0 && (reach < 0.0 || reach > half_kerf + self.touch) {
                    let at = end * self.unit_mm;
                    return Err(self.refused(first, say!(stock_would_hold_them, at.x, at.y)));
                }
            }
        }
        Ok(())
    }

    /// Lines that are drawn once and end on the outline of a block, or of a single part, or on other lines within it.
    pub(super) fn divide(
        &self,
        parts: &[Part],
        single: &[usize],
        blocks: &mut Vec<Block>,
        findings: &mut Vec<Finding>,
    ) {
        let is_open =
            |outline: &Outline| !outline.contour.closed && outline.is_cut() && outline.lacks_side();
        let open = self.outlines.iter().enumerate();
        let mut open: Vec<Open> = open
            .filter(|(_, outline)| is_open(outline))
            .map(|(index, outline)| Open {
                outline: index,
                workpiece: self.workpiece(outline),
                about: outline.contour.bounds(self.drawing),
                segments: outline.contour.segments(self.drawing).collect(),
            })
            .collect();
        if open.is_empty() {
            return;
        }
        blocks.extend(single.iter().map(|&part| Block {
            parts: vec![parts[part].outline],
            workpiece: parts[part].workpiece,
            outline: parts[part].walls.clone(),
            lines: Vec::new(),
        }));
        for block in blocks.iter_mut() {
            let mut about = Bounds::EMPTY;
            let outline = block.outline.iter();
            outline.for_each(|wall| about.merge(&wall.geometry.bounds()));
            // A line may end on another one that is found after it.
            loop {
                let before = open.len();
                open.retain(|own| {
                    let may_be = own.workpiece == block.workpiece && own.about.touches(&about);
                    if !may_be || !self.is_between(&own.segments, block) {
                        return true;
                    }
                    let line = CommonLine {
                        segments: own.segments.clone(),
                        parts: Vec::new(),
                        divider: Some(own.outline),
                    };
                    match self.is_cut_through(&line, &block.outline) {
                        Ok(()) => block.lines.push(line),
                        Err(refused) => findings.push(refused),
                    }
                    false
                });
                if open.len() == before {
                    break;
                }
            }
        }
        blocks.retain(|block| !block.lines.is_empty());
    }

    fn is_between(&self, segments: &[ContourSegment], block: &Block) -> bool {
        let (Some(first), Some(last)) = (segments.first(), segments.last()) else {
            return false;
        };
        let ends = [first.geometry.start(), last.geometry.end()];
        let is_on_outline = ends.map(|end| self.lies_on(&block.outline, end));
        let is_held = |at: usize| {
            let mut lines = block.lines.iter();
            is_on_outline[at] || lines.any(|line| self.lies_on(&line.segments, ends[at]))
        };
        let outline = block.outline.iter().map(|wall| wall.geometry);
        is_on_outline != [false, false]
            && is_held(0)
            && is_held(1)
            && !self.lies_on(&block.outline, first.geometry.point_at(0.5))
            && winding_of(outline, first.geometry.point_at(0.5)) != 0
    }
}
