//! All pairs of a drawing, each laid in the other, and what comes of it.

use super::held::Held;
use super::{
    Fit, Pair, Spot, all_cut_twice, cut_twice, cut_twice_parts, drawn_pair, drawn_part, limits,
    name_of, partners, walls_of,
};
use crate::drawing::{Drawing, Outline, Role};
use crate::settings::{Effective, Partners};
use crate::toolpath::{Part, Refusal, Walls};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A punch and its plate, one laid in the other.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    pub parts: [Arc<Part>; 2],
    pub held: Held,
}

impl Fitted {
    /// Where less clearance is left than there should be.
    pub(crate) fn spots(&self) -> impl Iterator<Item = Spot> {
        self.held.spots(self.both())
    }

    pub(crate) fn both(&self) -> [&Part; 2] {
        self.parts.each_ref().map(|part| &**part)
    }
}

/// All pairs of a drawing.
#[derive(Debug, Default)]
pub(crate) struct Laid {
    /// Punch and plate, by their indices among all outlines; one that is cut twice stands for both.
    pub pairs: Vec<([usize; 2], Arc<Fitted>)>,
    /// Contours of workpieces that have no partner.
    pub alone: Vec<usize>,
}

impl Laid {
    /// A sentence says which keys are missing, or which contour has no path.
    pub(super) fn of(
        drawing: &Drawing,
        outlines: &[Outline],
        settings: &Effective,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Laid, Refusal> {
        let mut laid = Laid::default();
        match asked_of(settings)?.0 {
            Partners::CutTwice(_) => {
                for index in all_cut_twice(outlines) {
                    let outline = &outlines[index];
                    let parts = cut_twice_parts(drawing, outline, settings, None)?;
                    if !goes_on() {
                        return Err(Refusal::Cancelled);
                    }
                    let held = cut_twice(drawing, parts.each_ref(), settings);
                    let parts = parts.map(Arc::new);
                    laid.add([index; 2], Fitted { parts, held });
                }
            }
            Partners::Drawn => {
                let mut walls: FxHashMap<usize, Arc<Walls>> = FxHashMap::default();
                let mut walls_of = |index: usize, outline: &Outline| {
                    let walls = walls.entry(index);
                    let walls = walls.or_insert_with(|| walls_of(drawing, &outline.contour));
                    walls.clone()
                };
                let (drawn, _) = partners(drawing, outlines, settings, &mut walls_of, &|_| false);
                for &pair in &drawn.pairs {
                    let [of_punch, of_plate] = pair.map(|index| walls_of(index, &outlines[index]));
                    let [punch, plate] = pair.map(|index| &outlines[index]);
                    let part_of = |outline: &Outline, role: Role, walls: &Walls| {
                        drawn_part(drawing, outline, role, settings, Some(walls))
                    };
                    let parts = rayon::join(
                        || part_of(punch, Role::Punch, &of_punch),
                        || part_of(plate, Role::Opening, &of_plate),
                    );
                    if !goes_on() {
                        return Err(Refusal::Cancelled);
                    }
                    let parts = [parts.0?, parts.1?];
                    let held = drawn_pair(drawing, [punch, plate], parts.each_ref(), settings);
                    let parts = parts.map(Arc::new);
                    laid.add(pair, Fitted { parts, held });
                }
                laid.alone = drawn.alone;
            }
        }
        Ok(laid)
    }

    fn add(&mut self, pair: [usize; 2], fitted: Fitted) {
        self.pairs.push((pair, Arc::new(fitted)));
    }

    /// The fit of all these pairs, or a sentence where there are none.
    pub(crate) fn compared(
        &self,
        drawing: &Drawing,
        outlines: &[Outline],
        settings: &Effective,
    ) -> Result<Fit, Refusal> {
        if self.pairs.is_empty() && self.alone.is_empty() {
            return Err(Refusal::Sentence(say!(no_contour_is_of_a_pair).into()));
        }
        let clearance = asked_of(settings)?.1;
        let unit_mm = settings.unit_of(drawing).mm;
        let compared = |([punch, plate], fitted): &([usize; 2], Arc<Fitted>)| {
            let limits = limits(drawing, settings, punch == plate);
            let parts = fitted.both();
            let outline = |part: &Part| part.edges.iter().map(|edge| edge.geometry).collect();
            let (spots, ([punch, plate], least)) = rayon::join(
                || fitted.held.all_spots(parts),
                || {
                    let least = fitted.held.least_left(parts, &limits);
                    (parts.map(outline), least)
                },
            );
            Pair {
                least,
                spots,
                punch,
                plate,
            }
        };
        let first = |index: &usize| {
            let contour = &outlines.get(*index)?.contour;
            let segment = contour.segment(drawing, 0)?;
            let place = (segment.entity, segment.segment);
            Some((place, name_of(drawing, contour, settings)))
        };
        Ok(Fit {
            clearance: clearance / unit_mm,
            pairs: self.pairs.iter().map(compared).collect(),
            alone: self.alone.iter().filter_map(first).collect(),
            rounding: settings.tolerances.report / unit_mm,
        })
    }
}

/// How partners are recognised, and the clearance that there should be, mm.
fn asked_of(settings: &Effective) -> Result<(Partners, f64), Refusal> {
    if let Some(sentence) = settings.pair_error() {
        return Err(Refusal::Sentence(sentence));
    }
    let asked = settings.fit();
    asked.map_err(|missing| Refusal::Sentence(say!(whether_it_fits_needs, missing.listed())))
}
