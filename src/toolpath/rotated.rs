//! A closed path from one of its points on.

use super::corners::{Element, between};
use super::path::{PathSegment, Source};
use crate::geometry::{Arc, Point, Segment};

/// A path that is travelled from one of its points on; a long one is not rearranged for that.
#[derive(Default)]
pub(super) struct Rotated {
    path: Vec<Element>,
    first: usize,
    /// If the first element is entered in its middle, the part after the point, and the part before it, which comes last.
    split: Option<[Segment; 2]>,
}

impl Rotated {
    /// All of a path from its beginning on.
    pub(super) fn whole(path: Vec<Element>) -> Rotated {
        Rotated {
            path,
            ..Rotated::default()
        }
    }

    /// A closed path turned round so that it begins and ends in `point` of element `index`, which is split there.
    pub(super) fn at(path: Vec<Element>, index: usize, point: Point) -> Rotated {
        let Some(&element) = path.get(index) else {
            return Rotated::whole(path);
        };
        if let (1, Segment::Arc(arc)) = (path.len(), element.geometry) {
            let turned = Arc {
                radius: arc.radius,
                ..Arc::about(arc.center, point, point, arc.sweep > 0.0)
            };
            return Rotated::whole(vec![Element {
                geometry: Segment::Arc(turned),
                ..element
            }]);
        }
        let geometry = &element.geometry;
        let share = geometry.share_of(point);
        let length = geometry.length();
        let (first, split) = match share * length {
            along if along <= 1e-9 => (index, None),
            along if along >= length - 1e-9 => ((index + 1) % path.len(), None),
            _ => {
                let behind = between(geometry, point, geometry.end());
                let before = between(geometry, geometry.start(), point);
                (index, Some([behind, before]))
            }
        };
        Rotated { path, first, split }
    }

    /// Where it begins, or the way back along it.
    pub(super) fn begin_of(&self, back: bool) -> Option<Point> {
        let (at, split) = match back {
            false => (self.first, 0),
            true => (
                self.first
                    .checked_sub(1)
                    .unwrap_or(self.path.len().checked_sub(1)?),
                1,
            ),
        };
        let piece = self
            .split
            .map_or(self.path.get(at)?.geometry, |split_in| split_in[split]);
        Some(if back { piece.end() } else { piece.start() })
    }

    /// The pieces of it, or of the way back along it, after a lead. They take the place of the path: a long one is not copied.
    pub(super) fn into_segments(
        mut self,
        back: bool,
        lead: Option<PathSegment>,
    ) -> Vec<PathSegment> {
        let count = self.path.len();
        if back {
            self.path.reverse();
            self.first = match self.split {
                Some(_) => count - 1 - self.first,
                None if self.first == 0 => 0,
                None => count - self.first,
            };
            self.split = self.split.map(|[behind, before]| [before, behind]);
        }
        let piece = |geometry: Segment, source: Source| PathSegment {
            geometry: if back { geometry.reversed() } else { geometry },
            source,
        };
        let of = |element: &Element| piece(element.geometry, element.source);
        let mut last: Vec<PathSegment> = self.path[..self.first].iter().map(of).collect();
        if let Some(first) = self.path.get_mut(self.first)
            && let Some([behind, before]) = self.split
        {
            first.geometry = behind;
            last.push(piece(before, first.source));
        }
        // What comes next, as long as something stands in its place.
        let mut next = lead;
        let rest = self.path.into_iter().skip(self.first);
        let mut all: Vec<PathSegment> = rest
            .map(|element| match &mut next {
                Some(next) => std::mem::replace(next, of(&element)),
                None => of(&element),
            })
            .collect();
        all.extend(next);
        all.append(&mut last);
        all
    }

    pub(super) fn into_path(mut self) -> Vec<Element> {
        let before = self.split.zip(self.path.get(self.first).copied());
        let last = before.map(|([_, before], first)| Element {
            geometry: before,
            ..first
        });
        if let Some(first) = self.path.get_mut(self.first)
            && let Some([behind, _]) = self.split
        {
            first.geometry = behind;
        }
        self.path.rotate_left(self.first);
        self.path.extend(last);
        self.path
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::EntityId;

    /// A path that is entered anywhere, gone either way, after a lead or without, is its pieces in their order.
    #[test]
    fn the_pieces_are_those_of_the_path_in_the_order_in_which_they_are_gone() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1.0, 5.0], [0.0, 3.0]];
        let at = |index: usize| Point::from(corners[index % 5]);
        let element = |segment: usize| Element {
            geometry: Segment::from_bulge(at(segment), at(segment + 1), 0.2 * segment as f64),
            source: Source::Segment {
                entity: EntityId(0),
                segment,
            },
            wall: segment,
        };
        let path: Vec<Element> = (0..5).map(element).collect();
        for (index, share, back, is_led) in (0..5).flat_map(|index| {
            let shares = [0.0, 0.3, 1.0].into_iter();
            let ways = shares.flat_map(|share| [(share, false), (share, true)]);
            ways.flat_map(move |(share, back)| [false, true].map(|led| (index, share, back, led)))
        }) {
            let begun = || {
                let point = path[index].geometry.point_at(share);
                Rotated::at(path.clone(), index, point)
            };
            let path = begun().into_path();
            let mut expected: Vec<PathSegment> = path.iter().map(Element::piece).collect();
            assert_eq!(expected.len(), if share == 0.3 { 6 } else { 5 });
            if back {
                expected.reverse();
                for piece in &mut expected {
                    piece.geometry = piece.geometry.reversed();
                }
            }
            let begin = expected[0].geometry.start();
            assert_eq!(begun().begin_of(back), Some(begin));
            let lead = is_led.then(|| PathSegment {
                geometry: Segment::line(Point::new(9.0, 9.0), begin),
                source: Source::LeadIn,
            });
            expected.splice(0..0, lead);
            let found = begun().into_segments(back, lead);
            assert_eq!(found, expected, "{index} {share} {back} {is_led}");
        }
        assert_eq!(Rotated::default().into_segments(true, None), []);
    }
}
