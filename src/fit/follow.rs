//! Two parts laid in each other follow an edit: only what has changed, and what depends on a changed place, is looked at again.

use super::about::{About, FitLimits};
use super::held::{Held, all_apart, look};
use super::places::own_places;
use crate::geometry::Bounds;
use crate::toolpath::{Moved, Part};

impl Held {
    /// Updates the result for two parts of which it is known what has moved, in place, under the same limits.
    pub(super) fn follow(&mut self, parts: [&Part; 2], moved: [&Moved; 2], limits: &FitLimits) {
        let boxes = || moved.iter().flat_map(|moved| &moved.boxes);
        let mut all = Bounds::EMPTY;
        boxes().for_each(|bounds| all.merge(bounds));
        let is_new = |asked: &Bounds| all.touches(asked) && boxes().any(|it| it.touches(asked));
        for (which, observations) in self.observations.iter_mut().enumerate() {
            if observations.asked.is_empty() {
                continue;
            }
            let [own, other] = match which {
                1 => [moved[1], moved[0]],
                _ => moved,
            };
            for (gone, new) in &own.edges {
                let new = std::iter::repeat_n(Bounds::EMPTY, *new);
                observations.asked.splice(gone.clone(), new);
            }
            let mut again: Vec<usize> = own.come().collect();
            observations.verdicts.retain_mut(|verdict| {
                let Some(edge) = own.is(verdict.edge as usize) else {
                    return false;
                };
                verdict.edge = edge as u32;
                match other.is(verdict.other as usize) {
                    Some(other) => verdict.other = other as u32,
                    None => again.push(edge),
                }
                true
            });
            let asked = observations.asked.iter().enumerate();
            again.extend(asked.filter_map(|(edge, asked)| is_new(asked).then_some(edge)));
            again.sort_unstable();
            again.dedup();
            let mut about = About::of(which, parts);
            for edge in again {
                about.asked = Bounds::EMPTY;
                let verdict = look(which, parts, edge, &mut about, limits);
                observations.asked[edge] = about.asked;
                let known = &mut observations.verdicts;
                let at = known.partition_point(|known| (known.edge as usize) < edge);
                let is_known = |at: usize| known.get(at).map(|it| it.edge as usize) == Some(edge);
                let gone = at..at + usize::from(is_known(at));
                known.splice(gone, verdict);
            }
        }
        self.places = own_places(&self.observations, limits.rounding);
        (self.unless, self.apart) = all_apart(parts, &self.names, limits);
    }
}
