//! Where the cuts of a program cross themselves, worked out again for the parts that an edit has touched.

use super::cut::JoinedCut;
use super::cuts::way_of;
use super::document::{Crossings, Document};
use crate::finding::Finding;
use crate::program::path::{Found, HasCuts};
use rustc_hash::FxHashSet;
use std::sync::Arc;

impl Crossings {
    /// Checks a program; known results about pairs of its parts are reused.
    pub(crate) fn look(&mut self, document: &Document) {
        let Crossings { known, found } = self;
        found.clear();
        document.look_through(
            known,
            document.contours().iter(),
            |cut: &JoinedCut, crossings| {
                if !crossings.is_clean() {
                    found.push((cut.places(), crossings));
                }
            },
        );
    }

    /// The stretches through which cuts run that cross themselves.
    pub(crate) fn touched(&self) -> FxHashSet<usize> {
        let places = self.found.iter().flat_map(|(places, _)| places);
        places.map(|(stretch, _)| *stretch).collect()
    }

    /// The first part of each of those cuts.
    pub(crate) fn begins(&self) -> FxHashSet<(usize, usize)> {
        let first = |(places, _): &(Vec<_>, _)| places.first().copied();
        self.found.iter().filter_map(first).collect()
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
