//! Which contours are cut, in which direction, and where on them the cut begins.

use super::containment::{Nesting, Places};
use super::job::{Job, Pick};
use super::path::{Refusal, WirePath};
use crate::drawing::{Contour, EntityId, Outline};
use crate::geometry::Point;
use crate::settings::{Direction, Order};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::collections::hash_map::Entry;

/// The outlines to cut, in machining order, and what the selection says of each.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Chosen {
    pub(crate) outlines: Vec<usize>,
    pub(crate) picks: FxHashMap<usize, Pick>,
}

impl Job<'_> {
    /// The outline that is cut where the entity with `handle` lies: of a double, that of the entity in the same place.
    pub(super) fn outline_of(&self, handle: &str) -> Result<usize, Refusal> {
        let Some(id) = self.drawing.find(handle) else {
            return Err(Refusal::Sentence(say!(
                there_is_no_entity_with_the_handle,
                handle
            )));
        };
        let holds = |outline: &Outline, id: EntityId| {
            let mut pieces = outline.contour.pieces.iter();
            pieces.any(|piece| piece.entity == id)
        };
        let mut outlines = self.outlines.iter();
        let kept = outlines
            .find(|outline| holds(outline, id))
            .map(|outline| outline.contour.double_of.unwrap_or(id));
        let mut outlines = self.outlines.iter();
        let found = outlines.position(|outline| kept.is_some_and(|kept| holds(outline, kept)));
        found.ok_or_else(|| {
            Refusal::Sentence(say!(entity_belongs_to_no_contour_that_is_cut, handle))
        })
    }

    /// Indices of the outlines to cut, in machining order: all as they are drawn, or those that hold one of `handles` as these select
    /// them, brought into the `order`; the nearest is for [`Job::by_nearest`]. Those that are given `places` come first. What lies within a contour comes before it, because
    /// the part drops when the contour round it is cut. Doubles are no contours to cut.
    pub(super) fn chosen(
        &self,
        handles: Option<&[String]>,
        order: Order,
        places: &Places,
    ) -> Result<Chosen, Refusal> {
        let (drawing, outlines) = (self.drawing, self.outlines);
        let mut chosen: Vec<usize> = match handles {
            None => (0..outlines.len())
                .filter(|&index| outlines[index].contour.double_of.is_none())
                .collect(),
            Some(handles) => handles
                .iter()
                .map(|handle| self.outline_of(handle))
                .collect::<Result<_, _>>()?,
        };
        if handles.is_some() {
            chosen.extend(self.common_lines_within(&chosen));
        }
        let mut known = FxHashSet::default();
        chosen.retain(|&index| known.insert(index));
        if chosen.is_empty() {
            return Err(Refusal::Sentence(say!(there_is_no_contour_to_cut).into()));
        }
        let nested = Nesting::new(drawing, outlines, &chosen);
        let mut in_order = match order {
            Order::AsDrawn | Order::AsPicked | Order::Nearest => nested.just_before(),
            Order::InsideFirst => nested.inside_first(),
        };
        if order != Order::AsPicked && !places.is_empty() {
            let turns = nested.turns(&chosen, places);
            in_order.sort_by_key(|&place| turns[place]);
        }
        let in_order = in_order.into_iter();
        let mut outlines_in_order: Vec<usize> = in_order.map(|place| chosen[place]).collect();
        self.behind_their_openings(&mut outlines_in_order);
        let picks = if order == Order::AsPicked {
            self.picked(handles.unwrap_or_default())
        } else {
            FxHashMap::default()
        };
        Ok(Chosen {
            outlines: outlines_in_order,
            picks,
        })
    }

    /// What the handles say of contours of more than one entity: the cut begins with the first, and goes on to the second the shorter way.
    fn picked(&self, handles: &[String]) -> FxHashMap<usize, Pick> {
        let mut picks: FxHashMap<usize, Pick> = FxHashMap::default();
        let mut first_places: FxHashMap<usize, usize> = FxHashMap::default();
        for handle in handles {
            let (Some(id), Ok(index)) = (self.drawing.find(handle), self.outline_of(handle)) else {
                continue;
            };
            let contour = &self.outlines[index].contour;
            let count = contour.pieces.len();
            let Some(place) = contour
                .pieces
                .iter()
                .position(|piece| piece.entity == id)
                .filter(|_| count > 1)
            else {
                continue;
            };
            match first_places.entry(index) {
                Entry::Vacant(entry) => {
                    entry.insert(place);
                    picks.insert(
                        index,
                        Pick {
                            first: id,
                            turned: None,
                        },
                    );
                }
                Entry::Occupied(entry) => {
                    let Some(pick) = picks
                        .get_mut(&index)
                        .filter(|pick| pick.turned.is_none() && pick.first != id)
                    else {
                        continue;
                    };
                    let first = *entry.get();
                    let (onward, back) = (
                        (place + count - first) % count,
                        (first + count - place) % count,
                    );
                    pick.turned = match (contour.closed, onward.cmp(&back)) {
                        (false, _) => Some(place < first),
                        (true, Ordering::Less) => Some(false),
                        (true, Ordering::Greater) => Some(true),
                        (true, Ordering::Equal) => None,
                    };
                }
            }
        }
        picks
    }

    /// Brings paths into an order in which each is followed by the one that begins nearest to where it
    /// ends, among those within which nothing is left to cut. The first one that may be cut begins.
    pub(super) fn by_nearest(&self, paths: Vec<WirePath>, places: &Places) -> Vec<WirePath> {
        // The paths of a contour stay together.
        let (mut firsts, mut lasts): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
        for (index, path) in paths.iter().enumerate() {
            if index > 0 && paths[index - 1].outline == path.outline {
                lasts.pop();
            } else {
                firsts.push(index);
            }
            lasts.push(index);
        }
        let chosen: Vec<usize> = firsts.iter().map(|&index| paths[index].outline).collect();
        let mut nesting = Nesting::new(self.drawing, self.outlines, &chosen);
        let turns = nesting.turns(&chosen, places);
        for (line, opening) in self.openings_of_lines(&chosen) {
            let place = |of: usize| chosen.iter().position(|&other| other == of);
            if let (Some(line), Some(opening)) = (place(line), place(opening)) {
                nesting.around[opening].push(line);
            }
        }
        let mut within = vec![0_usize; chosen.len()];
        nesting
            .around
            .iter()
            .flatten()
            .for_each(|&outer| within[outer] += 1);
        let begins: Vec<Point> = firsts.iter().map(|&index| paths[index].begin()).collect();
        // What may be cut, from left to right.
        let key = |place: usize| (OrderedX(begins[place].x), place);
        let mut free: BTreeSet<(OrderedX, usize)> = (0..chosen.len())
            .filter(|&place| within[place] == 0)
            .map(key)
            .collect();
        let mut order = Vec::with_capacity(chosen.len());
        let first_of = |free: &BTreeSet<(OrderedX, usize)>| {
            let places = free.iter().map(|(_, place)| *place);
            places.min_by_key(|&place| (turns[place], place))
        };
        let mut next = first_of(&free);
        while let Some(place) = next {
            free.remove(&key(place));
            order.push(place);
            for &outer in &nesting.around[place] {
                within[outer] -= 1;
                if within[outer] == 0 {
                    free.insert(key(outer));
                }
            }
            if !places.is_empty()
                && let Some(given) = first_of(&free).filter(|&next| turns[next] != u32::MAX)
            {
                next = Some(given);
                continue;
            }
            let here = paths[lasts[place]].end();
            let mut best: Option<(f64, usize)> = None;
            let middle = (OrderedX(here.x), 0);
            let (mut left, mut right) = (
                free.range(..middle).rev().peekable(),
                free.range(middle..).peekable(),
            );
            // Both ways from here, until what comes is further off by its x alone.
            loop {
                let reach = best.map_or(f64::INFINITY, |(distance, _)| distance);
                let nearer = |at: Option<&&(OrderedX, usize)>| {
                    at.map(|(x, _)| (x.0 - here.x).abs())
                        .filter(|away| *away <= reach)
                };
                let found = match (nearer(left.peek()), nearer(right.peek())) {
                    (None, None) => break,
                    (Some(a), Some(b)) if a <= b => left.next(),
                    (Some(_), None) => left.next(),
                    (_, Some(_)) => right.next(),
                };
                let Some(&(_, other)) = found else { break };
                let candidate = ((begins[other] - here).norm(), other);
                if best.is_none_or(|best| {
                    candidate
                        .0
                        .total_cmp(&best.0)
                        .then(candidate.1.cmp(&best.1))
                        .is_lt()
                }) {
                    best = Some(candidate);
                }
            }
            next = best.map(|(_, other)| other);
        }
        let mut paths: Vec<Option<WirePath>> = paths.into_iter().map(Some).collect();
        order
            .into_iter()
            .flat_map(|place| firsts[place]..=lasts[place])
            .filter_map(|index| paths[index].take())
            .collect()
    }
}

/// A coordinate that can be sorted by.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OrderedX(f64);

impl Eq for OrderedX {}

impl PartialOrd for OrderedX {
    fn partial_cmp(&self, other: &OrderedX) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for OrderedX {
    fn cmp(&self, other: &OrderedX) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// The contour in the direction of the cut, and whether that is against its own: as the selection says, else as the setting does. An
/// open contour is cut as drawn.
pub(super) fn directed(
    outline: &Outline,
    direction: Direction,
    picked: Option<bool>,
) -> (Contour, bool) {
    let turn = match (picked, direction) {
        (Some(turned), _) => turned,
        (None, Direction::AsDrawn) => false,
        (None, Direction::Ccw) => outline.contour.closed && outline.twice_area < 0.0,
        (None, Direction::Cw) => outline.contour.closed && outline.twice_area > 0.0,
    };
    (
        if turn {
            outline.contour.reversed()
        } else {
            outline.contour.clone()
        },
        turn,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Analysis;
    use crate::drawing::{Drawing, Entity, Geometry};
    use crate::settings::Effective;
    use std::sync::Arc as Shared;

    /// Circles by centre on the x axis and radius.
    fn drawn(circles: &[(f64, f64)]) -> (Drawing, Shared<Vec<Outline>>) {
        let mut drawing = Drawing::new(None);
        for &(x, radius) in circles {
            let geometry = Geometry::Circle {
                center: Point::new(x, 0.0),
                radius,
            };
            drawing.push(Entity {
                handle: "A".into(),
                layer: "0".into(),
                role: None,
                kind: crate::drawing::Kind::Circle,
                geometry,
            });
        }
        let outlines = Analysis::new(&drawing, Shared::new(Effective::default()))
            .outlines(&drawing)
            .clone();
        (drawing, outlines)
    }

    /// Circles by centre on the x axis and radius: the order in which they are cut.
    fn check(circles: &[(f64, f64)], expected: &[usize]) {
        let (drawing, outlines) = drawn(circles);
        let settings = Effective::default();
        let job = Job::of(&drawing, &outlines, &settings);
        let ordered = |order| {
            job.chosen(None, order, &Places::default())
                .map(|chosen| chosen.outlines)
        };
        assert_eq!(
            ordered(Order::InsideFirst),
            Ok(expected.to_vec()),
            "{circles:?}"
        );
        // In every order the inner ones come first.
        for order in [Order::AsDrawn, Order::AsPicked, Order::Nearest] {
            let found = ordered(order).unwrap();
            let at = |outline: usize| found.iter().position(|&other| other == outline).unwrap();
            for (inner, &(x, radius)) in circles.iter().enumerate() {
                for (outer, &(x1, radius1)) in circles.iter().enumerate() {
                    let holds = (x - x1).abs() + radius < radius1;
                    assert!(
                        !holds || at(inner) < at(outer),
                        "{order:?} {circles:?}: {found:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn as_drawn_only_what_has_to_is_moved() {
        let circles = [
            (1.0, 0.5),
            (21.0, 0.5),
            (0.0, 5.0),
            (-1.0, 0.5),
            (20.0, 5.0),
        ];
        let (drawing, outlines) = drawn(&circles);
        let settings = Effective::default();
        let job = Job::of(&drawing, &outlines, &settings);
        let ordered = |order| {
            job.chosen(None, order, &Places::default())
                .map(|chosen| chosen.outlines)
        };
        assert_eq!(ordered(Order::AsDrawn), Ok(vec![0, 1, 3, 2, 4]));
        assert_eq!(ordered(Order::InsideFirst), Ok(vec![0, 3, 2, 1, 4]));
    }

    #[test]
    fn holes_come_before_what_drops_them() {
        check(&[(0.0, 1.0), (5.0, 1.0), (10.0, 1.0)], &[0, 1, 2]);
        check(&[(0.0, 5.0), (2.0, 1.0), (-2.0, 1.0)], &[1, 2, 0]);
        check(&[(2.0, 1.0), (0.0, 5.0), (-2.0, 1.0)], &[0, 2, 1]);
        // A second part and its hole stay where they are.
        check(
            &[(0.0, 5.0), (20.0, 5.0), (20.0, 1.0), (0.0, 1.0)],
            &[3, 0, 2, 1],
        );
        // A punch in a hole of a punch.
        check(
            &[(0.0, 9.0), (0.0, 6.0), (0.0, 3.0), (1.0, 1.0)],
            &[3, 2, 1, 0],
        );
    }

    #[test]
    fn what_is_given_a_place_comes_first_and_what_lies_within_it_before_it() {
        let circles = [
            (0.0, 5.0),
            (1.0, 0.5),
            (20.0, 1.0),
            (30.0, 1.0),
            (-1.0, 0.5),
        ];
        let (drawing, outlines) = drawn(&circles);
        let settings = Effective::default();
        let job = Job::of(&drawing, &outlines, &settings);
        for (places, expected) in [
            (vec![], [1, 4, 0, 2, 3]),
            (vec![(3, 1)], [3, 1, 4, 0, 2]),
            (vec![(3, 2), (0, 1)], [1, 4, 0, 3, 2]),
            // A hole may have a place of its own before that, never after it.
            (vec![(3, 2), (0, 3), (4, 1)], [4, 3, 1, 0, 2]),
            (vec![(4, 9), (0, 3)], [1, 4, 0, 2, 3]),
        ] {
            let places: Places = places.into_iter().collect();
            for order in [Order::AsDrawn, Order::InsideFirst] {
                let found = job.chosen(None, order, &places).unwrap();
                assert_eq!(found.outlines, expected, "{order:?} {places:?}");
            }
        }
    }
}
