//! Which part is drawn on which layers.

use super::Settings;
use super::by_name::ByName;
use crate::drawing::{Contour, Drawing};

/// Parts by the layers they are drawn on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Workpieces {
    /// In the order of their names.
    names: Vec<String>,
    by_layer: ByName<u16>,
}

impl Workpieces {
    pub(super) fn of(settings: &Settings) -> Workpieces {
        let mut workpieces = Workpieces::default();
        for (name, layers) in settings.workpieces.iter().flatten() {
            workpieces.names.push(name.clone());
            let number = u16::try_from(workpieces.names.len()).unwrap_or(u16::MAX);
            for layer in layers {
                workpieces.by_layer.add(layer, number);
            }
        }
        workpieces
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// The number of the part that a layer belongs to, from 1; 0 for none.
    pub(crate) fn of_layer(&self, layer: &str) -> u16 {
        self.by_layer.get(layer).unwrap_or(0)
    }

    /// The number of the part that a contour belongs to: that of the layer of its first entity.
    pub(crate) fn of_contour(&self, drawing: &Drawing, contour: &Contour) -> u16 {
        let first = contour.pieces.first();
        let entity = first.and_then(|piece| drawing.get(piece.entity));
        entity.map_or(0, |entity| self.of_layer(&entity.layer))
    }

    /// The name of a part by its number.
    pub(crate) fn name(&self, number: u16) -> Option<&str> {
        let index = usize::from(number).checked_sub(1)?;
        self.names.get(index).map(String::as_str)
    }
}
