//! A tree of values out of the text of a TOML file.

use super::value::{Entry, Node, Value};
use std::num::IntErrorKind;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

/// The tree of a text, and its TOML errors.
pub(super) fn tree(text: &str) -> (Node, Vec<Error>) {
    let (table, faults) = DeTable::parse_recoverable(text);
    let root = Node {
        range: Some(table.span()),
        value: Value::Table(entries(table.get_ref())),
    };
    (root, faults)
}

fn entries(table: &DeTable<'_>) -> Vec<Entry> {
    let entries = table.iter().map(|(key, value)| Entry {
        key: key.get_ref().to_string(),
        key_range: Some(key.span()),
        node: node(value),
    });
    entries.collect()
}

fn node(value: &Spanned<DeValue<'_>>) -> Node {
    let range = Some(value.span());
    let value = match value.get_ref() {
        // The parser puts an empty stand-in where it found no value, which has been reported.
        DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_) | DeValue::Boolean(_)
            if value.span().is_empty() =>
        {
            Value::Null
        }
        DeValue::Boolean(truth) => Value::Truth(*truth),
        // A number that cannot be read has been reported.
        DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(number) => Value::Number(number as f64),
            Err(error) => match error.kind() {
                // Too large for any setting, which is said with the number.
                IntErrorKind::PosOverflow | IntErrorKind::NegOverflow => {
                    Value::Number(integer.as_str().parse().unwrap_or(f64::NAN))
                }
                _ => Value::Null,
            },
        },
        DeValue::Float(float) => {
            let number = float.as_str().parse();
            number.map_or(Value::Null, Value::Number)
        }
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Datetime(date) => Value::Text(date.to_string()),
        DeValue::Array(items) => Value::List(items.iter().map(node).collect()),
        DeValue::Table(table) => Value::Table(entries(table)),
    };
    Node { value, range }
}
