//! Drawing → contours → findings, and what of it may be reused after an edit.

use crate::drawing::{Delta, Drawing, DrawingEdit, Outline};
use crate::finding::{Finding, Fix};
use crate::settings::Effective;
use std::sync::Arc;

/// What is known of one drawing under one set of settings.
#[derive(Clone, Debug)]
pub struct Analysis {
    settings: Arc<Effective>,
    outlines: Arc<Vec<Outline>>,
}

impl Analysis {
    pub fn new(_drawing: &Drawing, settings: Arc<Effective>) -> Analysis {
        Analysis { settings, outlines: Arc::default() }
    }

    /// Looks again at what `delta` touched. Same result as a fresh [`Analysis::new`].
    pub fn update(&mut self, drawing: &Drawing, _delta: &Delta) {
        *self = Analysis::new(drawing, self.settings.clone());
    }

    /// The settings that the findings hold under.
    pub fn settings(&self) -> &Arc<Effective> {
        &self.settings
    }

    /// Contours with their roles, in machining order. Cheap to keep as a snapshot.
    pub fn outlines(&self) -> &Arc<Vec<Outline>> {
        &self.outlines
    }

    /// At most `limit` findings, errors first, then in machining order; and how many there are in all.
    pub fn findings(&mut self, _drawing: &Drawing, _limit: usize) -> (Vec<Finding>, usize) {
        (Vec::new(), 0)
    }

    /// The fixes of one finding, the preferred one first; empty where none is right.
    pub fn fixes(&self, _drawing: &Drawing, _finding: &Finding) -> Vec<Fix> {
        Vec::new()
    }

    /// One edit that makes every safe fix; `None` where there is none.
    pub fn fix_all(&self, _drawing: &Drawing) -> Option<DrawingEdit> {
        None
    }
}
