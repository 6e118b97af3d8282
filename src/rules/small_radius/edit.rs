//! Replacements as edits of the entities that hold the contour.

use super::refillet::corner_arc;
use super::{Replacement, Travel};
use crate::drawing::{Change, ContourSegment, Drawing, DrawingEdit, EntityId, Geometry, Vertex};
use crate::geometry::{Arc, Point, Segment, left_normal, positive_angle};
use crate::rules::Limits;
use std::collections::BTreeMap;

/// What becomes of one segment, in its entity's own direction.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    Kept(Segment),
    Removed,
}

/// The edit that makes all `replacements`, each given with its travel. They must not overlap.
///
/// The longest arc of each run becomes the new arc, its neighbours are cut back to the feet, and the rest goes. `None`
/// where a run has no arc that could carry the new one.
pub(crate) fn drawing_edit(
    drawing: &Drawing,
    replacements: &[(Travel, Replacement)],
) -> Option<DrawingEdit> {
    let mut fates: BTreeMap<(EntityId, usize), Fate> = BTreeMap::new();
    for (travel, replacement) in replacements {
        let carrier = carrier(travel, replacement)?;
        for position in replacement.before + 1..replacement.after {
            let segment = travel.segment(position)?;
            let fate = if position == carrier {
                Fate::Kept(in_own_direction(&segment, Segment::Arc(replacement.arc)))
            } else {
                Fate::Removed
            };
            fates.insert((segment.entity, segment.segment), fate);
        }
        for position in replacement.before..replacement.after {
            let ends = [travel.segment(position)?, travel.segment(position + 1)?];
            for between in between(drawing, ends) {
                fates.insert(between, Fate::Removed);
            }
        }
        for (position, point, at_end) in [
            (replacement.before, replacement.arc.start, true),
            (replacement.after, replacement.arc.end, false),
        ] {
            let segment = travel.segment(position)?;
            let own = drawing.segment(segment.entity, segment.segment)?;
            let known = match fates.get(&(segment.entity, segment.segment)) {
                Some(Fate::Kept(known)) => *known,
                Some(Fate::Removed) => return None,
                None => own,
            };
            let cut = with_end(known, point, at_end != segment.reversed);
            fates.insert((segment.entity, segment.segment), Fate::Kept(cut));
        }
    }
    let mut changes = Vec::new();
    let mut rest = fates.into_iter().peekable();
    while let Some(((entity, segment), fate)) = rest.next() {
        let mut of_entity = BTreeMap::from([(segment, fate)]);
        while let Some((key, fate)) = rest.next_if(|((other, _), _)| *other == entity) {
            of_entity.insert(key.1, fate);
        }
        changes.extend(entity_changes(drawing, entity, &of_entity)?);
    }
    Some(DrawingEdit { changes })
}

/// The edit that rounds the corner between the segments at `before` and after it, which turns to the left, with the
/// fix radius, and the largest distance by which the contour moves. `None` where no such arc fits, or where an entity cannot take it.
pub(crate) fn fillet(
    travel: &Travel,
    before: isize,
    limits: &Limits,
) -> Option<(DrawingEdit, f64)> {
    let (arc, moved) = corner_arc(travel, before, limits)?;
    Some((corner_edit(travel, before, arc)?, moved))
}

/// The edit that puts an arc in the place of a corner.
fn corner_edit(travel: &Travel, before: isize, arc: Arc) -> Option<DrawingEdit> {
    let (one, other) = (travel.segment(before)?, travel.segment(before + 1)?);
    let drawing = travel.drawing;
    let cut = |place: &ContourSegment, point: Point, at_end: bool| {
        let own = drawing.segment(place.entity, place.segment)?;
        Some(with_end(own, point, at_end != place.reversed))
    };
    let (first, second) = (cut(&one, arc.start, true)?, cut(&other, arc.end, false)?);
    if one.entity == other.entity
        && let Geometry::Polyline { closed, vertices } = &drawing.get(one.entity)?.geometry
        && (vertices.len() > 2 || *closed)
        && one.segment != other.segment
    {
        let entity = one.entity;
        let ((early, early_cut), (late, late_cut), own_arc) = match one.reversed {
            false => (
                (one.segment, first),
                (other.segment, second),
                Segment::Arc(arc),
            ),
            true => (
                (other.segment, second),
                (one.segment, first),
                Segment::Arc(arc.reversed()),
            ),
        };
        // The two ends of an open polyline may touch in a corner: that joint has no vertex of its own.
        let gone = between(drawing, [one, other]);
        if (early + 1 + gone.len()) % vertices.len() == late {
            let bulge_of = |segment: Segment, old: Vertex| {
                if segment.as_arc().is_some() {
                    segment.bulge()
                } else {
                    old.bulge
                }
            };
            let mut changes = Vec::new();
            let start = *vertices.get(early)?;
            let bulge = bulge_of(early_cut, start);
            if bulge != start.bulge {
                changes.push(Change::SetVertex {
                    entity,
                    index: early,
                    vertex: Vertex { bulge, ..start },
                });
            }
            changes.push(Change::SetVertex {
                entity,
                index: late,
                vertex: Vertex {
                    point: own_arc.start(),
                    bulge: own_arc.bulge(),
                },
            });
            let bulge = bulge_of(late_cut, *vertices.get(late)?);
            changes.push(Change::InsertVertex {
                entity,
                index: late + 1,
                vertex: Vertex {
                    point: own_arc.end(),
                    bulge,
                },
            });
            changes.extend(
                gone.into_iter()
                    .map(|(entity, index)| Change::RemoveVertex { entity, index }),
            );
            return Some(DrawingEdit { changes });
        }
    }
    if one.entity == other.entity {
        return None;
    }
    let mut changes = Vec::new();
    for (place, cut) in [(&one, first), (&other, second)] {
        changes.extend(entity_changes(
            drawing,
            place.entity,
            &BTreeMap::from([(place.segment, Fate::Kept(cut))]),
        )?);
    }
    let after = if travel.side == crate::finding::Side::Left {
        one.entity
    } else {
        other.entity
    };
    let geometry = Geometry::of_arc(&arc);
    changes.push(Change::AddEntity { after, geometry });
    Some(DrawingEdit { changes })
}

/// The edit that keeps the arc's end points and gives it the fix radius, as the original "R
/// minimum" tool did; and the angle (radians) by which the contour then kinks at each end. `None`
/// past a half turn, where it would remove a bulb, and where no single entity is the arc.
pub(crate) fn keep_end_points(
    drawing: &Drawing,
    segment: &ContourSegment,
    limits: &Limits,
) -> Option<(DrawingEdit, f64)> {
    let entity = drawing.get(segment.entity)?;
    let Segment::Arc(own) = drawing.segment(segment.entity, segment.segment)? else {
        return None;
    };
    let chord = own.end - own.start;
    let half = chord.norm() / (2.0 * limits.fix_radius);
    if own.bulge().abs() > 1.0 + 1e-9 || half <= 0.0 || half > 1.0 {
        return None;
    }
    let sweep = 2.0 * half.asin() * own.sweep.signum();
    let change = match &entity.geometry {
        Geometry::Polyline { vertices, .. } => {
            let vertex = Vertex {
                bulge: (sweep / 4.0).tan(),
                ..*vertices.get(segment.segment)?
            };
            Change::SetVertex {
                entity: segment.entity,
                index: segment.segment,
                vertex,
            }
        }
        Geometry::Arc { .. } => {
            let to_center = limits.fix_radius * (sweep / 2.0).cos();
            let center = own.start + chord * 0.5 + left_normal(chord).normalize() * to_center;
            set_arc(
                segment.entity,
                &Arc::about(center, own.start, own.end, true),
                limits.fix_radius,
                None,
            )
        }
        _ => return None,
    };
    Some((
        DrawingEdit {
            changes: vec![change],
        },
        (own.sweep.abs() - sweep.abs()) / 2.0,
    ))
}

/// The segments of a polyline between two that follow each other in a contour: they are shorter than the resolution, and no part of it.
fn between(drawing: &Drawing, [one, other]: [ContourSegment; 2]) -> Vec<(EntityId, usize)> {
    let entity = one.entity;
    let (early, late) = match one.reversed {
        false => (one.segment, other.segment),
        true => (other.segment, one.segment),
    };
    let geometry = drawing.get(entity).map(|entity| &entity.geometry);
    let count = match geometry {
        Some(geometry @ Geometry::Polyline { closed, .. }) if *closed || early < late => {
            geometry.segment_count()
        }
        _ => return Vec::new(),
    };
    if other.entity != entity || early == late {
        return Vec::new();
    }
    let steps = (late + count - early) % count;
    (1..steps)
        .map(|step| (entity, (early + step) % count))
        .collect()
}

/// The position whose segment becomes the new arc: the longest arc that curves the same way.
fn carrier(travel: &Travel, replacement: &Replacement) -> Option<isize> {
    let length = |position: isize| match travel.segment(position)?.geometry {
        Segment::Arc(arc) if arc.sweep > 0.0 => Some(arc.length()),
        _ => None,
    };
    let arcs = (replacement.before + 1..replacement.after)
        .filter_map(|position| Some((length(position)?, position)));
    arcs.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
        .map(|(_, position)| position)
}

fn in_own_direction(place: &ContourSegment, geometry: Segment) -> Segment {
    if place.reversed {
        geometry.reversed()
    } else {
        geometry
    }
}

/// The segment with another end point (or start point) on its own line or circle.
fn with_end(segment: Segment, point: Point, at_end: bool) -> Segment {
    match segment {
        Segment::Line(line) if at_end => Segment::line(line.start, point),
        Segment::Line(line) => Segment::line(point, line.end),
        Segment::Arc(arc) if at_end && arc.end == point || !at_end && arc.start == point => segment,
        Segment::Arc(arc) => {
            let share = arc.share_of(point);
            let turned = arc.sweep * share;
            Segment::Arc(if at_end {
                Arc {
                    sweep: turned,
                    end: point,
                    ..arc
                }
            } else {
                Arc {
                    start_angle: arc.start_angle + turned,
                    sweep: arc.sweep - turned,
                    start: point,
                    ..arc
                }
            })
        }
    }
}

fn entity_changes(
    drawing: &Drawing,
    id: EntityId,
    fates: &BTreeMap<usize, Fate>,
) -> Option<Vec<Change>> {
    let geometry = &drawing.get(id)?.geometry;
    let count = geometry.segment_count();
    if fates.len() == count && fates.values().all(|fate| *fate == Fate::Removed) {
        return Some(vec![Change::RemoveEntity { entity: id }]);
    }
    match geometry {
        Geometry::Polyline { closed, vertices } => {
            Some(polyline_changes(id, vertices, *closed, count, fates))
        }
        Geometry::Line { start, end } => match fates.get(&0)? {
            Fate::Kept(Segment::Line(line)) if (line.start, line.end) == (*start, *end) => {
                Some(Vec::new())
            }
            Fate::Kept(Segment::Line(line)) => Some(vec![Change::Reshape {
                entity: id,
                geometry: Geometry::Line {
                    start: line.start,
                    end: line.end,
                },
            }]),
            _ => None,
        },
        Geometry::Arc {
            start_angle,
            end_angle,
            ..
        } => match (fates.get(&0)?, drawing.segment(id, 0)?) {
            (Fate::Kept(Segment::Arc(arc)), Segment::Arc(old)) => {
                // An angle that stays is kept to the drawing's last digit.
                let kept = (arc.center == old.center).then(|| {
                    (
                        (arc.start == old.start).then_some(*start_angle),
                        (arc.end == old.end).then_some(*end_angle),
                    )
                });
                let radius = arc.radius;
                Some(if *arc == old {
                    Vec::new()
                } else {
                    vec![set_arc(id, arc, radius, kept)]
                })
            }
            _ => None,
        },
        Geometry::Circle { .. } | Geometry::Text { .. } => None,
    }
}

fn set_arc(
    entity: EntityId,
    arc: &Arc,
    radius: f64,
    kept: Option<(Option<f64>, Option<f64>)>,
) -> Change {
    let (start, end) = kept.unwrap_or((None, None));
    let start_angle = start.unwrap_or_else(|| positive_angle(arc.start_angle));
    let end_angle = end.unwrap_or_else(|| positive_angle(arc.start_angle + arc.sweep));
    let geometry = Geometry::Arc {
        center: arc.center,
        radius,
        start_angle,
        end_angle,
    };
    Change::Reshape { entity, geometry }
}

fn polyline_changes(
    entity: EntityId,
    vertices: &[Vertex],
    closed: bool,
    count: usize,
    fates: &BTreeMap<usize, Fate>,
) -> Vec<Change> {
    // At the open end a removed segment takes its end vertex with it, elsewhere its start vertex.
    let trailing = if closed {
        0
    } else {
        (0..count)
            .rev()
            .take_while(|segment| fates.get(segment) == Some(&Fate::Removed))
            .count()
    };
    let last_kept = count - 1 - trailing.min(count - 1);
    let mut changes = Vec::new();
    let mut set = |index: usize, vertex: Vertex| {
        if vertices.get(index) != Some(&vertex) {
            changes.push(Change::SetVertex {
                entity,
                index,
                vertex,
            });
        }
    };
    for (&segment, fate) in fates {
        if let Fate::Kept(geometry) = fate {
            // An arc whose sweep is untouched keeps the drawing's own bulge.
            let old = vertices[segment];
            let same = Segment::from_bulge(
                old.point,
                vertices[(segment + 1) % vertices.len()].point,
                old.bulge,
            );
            let bulge = match (geometry, same) {
                (Segment::Arc(arc), Segment::Arc(was)) if arc.sweep == was.sweep => old.bulge,
                _ => geometry.bulge(),
            };
            set(
                segment,
                Vertex {
                    point: geometry.start(),
                    bulge,
                },
            );
            if !closed && segment == last_kept {
                let end_bulge = if trailing == 0 {
                    vertices[segment + 1].bulge
                } else {
                    0.0
                };
                set(
                    segment + 1,
                    Vertex {
                        point: geometry.end(),
                        bulge: end_bulge,
                    },
                );
            }
        }
    }
    for (&segment, fate) in fates {
        if *fate == Fate::Removed {
            let index = if segment > last_kept {
                segment + 1
            } else {
                segment
            };
            changes.push(Change::RemoveVertex { entity, index });
        }
    }
    changes
}
