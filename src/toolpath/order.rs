//! Which contours are cut, in which direction, and where on them the cut begins.

use super::Refusal;
use super::corners::{Element, between};
use crate::drawing::{Contour, Drawing, Outline};
use crate::geometry::{Arc, Point, Segment};
use crate::settings::Direction;

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

/// Indices of the outlines to cut, in machining order: all, or those that hold one of `handles`.
pub(super) fn chosen(drawing: &Drawing, outlines: &[Outline], handles: Option<&[String]>) -> Result<Vec<usize>, Refusal> {
    let mut chosen: Vec<usize> = match handles {
        None => (0..outlines.len()).collect(),
        Some(handles) => handles.iter().map(|handle| outline_of(drawing, outlines, handle)).collect::<Result<_, _>>()?,
    };
    chosen.sort_unstable();
    chosen.dedup();
    chosen.retain(|&index| !outlines[index].contour.is_empty());
    if chosen.is_empty() {
        return Err(Refusal::Sentence("there is no contour to cut".into()));
    }
    Ok(chosen)
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
