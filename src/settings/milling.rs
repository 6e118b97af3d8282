//! The settings of a milling electrode: complete, missing or contradictory, and the settings under which it cuts.

use super::effective::Effective;
use super::{
    Compensation, LengthSetting, MillingSettings, PassFault, Passes, Settings, WearCompensation,
};

/// No program has more layers than this.
const MOST_LAYERS: f64 = 100_000.0;

/// A cylindrical electrode and how it mills. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Electrode {
    pub diameter: f64,
    /// Spark gap beside it.
    pub gap: f64,
    /// Height of a layer.
    pub layer: f64,
    pub depth: f64,
    /// Volume that it loses of each volume that it erodes.
    pub wear: f64,
    pub compensation: WearCompensation,
    /// Distance after which `linear` feeds again; 0 for the others.
    pub step: f64,
    /// The round ends of an open slot count among the volume that a layer erodes.
    pub slot_ends: bool,
}

impl MillingSettings {
    /// The distance of the electrode's axis from a contour: its radius and the spark gap, where both are set.
    pub(super) fn correction(&self) -> Option<f64> {
        Some(self.tool_diameter? / 2.0 + self.gap?)
    }

    /// True where a key without a default is set.
    pub(crate) fn is_said(&self) -> bool {
        let numbers = [
            self.tool_diameter,
            self.gap,
            self.layer,
            self.depth,
            self.wear,
            self.step,
        ];
        numbers.iter().any(Option::is_some)
    }

    /// The electrode, or the fault: the key of this table, and a sentence.
    fn electrode(&self) -> Result<Electrode, (&'static str, String)> {
        let mut missing = Vec::new();
        let mut stated = |key: &'static str, value: Option<f64>| {
            if value.is_none() {
                missing.push(key);
            }
            value.unwrap_or_default()
        };
        let is_linear = self.wear_compensation() == WearCompensation::Linear;
        let read = Electrode {
            diameter: stated("milling.tool-diameter", self.tool_diameter),
            gap: stated("milling.gap", self.gap),
            layer: stated("milling.layer", self.layer),
            depth: stated("milling.depth", self.depth),
            wear: stated("milling.wear", self.wear),
            compensation: self.wear_compensation(),
            step: match is_linear {
                true => stated("milling.step", self.step),
                false => 0.0,
            },
            slot_ends: self.slot_ends(),
        };
        let Electrode { layer, depth, .. } = read;
        if let Some(first) = missing.first() {
            Err((first, say!(milling_needs, missing.join(", "))))
        } else if layer > depth {
            let key = "milling.layer";
            Err((key, say!(a_layer_above_the_depth, key, layer, depth)))
        } else if depth / layer > MOST_LAYERS {
            let key = "milling.layer";
            let layers = depth / layer;
            Err((key, say!(too_many_layers, key, layer, layers, MOST_LAYERS)))
        } else {
            Ok(read)
        }
    }
}

impl Effective {
    /// The electrode of the settings, or the sentence that says why there is none.
    pub fn electrode(&self) -> Result<Electrode, String> {
        self.milling.electrode().map_err(|(_, sentence)| sentence)
    }

    /// The settings under which it cuts: those for a wire alone do not apply.
    pub(crate) fn milled(&self) -> Result<Effective, String> {
        let electrode = self.electrode()?;
        let correction = electrode.correction();
        Ok(Effective {
            correction,
            corrections: vec![correction],
            pass: None,
            wire_diameter: None,
            gap: None,
            passes: Passes::default(),
            tab: LengthSetting::One(0.0),
            closing_overlap: 0.0,
            start_hole: None,
            stated_lead_in: None,
            compensation: Compensation::Path,
            stays_threaded: false,
            mills: true,
            ..self.clone()
        })
    }
}

/// Missing or contradictory settings of an electrode of which some are set.
pub(super) fn faults(settings: &Settings) -> Vec<PassFault> {
    let milling = settings.milling.as_ref();
    let milling = milling.filter(|milling| milling.is_said());
    let fault = milling.and_then(|milling| milling.electrode().err());
    let fault = fault.map(|(key, message)| PassFault::of(key, message));
    fault.into_iter().collect()
}
