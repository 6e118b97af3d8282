//! The segments of contours that may belong to a pair, by place, and which of these contours run beside each other.

use super::Analysis;
use super::edited::Edited;
use crate::drawing::{ContourKey, Drawing, Outline};
use crate::fit;
use crate::geometry::Segment;
use crate::toolpath::Walls;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The segments of a contour, for questions about what is near.
#[derive(Clone, Debug)]
pub(crate) struct Own {
    pub(super) walls: Arc<Walls>,
    /// Where the contour has been edited since.
    pub(super) edited: Edited,
}

impl Own {
    pub(super) fn of(drawing: &Drawing, outline: &Outline) -> Own {
        Own {
            walls: fit::walls_of(drawing, &outline.contour),
            edited: Edited::not(),
        }
    }

    /// True where what is known of it still holds.
    pub(super) fn is_new(&self) -> bool {
        !self.edited.is_any()
    }
}

impl Analysis {
    /// Updates the segments of edited contours, and which of them still run beside each other.
    pub(super) fn walls_again(
        &mut self,
        drawing: &Drawing,
        keys: &[ContourKey],
        outlines: &[Outline],
    ) {
        let edited = |index: &usize| self.walls.get(&keys[*index]).is_some_and(|it| !it.is_new());
        let edited: Vec<usize> = (0..keys.len()).filter(edited).collect();
        let reach = fit::reach(drawing, &self.settings);
        for index in edited {
            let key = keys[index];
            let Some(own) = self.walls.remove(&key) else {
                continue;
            };
            let (walls, changed) = walls_since(own, drawing, &outlines[index]);
            let other = |both: &[ContourKey; 2]| both[usize::from(both[0] == key)];
            self.beside.retain(|both| {
                !both.contains(&key)
                    || match (&changed, self.walls.get(&other(both))) {
                        (Some([gone, new]), Some(other)) => {
                            fit::still_beside([gone, new], &walls, &other.walls, reach)
                        }
                        _ => false,
                    }
            });
            let edited = Edited::not();
            self.walls.insert(key, Own { walls, edited });
        }
    }
}

/// The present segments of an edited contour, and those that are gone or new; `None` where more than a few may be.
fn walls_since(
    own: Own,
    drawing: &Drawing,
    outline: &Outline,
) -> (Arc<Walls>, Option<[Vec<Segment>; 2]>) {
    let Own { mut walls, edited } = own;
    let within = edited.within();
    let within = within.filter(|_| walls.segments().len() == outline.contour.len());
    let Some(within) = within else {
        return (fit::walls_of(drawing, &outline.contour), None);
    };
    let segment = |index: usize| {
        let now = outline.contour.segment(drawing, index)?.geometry;
        (now != *walls.segment(index)).then_some((index, now))
    };
    // A segment may be in several of the stretches.
    let new = within.iter().cloned().flatten().filter_map(segment);
    let new: BTreeMap<usize, Segment> = new.collect();
    let new: Vec<(usize, Segment)> = new.into_iter().collect();
    let gone = Arc::make_mut(&mut walls).replace(&new);
    let changed = [gone, new].map(|all| all.into_iter().map(|(_, segment)| segment).collect());
    (walls, Some(changed))
}
