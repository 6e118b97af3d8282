//! Reads one level of settings from a tree of values, and checks it for itself.

use super::reader::Reader;
use super::spelling::snake_case;
use super::value::{Node, Value};
use super::{PassFault, Settings, SettingsError, rows};

/// Reads the root table. Null is an empty level.
pub(super) fn read(root: &Node) -> (Settings, Vec<SettingsError>) {
    let mut reader = Reader {
        all_keys: Some(rows),
        ..Reader::default()
    };
    let settings: Settings = reader.table("", root).unwrap_or_default();
    let errors = settings.contradictions(&|fault| place_of(root, fault));
    reader.errors.extend(errors);
    (settings, reader.errors)
}

/// The value that a fault concerns; for one of the passes without a value, the correction, else the wire's diameter.
pub(super) fn place_of(root: &Node, fault: &PassFault) -> Option<std::ops::Range<usize>> {
    let of_profile = |name: &str, key: &str| {
        let own = root.entry("profiles")?.node.entry(&snake_case(name))?;
        own.node.entry(&snake_case(key))?.node.range.clone()
    };
    if let Some((name, key)) =
        (fault.key.strip_prefix("profiles.")).and_then(|profile| profile.rsplit_once('.'))
    {
        return of_profile(name, key);
    }
    if fault.key == "program.profile" {
        let named = root.entry("program")?.node.entry("profile")?;
        return named.node.range.clone();
    }
    let (table, named) = (fault.key.split_once('.')).unwrap_or(("passes", &fault.key));
    let named = snake_case(named);
    let list = root.entry(table).and_then(|entry| match fault.pass {
        // A key of its own, with one value.
        usize::MAX if ["pair", "program", "job"].contains(&table) => entry.node.entry(&named),
        _ if table == "workpieces" => Some(entry),
        // A missing key is reported at the table.
        _ if table == "milling" => Some(entry.node.entry(&named).unwrap_or(entry)),
        _ => entry.node.entry(&named),
    });
    if ["pair", "program", "job", "workpieces", "milling"].contains(&table) {
        return list.and_then(|entry| entry.key_range.clone());
    }
    let of_list = list.and_then(|entry| match &entry.node.value {
        Value::List(items) => items.get(fault.pass).unwrap_or(&entry.node).range.clone(),
        _ => entry.node.range.clone(),
    });
    let of_key = |key: &str| root.entry(key).and_then(|entry| entry.node.range.clone());
    of_list
        .or_else(|| of_key("correction"))
        .or_else(|| of_key("wire_diameter"))
}
