//! Entities drawn only to be read, not to be cut: their data and their sentence.

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

/// The most names in a list.
const LISTED: usize = 8;

pub(super) fn set_aside(parts: &[SetAside]) -> String {
    let count: usize = parts.iter().map(|part| part.count).sum();
    let entities = say!(entities, count);
    let are = if count == 1 { say!(is) } else { say!(are) };
    let mut said: Vec<String> = parts
        .iter()
        .take(LISTED)
        .map(|SetAside { why, count, .. }| match why {
            Aside::Linetype(name) => say!(in_a_linetype, count, name),
            Aside::Layer(name) => say!(on_a_layer, count, name),
            Aside::Lone if *count == 1 => say!(n1_lone_line).into(),
            Aside::Lone => say!(lone_lines, count),
        })
        .collect();
    let others: usize = parts.iter().skip(LISTED).map(|part| part.count).sum();
    if others > 0 {
        said.push(say!(others_of_them, others));
    }
    say!(drawn_to_be_read_and_not_cut, entities, are, said.join(", "))
}
