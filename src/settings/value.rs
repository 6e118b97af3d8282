//! A tree of values with their places: the common form of TOML and JSON for the reader of settings.

use super::spelling::snake_case;
use std::ops::Range;

pub(super) enum Value {
    /// Not set.
    Null,
    Truth(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
}

pub(super) struct Node {
    pub(crate) value: Value,
    /// Bytes in the source text, where there is one.
    pub(crate) range: Option<Range<usize>>,
}

pub(super) struct Entry {
    pub(crate) key: String,
    pub(crate) key_range: Option<Range<usize>>,
    pub(crate) node: Node,
}

impl Node {
    /// The entry of a table under a key in snake_case.
    pub(crate) fn entry(&self, key: &str) -> Option<&Entry> {
        match &self.value {
            Value::Table(entries) => entries.iter().find(|entry| snake_case(&entry.key) == key),
            _ => None,
        }
    }
}

impl Entry {
    /// Without a place in a text.
    pub(crate) fn new(key: &str, node: Node) -> Entry {
        Entry {
            key: key.to_owned(),
            key_range: None,
            node,
        }
    }
}

impl Value {
    /// The value as a message shows it.
    pub(crate) fn shown(&self) -> String {
        match self {
            Value::Null => say!(not_set).into(),
            Value::Truth(truth) => truth.to_string(),
            // Hundreds of digits would tell less.
            Value::Number(number)
                if number.is_finite()
                    && (number.abs() >= 1e15 || number.abs() < 1e-9 && *number != 0.0) =>
            {
                format!("{number:e}")
            }
            Value::Number(number) => number.to_string(),
            Value::Text(text) => format!("\"{}\"", text.escape_debug()),
            Value::List(_) => say!(a_list).into(),
            Value::Table(_) => say!(a_table).into(),
        }
    }
}
