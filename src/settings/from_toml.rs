//! Settings out of the project's file `wedm.toml`.

use super::reader;
use super::value::{Entry, Node, Value};
use super::{PassFault, Settings, SettingsError};
use crate::disk;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Name of the project's file.
pub(crate) const FILE_NAME: &str = "wedm.toml";

/// Bytes that a settings file may have; nobody writes so many, and each costs hundreds in memory.
const LARGEST: usize = 1024 * 1024;

/// The bytes of a settings file: no more than the reader refuses, of one that may have no end.
///
/// # Errors
/// A sentence: it cannot be read, or is no settings file by its length.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, String> {
    disk::read_path_at_most(path, 16 * LARGEST as u64)
}

/// Reads a `wedm.toml`. What does not fit is left out and reported with its bytes, everything else holds. Of one that is larger than
/// a mebibyte nothing does.
pub fn from_toml(text: &str) -> (Settings, Vec<SettingsError>) {
    if text.len() > LARGEST {
        let message = say!(the_file_has_too_many_bytes, text.len(), LARGEST);
        return (
            Settings::default(),
            vec![SettingsError::new("", message, Some(0..0))],
        );
    }
    let (table, faults) = DeTable::parse_recoverable(text);
    let mut errors: Vec<SettingsError> = faults
        .into_iter()
        .map(|fault| {
            SettingsError::new(
                "",
                say!(not_toml, fault.message().replace('\n', ", ")),
                fault.span(),
            )
        })
        .collect();
    // What follows a fault on its line is the parser's guess.
    let line_ends: Vec<usize> = memchr::memchr_iter(b'\n', text.as_bytes()).collect();
    errors.dedup_by_key(|error| {
        error.range.as_ref().map_or(0, |range| {
            line_ends.partition_point(|&end| end < range.start)
        })
    });
    let range = table.span();
    let (settings, misfits) = reader::read(&Node {
        value: Value::Table(entries(table.get_ref())),
        range: Some(range),
    });
    errors.extend(misfits);
    errors.sort_by_key(|error| error.range.as_ref().map_or(0, |range| range.start));
    (settings, errors)
}

/// Where a `wedm.toml` says what a fault of the passes speaks of; `None` where it says nothing of it.
pub(crate) fn place_in(text: &str, fault: &PassFault) -> Option<Range<usize>> {
    if text.len() > LARGEST {
        return None;
    }
    let (table, _) = DeTable::parse_recoverable(text);
    reader::place_of(
        &Node {
            value: Value::Table(entries(table.get_ref())),
            range: None,
        },
        fault,
    )
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
        // The parser puts an empty stand-in where it found no value; the fault has been said.
        DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_) | DeValue::Boolean(_)
            if value.span().is_empty() =>
        {
            Value::Null
        }
        DeValue::Boolean(truth) => Value::Truth(*truth),
        DeValue::Integer(integer) => {
            let number = i64::from_str_radix(integer.as_str(), integer.radix());
            Value::Number(number.map_or(f64::NAN, |number| number as f64))
        }
        DeValue::Float(float) => Value::Number(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Datetime(date) => Value::Text(date.to_string()),
        DeValue::Array(items) => Value::List(items.iter().map(node).collect()),
        DeValue::Table(table) => Value::Table(entries(table)),
    };
    Node { value, range }
}
