//! What is drawn to be read and not to be cut, as data of a finding and of what can be kept of it in the settings.

use super::{Fix, FixKind, Keep};
use crate::drawing::Role;
use std::sync::Arc;

/// Why something that is seen is not cut.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Aside {
    Linetype(Arc<str>),
    Layer(Arc<str>),
    /// A lone line, which crosses or lies within a closed contour.
    Lone,
}

/// What is not cut of one drawing for one reason.
#[derive(Clone, Debug, PartialEq)]
pub struct SetAside {
    pub why: Aside,
    pub count: usize,
    /// Handles of the first entities, where only these name them; empty for what a name stands for.
    pub handles: Vec<Arc<str>>,
    /// Layers on which nothing is cut but what is set aside; of lone lines.
    pub spare_layers: Vec<Arc<str>>,
}

/// Handles that a setting is written for at most.
pub(crate) const MOST_HANDLES: usize = 50;

impl SetAside {
    /// What the settings can keep of it: that it is cut all the same, that its layer is ignored.
    /// `role` is what it is cut as.
    pub(crate) fn keeps(&self, role: Role) -> Vec<Fix<Vec<Keep>>> {
        let role = role.name();
        let what = FixKind::CutAllTheSame {
            why: self.why.clone(),
        };
        let keeps = match &self.why {
            Aside::Linetype(name) => vec![(what, vec![Keep::new("linetypes", name, role)])],
            Aside::Layer(name) => {
                vec![ignored(name), (what, vec![Keep::new("layers", name, role)])]
            }
            Aside::Lone => {
                let ignore = self.spare_layers.iter().map(ignored);
                let cut = (self.handles.len() == self.count).then(|| {
                    let keep = |handle: &Arc<str>| Keep::new("contours", handle, role);
                    (what, self.handles.iter().map(keep).collect())
                });
                ignore.chain(cut).collect()
            }
        };
        keeps
            .into_iter()
            .map(|(kind, keeps)| Fix::keeping(kind, keeps))
            .collect()
    }
}

/// What leaves a layer out.
pub(crate) fn ignored(layer: &Arc<str>) -> (FixKind, Vec<Keep>) {
    let layer = layer.clone();
    let keep = Keep::new("layers", &layer, "ignore");
    (FixKind::IgnoreLayer { layer }, vec![keep])
}
