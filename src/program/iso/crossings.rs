//! Where the cuts of a program cross themselves, found anew for what an edit has touched.

use super::cuts::{contours, way_of};
use super::document::Document;
use crate::finding::Finding;
use crate::program::path::{Found, Known};
use std::sync::Arc;

/// A cut with fewer moves does not cross itself.
const FEWEST_MOVES: u32 = 4;

/// What was found in the cuts of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct Crossings {
    known: Known,
    /// The cuts that cross themselves or lie on themselves, by their stretches and the runs in there, and where.
    found: Vec<(Vec<(usize, usize)>, Arc<Found>)>,
}

impl Crossings {
    /// Looks through a program; what is known of pairs of its parts is taken as it is.
    pub fn look(&mut self, document: &Document) {
        let Crossings { known, found } = self;
        found.clear();
        known.begin();
        contours(document, &mut |cut| {
            if !cut.run.whole || cut.run.faulty || cut.run.moves < FEWEST_MOVES {
                return;
            }
            let way = cut.way(document);
            let crossings = known.crossings(&way);
            if !crossings.is_clean() {
                found.push((cut.places(), crossings));
            }
        });
        known.tidy();
    }

    /// Whether a cut that crosses itself runs through a stretch.
    pub fn touch(&self, stretch: usize) -> bool {
        let mut places = self.found.iter().flat_map(|(places, _)| places);
        places.any(|(index, _)| *index == stretch)
    }

    /// The findings, in the order in which the cuts run.
    pub fn findings(&self, document: &Document) -> Vec<Finding> {
        let own = |(places, found): &(Vec<(usize, usize)>, Arc<Found>)| {
            found.findings(
                &way_of(document, places.clone(), None, None),
                document.text(),
            )
        };
        self.found.iter().flat_map(own).collect()
    }
}
