//! Walls that are searched repeatedly, each time not far from the place before: without what is known of that place, a fit takes a
//! sixth longer.

use super::clearance::{Walls, nearest_by};
use crate::geometry::{Bounds, Point};

/// Walls, with those that lie about the last place.
pub(crate) struct Nearby<'a> {
    walls: &'a Walls,
    /// How far beyond the requested area walls are looked up in advance.
    ahead: f64,
    /// All that touches this is known.
    area: Bounds,
    /// Each a few walls, by the first of them, with their box.
    few: Vec<(u32, Bounds)>,
}

impl<'a> Nearby<'a> {
    pub(crate) fn of(walls: &'a Walls) -> Nearby<'a> {
        Nearby {
            walls,
            ahead: 2.0 * walls.size_of_few(),
            area: Bounds::EMPTY,
            few: Vec::new(),
        }
    }

    pub(crate) fn walls(&self) -> &'a Walls {
        self.walls
    }

    /// The same as of all walls.
    pub(crate) fn find(
        &mut self,
        reach: &Bounds,
        mut is_it: impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        if !self.area.holds(reach) {
            if reach.width().max(reach.height()) > self.ahead {
                return self.walls.find(reach, is_it);
            }
            self.area = reach.grown(self.ahead);
            self.few.clear();
            self.walls.few_near(&self.area, &mut self.few);
        }
        let mut near = self.few.iter().filter(|(_, few)| few.touches(reach));
        near.find_map(|&(first, _)| self.walls.find_among(first as usize, reach, &mut is_it))
    }

    /// The same as of all walls.
    pub(crate) fn nearer(&mut self, point: Point, distance: f64) -> Option<usize> {
        let walls = self.walls;
        self.find(&Bounds::of_disc(point, distance), |index| {
            walls.segment(index).distance_to(point) < distance
        })
    }

    /// The same as of all walls.
    pub(crate) fn nearest_to(&mut self, point: Point, reach: f64) -> Option<(f64, usize)> {
        let walls = self.walls;
        nearest_by(walls.segments(), point, reach, |area, each| {
            self.find(area, |index| {
                each(index);
                false
            });
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Segment, Vector};

    /// Hands each wall that it finds to another one, which ends the search with true.
    type Finds<'a> = &'a mut dyn FnMut(&mut dyn FnMut(usize) -> bool);

    /// Along a wave of lines, at distances that grow beyond what is looked up at once, what is found is what all walls say.
    #[test]
    fn what_is_found_is_what_is_found_among_all() {
        let at = |index: usize| {
            let along = index as f64 * 0.1;
            Point::new(along, 3.0 * along.sin())
        };
        for count in [1, 7, 8, 9, 100, 3000] {
            let walls = Walls::new(
                (0..count)
                    .map(|it| Segment::line(at(it), at(it + 1)))
                    .collect(),
            );
            let mut nearby = Nearby::of(&walls);
            for index in (0..count).step_by(1 + count / 300) {
                let point = at(index) + Vector::new(0.3, -0.2) * (index % 5) as f64;
                for reach in [0.01, 0.3, 2.0, 50.0] {
                    let area = Bounds::of_disc(point, reach);
                    let all = |find: Finds| {
                        let mut found = Vec::new();
                        find(&mut |wall| {
                            found.push(wall);
                            false
                        });
                        found
                    };
                    let near = all(&mut |is_it| {
                        nearby.find(&area, is_it);
                    });
                    let among_all = all(&mut |is_it| {
                        walls.find(&area, is_it);
                    });
                    assert_eq!(near, among_all, "{count} {index} {reach}");
                    assert_eq!(nearby.nearer(point, reach), walls.nearer(point, reach));
                    assert_eq!(
                        nearby.nearest_to(point, reach),
                        walls.nearest_to(point, reach)
                    );
                }
            }
        }
    }
}
