//! The figures of milling a drawing, beside the reply that holds its program.

use crate::document::Snapshot;
use crate::toolpath;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The layers of an electrode, and what a simulation of its wear says of them. Lengths in mm; depths are below the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Milling {
    /// How far the electrode's axis runs beside a closed contour: half its diameter + the gap.
    pub correction: f64,
    /// How many layers there are.
    pub layers: usize,
    /// Height of a layer.
    pub layer: f64,
    /// Height of the last one.
    pub(crate) last_layer: f64,
    /// The depth that is wanted.
    pub depth: f64,
    /// In the order of the cuts.
    pub contours: Vec<MilledContour>,
}

/// What milling one contour comes to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct MilledContour {
    /// Handle of the contour's first entity.
    pub contour: String,
    /// Of the way in each layer.
    pub length: f64,
    /// K: by how much the electrode gets shorter in a layer, as a share of its height.
    pub wear_of_layer: f64,
    /// What each layer is fed at its beginning.
    pub feed: f64,
    /// What the last one is.
    pub(crate) last_feed: f64,
    /// What is fed on each mm of the way, where the wear is compensated linearly.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) feed_along: Option<f64>,
    /// Where the electrode is told to go at last.
    pub fed: f64,
    /// Simulated: mean depth of the floor along the way.
    pub depth: f64,
    /// Simulated: the highest and the deepest place of the floor.
    pub floor: Floor,
    /// Simulated: by how much the electrode is shorter then, the contours before among it.
    pub worn: f64,
}

/// How deep a floor lies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Floor {
    pub least: f64,
    pub most: f64,
}

impl Milling {
    pub(crate) fn new(snapshot: &Snapshot, milled: &toolpath::Milled) -> Milling {
        let electrode = &milled.electrode;
        let contour = |milled: &toolpath::MilledContour| {
            let outline = snapshot.outlines.get(milled.outline);
            let [mean, least, most] = milled.floor;
            MilledContour {
                contour: outline
                    .map_or("?", |outline| outline.name(&snapshot.drawing))
                    .into(),
                length: milled.length,
                wear_of_layer: milled.wear_of_layer,
                feed: milled.feed,
                last_feed: milled.last_feed,
                feed_along: (milled.feed_along > 0.0).then_some(milled.feed_along),
                fed: milled.fed,
                depth: mean,
                floor: Floor { least, most },
                worn: milled.worn,
            }
        };
        Milling {
            correction: electrode.correction(),
            layers: electrode.layers(),
            layer: electrode.layer,
            last_layer: electrode.last_layer(),
            depth: electrode.depth,
            contours: milled.contours.iter().map(contour).collect(),
        }
    }

    /// The sentences for a person: the layers, then each contour.
    pub(crate) fn told(&self, contours: usize) -> Vec<String> {
        let has_rest = self.last_layer < self.layer * (1.0 - 1e-6);
        let rest = |sentence: String| if has_rest { sentence } else { String::new() };
        let layers = say!(
            the_electrode_mills,
            self.layers,
            self.layer,
            rest(say!(the_last_of, self.last_layer)),
            self.correction
        );
        let contour = |milled: &MilledContour| {
            let along = milled.feed_along.map(|mm| say!(it_is_fed_along, mm * 1e3));
            say!(
                a_contour_is_milled,
                crate::message::readable(&milled.contour),
                milled.feed,
                rest(say!(the_last_is_fed, milled.last_feed)),
                along.unwrap_or_default(),
                say!(
                    a_floor_comes_out,
                    milled.depth,
                    milled.floor.least,
                    milled.floor.most,
                    milled.worn
                )
            )
        };
        let contours = self.contours.iter().take(contours).map(contour);
        std::iter::once(layers).chain(contours).collect()
    }
}
