//! A document beside another one: the data by which they are compared, and the differences.

use super::{Asked, Document};
use crate::compare::{self, Beside, Drawn, Form, Traced};
use crate::finding::{Finding, Rule};
use std::sync::Arc;

impl Document {
    pub fn beside(&self) -> &Beside {
        &self.beside
    }

    /// Sets the document beside it for comparing; true where that has changed.
    pub(crate) fn set_beside(&mut self, beside: Beside) -> bool {
        let is_new = self.beside != beside;
        if is_new {
            let taken = std::mem::take(&mut self.asked.taken);
            self.beside = beside;
            self.asked = Asked {
                taken,
                ..Asked::default()
            };
        }
        is_new
    }

    /// The contours of a drawing, with which a program is compared.
    pub fn drawn(&self) -> Option<Arc<Drawn>> {
        let drawing = self.drawing()?;
        let drawn = || {
            let outlines = self.analysis.outlines(drawing);
            Arc::new(Drawn::of(drawing, outlines, self.settings()))
        };
        Some(self.asked.taken.drawn.get_or_init(drawn).clone())
    }

    /// The blocks of a program, with which a drawing is compared.
    pub fn traced(&self) -> Option<Arc<Traced>> {
        let program = self.program()?;
        let traced = || Arc::new(Traced::of(program));
        Some(self.asked.taken.traced.get_or_init(traced).clone())
    }

    /// The data by which others are compared with it.
    pub(crate) fn form(&self) -> Option<Form> {
        let traced = self.traced().map(Form::Traced);
        traced.or_else(|| self.drawn().map(Form::Drawn))
    }

    /// The differences from the document beside it.
    pub(super) fn unlike(&self) -> Arc<[Finding]> {
        let found = || {
            let settings = self.settings();
            if settings.severity(Rule::NotTheDrawing).is_none() {
                return Arc::default();
            }
            let found = match &self.beside {
                Beside::Nothing => None,
                Beside::Drawing(drawing, others) => self
                    .traced()
                    .map(|traced| compare::of_program(&traced, drawing, others, settings)),
                Beside::Programs(programs) => self
                    .drawn()
                    .map(|drawn| compare::of_drawing(&drawn, programs, settings)),
            };
            found.unwrap_or_default().into()
        };
        self.asked.beside.get_or_init(found).clone()
    }
}
