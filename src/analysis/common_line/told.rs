//! What is said of common lines: what each part loses, what falls, and why some cannot be cut apart.

use super::blocks::STRAIGHT;
use super::{Block, CommonLine, Part, Search};
use crate::drawing::ContourSegment;
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::geometry::{Segment, Vector, cross, left_normal, reached};

impl Search<'_> {
    /// Half the width of the cut on a line, mm.
    pub(super) fn half_kerf(&self) -> f64 {
        let settings = self.settings;
        settings.half_kerf(0).unwrap_or(settings.correction)
    }

    /// What a common line means for its parts.
    pub(super) fn said(&self, parts: &[Part], block: &Block, line: &CommonLine) -> Option<Finding> {
        let severity = self
            .settings
            .severity_over(Rule::NarrowSlot, Severity::Information)?;
        let length: f64 = line.segments.iter().map(|it| it.geometry.length()).sum();
        let (length, lost) = (length * self.unit_mm, self.half_kerf());
        let name = |outline: usize| self.outlines[outline].name(self.drawing);
        let sentence = match line.divider {
            Some(_) => say!(a_line_divides_a_contour, name(block.parts[0]), length, lost),
            None => {
                let names = line.parts.iter().map(|&part| name(parts[part].outline));
                let names: Vec<&str> = names.collect();
                let sizes = line.parts.iter().filter_map(|&place| {
                    let part = &parts[place];
                    let [drawn, left] = self.across(part, &line.segments)?;
                    Some(say!(what_a_part_measures, name(part.outline), left, drawn))
                });
                let sizes: String = sizes.collect();
                say!(
                    parts_share_an_edge,
                    names.join(say!(comma)),
                    length,
                    lost,
                    sizes
                )
            }
        };
        let other = line.parts.first().and_then(|&part| {
            let met = parts[part]
                .shared
                .iter()
                .find(|it| line.parts.contains(&it.with))?;
            Some(place_of(&parts[part].walls[met.wall]))
        });
        Some(Finding {
            rule: Rule::NarrowSlot,
            severity,
            place: place_of(line.segments.first()?),
            detail: Detail::Said(sentence),
            related: other.into_iter().collect(),
        })
    }

    /// A tab is left where the outline ends: what else lies within it falls before.
    pub(super) fn held_by_a_tab(&self, block: &Block) -> Option<Finding> {
        let pieces = block.parts.iter();
        let pieces = pieces.flat_map(|&part| &self.outlines[part].contour.pieces);
        let handles = pieces.filter_map(|piece| Some(&*self.drawing.get(piece.entity)?.handle));
        let severity = self
            .settings
            .severity_over(Rule::Settings, Severity::Warning)?;
        let name = self.outlines[block.parts[0]].name(self.drawing);
        let first = block.lines.first().and_then(|line| line.segments.first());
        (self.settings.tab_of(handles) > 0.0).then(|| Finding {
            rule: Rule::Settings,
            severity,
            place: first.map_or(Place::Document, place_of),
            detail: Detail::Said(say!(a_tab_holds_one_part, "program.tab", name)),
            related: Vec::new(),
        })
    }

    /// What a part measures across a straight common line at its edge, mm: as drawn, and as it comes out.
    fn across(&self, part: &Part, line: &[ContourSegment]) -> Option<[f64; 2]> {
        let along = line.first()?.geometry.start_tangent();
        let is_straight = |it: &ContourSegment| {
            it.geometry.as_arc().is_none()
                && cross(along, it.geometry.start_tangent()).abs() < STRAIGHT
        };
        let across = left_normal(along);
        let ends = [-across, across].map(|way| farthest(&part.walls, way));
        // An edge on the far side may be shared as well.
        let lost = [-across, across]
            .into_iter()
            .zip(ends)
            .filter(|(way, end)| {
                let mut stretches = part.shared.iter().map(|it| part.stretch(it).geometry);
                stretches.any(|it| {
                    let apart = [it.start(), it.end()].map(|at| end - way.dot(&at.coords));
                    apart.iter().all(|apart| *apart <= self.same_place)
                })
            });
        let count = lost.count();
        let drawn = (ends[0] + ends[1]) * self.unit_mm;
        let left = drawn - count as f64 * self.half_kerf();
        (count > 0 && line.iter().all(is_straight)).then_some([drawn, left])
    }

    pub(super) fn refused(&self, at: &ContourSegment, reason: String) -> Finding {
        let severity = self.settings.severity(Rule::NarrowSlot);
        Finding {
            rule: Rule::NarrowSlot,
            severity: severity.unwrap_or(Severity::Error),
            place: place_of(at),
            detail: Detail::Said(say!(parts_cannot_be_cut_apart, reason)),
            related: Vec::new(),
        }
    }
}

/// How far some walls reach in a direction.
fn farthest(walls: &[ContourSegment], way: Vector) -> f64 {
    let reach = |wall: &ContourSegment| {
        let geometry = &wall.geometry;
        let round = match geometry {
            Segment::Arc(arc) => reached(arc, way),
            Segment::Line(_) => None,
        };
        let points = [geometry.start(), geometry.end()].into_iter().chain(round);
        points
            .map(|at| way.dot(&at.coords))
            .fold(f64::NEG_INFINITY, f64::max)
    };
    walls.iter().map(reach).fold(f64::NEG_INFINITY, f64::max)
}

fn place_of(segment: &ContourSegment) -> Place {
    Place::Segment {
        entity: segment.entity,
        segment: segment.segment,
    }
}
