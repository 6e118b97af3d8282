//! A drawing that is the wire's own path, leads included: entities that lead one from the end of the other.

use super::job::Job;
use super::path::{PathSegment, Source, WirePath};
use crate::drawing::{EntityId, Geometry, Outline};
use crate::geometry::{Arc, Point, Segment};
use crate::settings::{Direction, PointSetting};
use rustc_hash::FxHashSet;

/// Everything in `chosen` as one path, in machining order, when each entity begins or ends where the last one ended. A
/// circle starts where the wire meets it; of doubles each is a way of its own. `None` where there is a single contour,
/// where the entities do not lead on from each other, and where a thread hole or an entry other than the path's start
/// is requested.
pub(super) fn one_path(job: &Job, chosen: &[usize]) -> Option<WirePath> {
    let (drawing, settings) = (job.drawing, job.settings);
    let join = job.units(settings.tolerances.join);
    let mut asked = Vec::new();
    for setting in settings.thread.iter().chain(&settings.entry) {
        match setting {
            PointSetting::One([x, y]) => asked.push(Point::new(*x, *y)),
            PointSetting::ByHandle(_) => return None,
        }
    }
    let entities = with_doubles(job.outlines, chosen)?;
    let mut segments: Vec<PathSegment> = Vec::new();
    let mut here = asked.first().copied();
    for (entity, geometry) in drawing
        .entities()
        .filter(|(id, _)| entities.contains(id))
        .map(|(id, entity)| (id, &entity.geometry))
    {
        let pieces: Vec<(usize, Segment)> =
            geometry.segments_of(drawing.flat()).enumerate().collect();
        let (first, last) = (pieces.first()?.1.start(), pieces.last()?.1.end());
        let meets = |point: Point| here.is_none_or(|here| (point - here).norm() <= join);
        let pieces = match geometry {
            _ if meets(first) && !is_circle(geometry) => pieces,
            _ if meets(last) && !is_circle(geometry) => pieces
                .into_iter()
                .rev()
                .map(|(index, piece)| (index, piece.reversed()))
                .collect(),
            Geometry::Circle { .. } | Geometry::Arc { .. } => {
                let Segment::Arc(circle) = pieces.first()?.1 else {
                    return None;
                };
                let begin = here.unwrap_or(circle.start);
                if !circle.is_full_turn() || circle.distance_to(begin) > join {
                    return None;
                }
                Vec::from([(
                    0,
                    Segment::Arc(Arc::about(
                        circle.center,
                        begin,
                        begin,
                        settings.direction != Direction::Cw,
                    )),
                )])
            }
            _ => return None,
        };
        here = pieces.last().map(|(_, piece)| piece.end());
        segments.extend(pieces.into_iter().map(|(segment, geometry)| PathSegment {
            geometry,
            source: Source::Segment { entity, segment },
        }));
    }
    let begin = segments.first()?.geometry.start();
    if asked.iter().any(|point| (point - begin).norm() > join) {
        return None;
    }
    Some(WirePath {
        outline: *chosen.first()?,
        ..WirePath::along(begin, segments)
    })
}

fn is_circle(geometry: &Geometry) -> bool {
    matches!(geometry, Geometry::Circle { .. } | Geometry::Arc { .. }) && geometry.is_closed()
}

/// The entities of the chosen outlines, and their doubles: a way that is gone there and back is drawn twice. `None` for
/// a single outline without a double.
fn with_doubles(outlines: &[Outline], chosen: &[usize]) -> Option<FxHashSet<EntityId>> {
    let pieces = chosen
        .iter()
        .flat_map(|&index| &outlines[index].contour.pieces);
    let own: FxHashSet<EntityId> = pieces.map(|piece| piece.entity).collect();
    let doubles: Vec<EntityId> = outlines
        .iter()
        .filter(|outline| {
            outline
                .contour
                .double_of
                .is_some_and(|of| own.contains(&of))
        })
        .flat_map(|outline| &outline.contour.pieces)
        .map(|piece| piece.entity)
        .collect();
    let several = chosen.len() > 1 || !doubles.is_empty();
    several.then(|| own.into_iter().chain(doubles).collect())
}
