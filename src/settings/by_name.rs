//! What the settings say of layers, by their names.

use std::collections::BTreeMap;

/// Values by a name in which case does not matter, as it does not in CAD. Where names differ in nothing else, the one that is written like that
/// comes first.
#[derive(Clone, Debug, PartialEq)]
pub struct ByName<T> {
    /// The names as they are written.
    written: BTreeMap<String, T>,
    upper: BTreeMap<String, T>,
}

impl<T> Default for ByName<T> {
    fn default() -> Self {
        ByName {
            written: BTreeMap::new(),
            upper: BTreeMap::new(),
        }
    }
}

impl<T: Copy> ByName<T> {
    pub(super) fn of<'a>(all: impl Iterator<Item = (&'a String, T)>) -> ByName<T> {
        let mut by_name = ByName::default();
        all.for_each(|(name, value)| by_name.add(name, value));
        by_name
    }

    /// Adds a value, unless the name has one.
    pub(super) fn add(&mut self, name: &str, value: T) {
        self.written.entry(name.to_owned()).or_insert(value);
        self.upper.entry(name.to_uppercase()).or_insert(value);
    }

    pub(crate) fn get(&self, name: &str) -> Option<T> {
        let written = self.written.get(name);
        let found = match written {
            None if !self.upper.is_empty() => self.upper.get(&name.to_uppercase()),
            written => written,
        };
        found.copied()
    }

    /// The names as they are written.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.written.keys().map(String::as_str)
    }

    pub(super) fn values(&self) -> impl Iterator<Item = T> {
        self.written.values().copied()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.written.is_empty()
    }

    pub(crate) fn contains(&self, name: &str) -> bool {
        self.get(name).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_matters_only_between_names_that_differ_in_nothing_else() {
        let said = ["die", "Bohrung Ü", "PLATE", "plate"].map(str::to_owned);
        let by_name = ByName::of(said.iter().zip(1..));
        for (name, expected) in [
            ("DIE", Some(1)),
            ("die", Some(1)),
            ("Die", Some(1)),
            ("BOHRUNG ü", Some(2)),
            ("PLATE", Some(3)),
            ("plate", Some(4)),
            ("Plate", Some(3)),
            ("DIE1", None),
            ("", None),
        ] {
            assert_eq!(by_name.get(name), expected, "{name}");
        }
    }
}
