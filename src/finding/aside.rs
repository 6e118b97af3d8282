//! What is drawn to be read and not to be cut, as data of a finding.

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
