//! What a drawing is judged against, and where each value comes from: said after every answer, since nothing that was
//! assumed may look as if it had been checked.

use crate::document::Document;
use crate::drawing::Drawing;
use crate::settings::{Effective, Origin, SideSetting};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Against {
    /// mm; what radii are compared with: the largest of `corrections`.
    pub(crate) correction: f64,
    /// mm; that of each pass.
    pub(crate) corrections: Vec<f64>,
    pub(crate) correction_from: Origin,
    pub(crate) side: SideSetting,
    pub(crate) side_from: Origin,
    /// Millimetres in one unit of the drawing.
    pub(crate) units_to_mm: f64,
    pub(crate) units_from: Origin,
    /// The same as a sentence.
    pub(crate) said: String,
    #[serde(skip)]
    has_file: bool,
}

impl Against {
    /// `None` for a program.
    pub(crate) fn of(document: &Document) -> Option<Against> {
        Some(Against::new(document.settings(), document.drawing()?))
    }

    pub(crate) fn new(settings: &Effective, drawing: &Drawing) -> Against {
        let origins = settings.origins;
        let unit_mm = settings.unit_of(drawing).mm;
        let corrections: Vec<f64> = (settings.each_correction().into_iter())
            .map(as_stated)
            .collect();
        let said = [
            settings.said_corrections(),
            settings.said_side(),
            settings.said_unit(drawing),
        ];
        Against {
            correction: as_stated(settings.correction),
            corrections,
            correction_from: origins.correction,
            side: settings.side,
            side_from: origins.side,
            units_to_mm: unit_mm,
            units_from: settings.unit_from(drawing),
            said: said.join(say!(comma)),
            has_file: origins.has_file,
        }
    }

    /// The sentence for a terminal, where it says how a correction that nobody has stated is stated.
    pub(crate) fn on_a_terminal(&self) -> String {
        match self.correction_from {
            Origin::Default if !self.has_file => {
                let (bare, hinted) = (say!(the_default), say!(the_default_and_how_to_set_it));
                self.said.replacen(bare, hinted, 1)
            }
            _ => self.said.clone(),
        }
    }
}

/// mm, without what halving a diameter and adding a gap leave in the sixteenth place.
pub(crate) fn as_stated(mm: f64) -> f64 {
    (mm * 1e9).round() / 1e9
}
