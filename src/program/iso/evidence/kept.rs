//! Evidence as each cut keeps it, so that an edit adds up what all say again.

use super::{Arcs, Evidence};

/// Counts of [`Evidence`] beside those of arcs.
const COUNTS: usize = 25;

/// What a cut keeps of its evidence: a program may have a hundred thousand, of few lines each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Kept {
    Few { counts: [u8; COUNTS], travel: u32 },
    Many(Box<Many>),
}

/// Counts beyond 255, or of arcs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Many {
    counts: [u32; COUNTS],
    travel: u64,
    arcs: [Option<Box<Arcs>>; 2],
}

impl Default for Kept {
    fn default() -> Kept {
        Evidence::default().kept()
    }
}

impl Evidence {
    /// All counts but those of arcs.
    fn counts(&mut self) -> impl Iterator<Item = &mut u32> {
        let own = [
            &mut self.numbers,
            &mut self.with_point,
            &mut self.bare,
            &mut self.long,
            &mut self.at_least_small,
            &mut self.corrections,
            &mut self.fine,
            &mut self.inches,
            &mut self.units,
        ];
        let of_decimals = self.places.iter_mut().chain(&mut self.ending_in_zero);
        own.into_iter().chain(of_decimals)
    }

    /// Adds what a cut has kept.
    pub(crate) fn add(&mut self, kept: &Kept) {
        match kept {
            Kept::Few { counts, travel } => {
                self.travel = self.travel.wrapping_add(u64::from(*travel));
                let counts = self.counts().zip(counts);
                counts.for_each(|(count, more)| *count += u32::from(*more));
            }
            Kept::Many(many) => {
                self.travel = self.travel.wrapping_add(many.travel);
                let counts = self.counts().zip(many.counts);
                counts.for_each(|(count, more)| *count += more);
                for (own, its) in self.arcs.iter_mut().zip(&many.arcs) {
                    if let Some(its) = its {
                        own.get_or_insert_default().add(its);
                    }
                }
            }
        }
    }

    /// The same as a cut keeps it.
    pub(crate) fn kept(mut self) -> Kept {
        let mut counts = [0; COUNTS];
        let both = counts.iter_mut().zip(self.counts());
        both.for_each(|(kept, count)| *kept = *count);
        let is_few = counts.iter().all(|count| *count <= u32::from(u8::MAX));
        match u32::try_from(self.travel) {
            Ok(travel) if is_few && self.arcs == [None, None] => Kept::Few {
                counts: counts.map(|count| count as u8),
                travel,
            },
            _ => Kept::Many(Box::new(Many {
                counts,
                travel: self.travel,
                arcs: self.arcs,
            })),
        }
    }
}
