//! Groups: contours connected through ends that lie near each other.

use super::{Chains, Key, SHARE};
use crate::drawing::EntityId;
use crate::drawing::ends::{Cell, End, Ends};
use crate::drawing::joints::Joints;
use rayon::prelude::*;
use std::ops::Range;

impl Chains {
    /// Makes groups of the contours of entities.
    pub(super) fn group(&mut self, entities: &[EntityId], ends_of: &[Ends], joints: &Joints) {
        for (one, other) in self.neighbours(entities, ends_of, joints) {
            self.unite(one, other);
        }
    }

    /// Contours with an end in one cell, or in adjacent cells near the border.
    fn neighbours(
        &self,
        entities: &[EntityId],
        ends_of: &[Ends],
        joints: &Joints,
    ) -> Vec<(Key, Key)> {
        let count = joints.list_count();
        let of_share = |nth: usize| {
            let lists = nth * SHARE..((nth + 1) * SHARE).min(count);
            self.neighbours_in(lists, (entities, ends_of), joints)
        };
        match count.div_ceil(SHARE) {
            0 | 1 => of_share(0),
            shares => {
                let found: Vec<Vec<(Key, Key)>> =
                    (0..shares).into_par_iter().map(of_share).collect();
                found.concat()
            }
        }
    }

    fn neighbours_in(
        &self,
        lists: Range<usize>,
        (entities, ends_of): (&[EntityId], &[Ends]),
        joints: &Joints,
    ) -> Vec<(Key, Key)> {
        let mut neighbours = Vec::new();
        let at = |end: End| {
            let id = entities[end.entity() as usize];
            (
                end.of(ends_of[id.0 as usize]),
                self.contour_of[id.0 as usize],
            )
        };
        let mut cells: Vec<(Cell, Key)> = Vec::new();
        for list in lists {
            cells.clear();
            for end in joints.of_list(list) {
                let (place, key) = at(end);
                let mut about = self.cells.about(place);
                let Some(own) = about.next() else { continue };
                match cells.iter_mut().find(|(cell, _)| *cell == own) {
                    Some((_, last)) if *last == key => {}
                    Some((_, last)) => neighbours.push((std::mem::replace(last, key), key)),
                    None => cells.push((own, key)),
                }
                for beside in about {
                    // All others there belong to its group.
                    let other = joints
                        .of_cell(beside)
                        .map(at)
                        .find(|(place, _)| self.cells.of(*place) == beside);
                    neighbours.extend(
                        other
                            .filter(|(_, other)| *other != key)
                            .map(|(_, other)| (other, key)),
                    );
                }
            }
        }
        neighbours
    }

    /// Merges the groups of two contours: the larger takes in the smaller.
    fn unite(&mut self, one: Key, other: Key) {
        let group = |contour: Key| self.group_of.get(&contour).copied();
        let (larger, smaller) = match (group(one), group(other)) {
            (Some(one), Some(other)) if one == other => return,
            (Some(one), Some(other)) => {
                let size = |group: Key| self.groups.get(&group).map_or(0, Vec::len);
                let (larger, smaller) = if size(one) >= size(other) {
                    (one, other)
                } else {
                    (other, one)
                };
                (larger, self.groups.remove(&smaller).unwrap_or_default())
            }
            (Some(group), None) => (group, vec![other]),
            (None, Some(group)) => (group, vec![one]),
            (None, None) => (self.fresh_key(), vec![one, other]),
        };
        for &contour in &smaller {
            self.group_of.insert(contour, larger);
        }
        self.groups.entry(larger).or_default().extend(smaller);
    }
}
