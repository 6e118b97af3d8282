//! Which contours are cut, in which direction, and where on them the cut begins.

use super::Refusal;
use super::corners::{Element, between};
use crate::drawing::{Contour, Drawing, Outline, winding};
use crate::geometry::{Arc, Bounds, Point, Segment};
use crate::settings::Direction;
use rustc_hash::FxHashSet;

/// The handle of a contour's first entity, which names the contour to the user.
pub(super) fn name<'a>(drawing: &'a Drawing, outline: &Outline) -> &'a str {
    outline.contour.pieces.first().and_then(|piece| drawing.get(piece.entity)).map_or("?", |entity| &entity.handle)
}

/// The outline that holds the entity with `handle`.
pub(super) fn outline_of(drawing: &Drawing, outlines: &[Outline], handle: &str) -> Result<usize, Refusal> {
    let Some(id) = drawing.find(handle) else {
        return Err(Refusal::Sentence(format!("there is no entity with the handle {handle}")));
    };
    let holds = |outline: &Outline| outline.contour.pieces.iter().any(|piece| piece.entity == id);
    let found = outlines.iter().position(holds);
    found.ok_or_else(|| Refusal::Sentence(format!("entity {handle} belongs to no contour that is cut")))
}

/// Indices of the outlines to cut, in machining order: all as they are drawn, or those that hold one of `handles` as these select
/// them. What lies within a contour that
/// comes earlier is brought before it, because the part drops when the contour round it is cut. What is nowhere longer than
/// `zero_length` (drawing units) is left out.
pub(super) fn chosen(drawing: &Drawing, outlines: &[Outline], handles: Option<&[String]>, zero_length: f64) -> Result<Vec<usize>, Refusal> {
    let mut chosen: Vec<usize> = match handles {
        None => (0..outlines.len()).collect(),
        Some(handles) => handles.iter().map(|handle| outline_of(drawing, outlines, handle)).collect::<Result<_, _>>()?,
    };
    let mut known = FxHashSet::default();
    chosen.retain(|&index| known.insert(index));
    chosen.retain(|&index| outlines[index].contour.has_length(drawing, zero_length));
    if chosen.is_empty() {
        return Err(Refusal::Sentence("there is no contour to cut".into()));
    }
    inner_first(drawing, outlines, &mut chosen);
    Ok(chosen)
}

/// Leaves an order alone in which nothing comes before what it holds. Else the contours within one outermost contour follow each
/// other, the innermost first; which outermost comes first stays as it was.
fn inner_first(drawing: &Drawing, outlines: &[Outline], chosen: &mut [usize]) {
    let boxes: Vec<Bounds> = chosen.iter().map(|&index| outlines[index].contour.bounds(drawing)).collect();
    let mut by_left: Vec<usize> = (0..chosen.len()).filter(|&place| outlines[chosen[place]].contour.closed).collect();
    by_left.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x));
    let mut depths = vec![0_usize; chosen.len()];
    let mut outermost: Vec<usize> = (0..chosen.len()).collect();
    let mut out_of_order = false;
    for &inner in &by_left {
        let Some(first) = outlines[chosen[inner]].contour.segment(drawing, 0) else { continue };
        let point = first.geometry.point_at(0.5);
        let reach = by_left.partition_point(|&other| boxes[other].min.x <= boxes[inner].min.x);
        for &outer in &by_left[..reach] {
            let around = boxes[outer];
            let holds = outer != inner
                && around != boxes[inner]
                && around.max.x >= boxes[inner].max.x
                && around.min.y <= boxes[inner].min.y
                && around.max.y >= boxes[inner].max.y
                && winding(drawing, &outlines[chosen[outer]].contour, point) != 0;
            if holds {
                depths[inner] += 1;
                // From left to right, so that the first holder is the outermost.
                outermost[inner] = if outermost[inner] == inner { outermost[outer] } else { outermost[inner] };
                out_of_order |= outer < inner;
            }
        }
    }
    if !out_of_order {
        return;
    }
    let mut group: Vec<usize> = (0..chosen.len()).collect();
    for place in 0..chosen.len() {
        group[outermost[place]] = group[outermost[place]].min(place);
    }
    let mut order: Vec<usize> = (0..chosen.len()).collect();
    order.sort_by_key(|&place| (group[outermost[place]], std::cmp::Reverse(depths[place]), place));
    let sorted: Vec<usize> = order.into_iter().map(|place| chosen[place]).collect();
    chosen.copy_from_slice(&sorted);
}

/// The contour in the direction of the cut, and whether that is against its own. An open contour is cut as drawn.
pub(super) fn directed(outline: &Outline, direction: Direction) -> (Contour, bool) {
    let turn = outline.contour.closed
        && match direction {
            Direction::AsDrawn => false,
            Direction::Ccw => outline.twice_area < 0.0,
            Direction::Cw => outline.twice_area > 0.0,
        };
    (if turn { outline.contour.reversed() } else { outline.contour.clone() }, turn)
}

/// A closed path turned round so that it begins and ends in `point` of element `index`, which is split there.
pub(super) fn begin_at(path: Vec<Element>, index: usize, point: Point) -> Vec<Element> {
    let Some(&element) = path.get(index) else { return path };
    if let (1, Segment::Arc(arc)) = (path.len(), element.geometry) {
        let turned = Arc { radius: arc.radius, ..Arc::about(arc.center, point, point, arc.sweep > 0.0) };
        return vec![Element { geometry: Segment::Arc(turned), ..element }];
    }
    let share = element.geometry.share_of(point);
    let length = element.geometry.length();
    let (first, split) = match share * length {
        along if along <= 1e-9 => (index, false),
        along if along >= length - 1e-9 => ((index + 1) % path.len(), false),
        _ => (index, true),
    };
    let mut turned = Vec::with_capacity(path.len() + 1);
    turned.extend_from_slice(&path[first..]);
    turned.extend_from_slice(&path[..first]);
    if split {
        turned[0].geometry = between(&element.geometry, point, element.geometry.end());
        turned.push(Element { geometry: between(&element.geometry, element.geometry.start(), point), ..element });
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Analysis;
    use crate::drawing::{Entity, Geometry};
    use crate::settings::Effective;
    use std::sync::Arc as Shared;

    /// Circles by centre on the x axis and radius: the order in which they are cut.
    fn check(circles: &[(f64, f64)], expected: &[usize]) {
        let mut drawing = Drawing::new(None);
        for &(x, radius) in circles {
            let geometry = Geometry::Circle { center: Point::new(x, 0.0), radius };
            drawing.push(Entity { handle: "A".into(), layer: "0".into(), role: None, kind: crate::drawing::Kind::Circle, geometry });
        }
        let outlines = Analysis::new(&drawing, Shared::new(Effective::default())).outlines(&drawing).clone();
        assert_eq!(chosen(&drawing, &outlines, None, 1e-9), Ok(expected.to_vec()), "{circles:?}");
    }

    #[test]
    fn holes_come_before_what_drops_them() {
        check(&[(0.0, 1.0), (5.0, 1.0), (10.0, 1.0)], &[0, 1, 2]);
        check(&[(0.0, 5.0), (2.0, 1.0), (-2.0, 1.0)], &[1, 2, 0]);
        check(&[(2.0, 1.0), (0.0, 5.0), (-2.0, 1.0)], &[0, 2, 1]);
        // A second part and its hole stay where they are.
        check(&[(0.0, 5.0), (20.0, 5.0), (20.0, 1.0), (0.0, 1.0)], &[3, 0, 2, 1]);
        // A punch in a hole of a punch.
        check(&[(0.0, 9.0), (0.0, 6.0), (0.0, 3.0), (1.0, 1.0)], &[3, 2, 1, 0]);
    }
}
