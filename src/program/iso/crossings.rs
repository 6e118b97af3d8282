//! Where the cuts of a program cross themselves, found anew for what an edit has touched.

use super::cuts::way_of;
use super::document::{Crossings, Document};
use crate::finding::Finding;
use crate::program::path::Found;
use std::sync::Arc;

/// A cut with fewer moves does not cross itself.
const FEWEST_MOVES: u32 = 4;

impl Crossings {
    /// Looks through a program; what is known of pairs of its parts is taken as it is.
    pub(crate) fn look(&mut self, document: &Document) {
        let Crossings { known, found } = self;
        found.clear();
        known.begin();
        for cut in document.contours() {
            if !cut.run.whole || cut.run.faulty || cut.run.moves < FEWEST_MOVES {
                continue;
            }
            let (mark, parts) = (cut.mark(document), cut.parts.len());
            let crossings = known.crossings(mark, parts, || cut.way(document));
            if !crossings.is_clean() {
                found.push((cut.places(), crossings));
            }
        }
        known.tidy();
    }

    /// Whether a cut that crosses itself runs through a stretch.
    pub(crate) fn touch(&self, stretch: usize) -> bool {
        let mut places = self.found.iter().flat_map(|(places, _)| places);
        places.any(|(index, _)| *index == stretch)
    }

    /// The findings, in the order in which the cuts run.
    pub(crate) fn findings(&self, document: &Document) -> Vec<Finding> {
        let own = |(places, found): &(Vec<(usize, usize)>, Arc<Found>)| {
            found.findings(
                &way_of(document, places.clone(), None, None),
                document.text(),
            )
        };
        self.found.iter().flat_map(own).collect()
    }
}
