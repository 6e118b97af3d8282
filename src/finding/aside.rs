//! Entities drawn to be read and not to be cut, as data of a finding.

use std::sync::Arc;

/// Why a visible entity is not cut.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Aside {
    Linetype(Arc<str>),
    Layer(Arc<str>),
    /// A lone line, which crosses or lies within a closed contour.
    Lone,
}

/// The entities of one drawing that are not cut for one reason.
#[derive(Clone, Debug, PartialEq)]
pub struct SetAside {
    pub why: Aside,
    pub count: usize,
    /// Handles of the first entities, if only handles name them; empty where a name covers them.
    pub handles: Vec<Arc<str>>,
    /// For lone lines: those of their layers on which nothing is cut.
    pub(crate) spare_layers: Vec<Arc<str>>,
}

/// At most this many handles go into a setting.
pub(crate) const MOST_HANDLES: usize = 50;
