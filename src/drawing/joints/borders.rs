//! Edges that two outlines share, each drawn with its own: the two lie in one place, and both are chained.
//!
//! What is drawn twice is otherwise chained once. An edge between two outlines is told from it by where it leads: on both sides,
//! directly or over further edges that are drawn twice, to a place from where two other ways go on.

use super::{Doubles, Joints, SAME_PLACE};
use crate::drawing::ends::End;
use rustc_hash::FxHashMap;

impl Joints<'_> {
    /// Takes the edges that two outlines share out of the doubles.
    pub(super) fn keep_borders(&mut self) {
        let mut twins: FxHashMap<u32, Option<u32>> = FxHashMap::default();
        for (&double, &kept) in &self.doubles.aside {
            let twin = twins.entry(kept);
            twin.and_modify(|it| *it = None).or_insert(Some(double));
        }
        // Of three in one place one is too many, whichever that is.
        twins.retain(|_, twin| twin.is_some());
        let mut borders: Vec<u32> = Vec::new();
        for &kept in twins.keys() {
            for end in End::both(kept) {
                if self.ways_on(end).len() > 1 {
                    borders.extend(self.to_junction(kept, end.other(), &twins));
                }
            }
        }
        borders.sort_unstable();
        borders.dedup();
        for kept in borders {
            if let Some(twin) = twins.get(&kept).copied().flatten() {
                self.doubles.aside.remove(&twin);
                self.doubles.borders.extend([(kept, twin), (twin, kept)]);
            }
        }
        let Doubles { kept, borders, .. } = &mut self.doubles;
        kept.retain(|entity| !borders.contains_key(entity));
    }

    /// The edges that are drawn twice from one on to a place with several ways, out of its `tip`; none where they lead elsewhere.
    fn to_junction(
        &self,
        kept: u32,
        mut tip: End,
        twins: &FxHashMap<u32, Option<u32>>,
    ) -> Vec<u32> {
        let mut edges = vec![kept];
        loop {
            match self.ways_on(tip).as_slice() {
                &[next] if twins.contains_key(&next) && edges.len() <= twins.len() => {
                    edges.push(next);
                    let away = |end: &End| (self.place(*end) - self.place(tip)).norm();
                    let [start, end] = End::both(next);
                    tip = if away(&start) <= away(&end) {
                        end
                    } else {
                        start
                    };
                }
                [_, _, ..] => return edges,
                _ => return Vec::new(),
            }
        }
    }

    /// The entities with an end where one ends; of those that lie in one place the one that is kept.
    fn ways_on(&self, end: End) -> Vec<u32> {
        let kept = |entity: u32| self.doubles.aside.get(&entity).copied().unwrap_or(entity);
        let own = kept(end.entity());
        let mut met = Vec::new();
        self.each_near(end, |other, distance| {
            let of = kept(other.entity());
            if distance <= SAME_PLACE * self.cells.join && of != own && !met.contains(&of) {
                met.push(of);
            }
        });
        met
    }
}
