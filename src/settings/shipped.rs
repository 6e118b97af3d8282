//! The shipped profiles as text: a setting that names one is checked against their names.

use super::toml_tree::tree;
use super::value::{Entry, Node, Value};
use std::sync::LazyLock;

static SHIPPED: LazyLock<Node> = LazyLock::new(|| tree(include_str!("profiles.toml")).0);

pub(super) fn shipped() -> &'static Node {
    &SHIPPED
}

/// Names of the shipped profiles.
pub fn shipped_profiles() -> impl Iterator<Item = &'static str> {
    let profiles: &[Entry] = match SHIPPED.entry("profiles").map(|entry| &entry.node.value) {
        Some(Value::Table(profiles)) => profiles,
        _ => &[],
    };
    profiles.iter().map(|profile| profile.key.as_str())
}
