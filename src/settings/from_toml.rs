//! Reads settings from the project's file `wedm.toml`.

use super::level;
use super::toml_tree::tree;
use super::{PassFault, Settings, SettingsError};
use crate::disk;
use std::ops::Range;
use std::path::Path;

/// Name of the project's file.
pub(crate) const FILE_NAME: &str = "wedm.toml";

/// The most bytes of a settings file; nobody writes that many, and each takes hundreds in memory.
const LARGEST: usize = 1024 * 1024;

/// Whether there is something of that name that holds settings, or should: a folder and a link to nothing are there, too, and cannot be read.
pub(crate) fn is_there(path: &Path) -> bool {
    match std::fs::metadata(path) {
        Ok(metadata) => metadata.is_file() || metadata.is_dir(),
        Err(_) => std::fs::symlink_metadata(path).is_ok(),
    }
}

/// The bytes of a settings file, bounded even where the file has no end.
///
/// # Errors
/// A sentence: it cannot be read, or is too long for a settings file.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, String> {
    if path.is_dir() {
        return Err(say!(a_folder_is_no_file).into());
    }
    if !path.exists() && is_there(path) {
        return Err(say!(a_link_to_nothing).into());
    }
    disk::read_path_at_most(path, 16 * LARGEST as u64)
}

/// Reads a `wedm.toml`. Values that do not fit are left out and reported with their bytes;
/// everything else holds. A file larger than a mebibyte is left out as a whole.
pub fn from_toml(text: &str) -> (Settings, Vec<SettingsError>) {
    if text.len() > LARGEST {
        let message = say!(the_file_has_too_many_bytes, text.len(), LARGEST);
        return (
            Settings::default(),
            vec![SettingsError::new("", message, Some(0..0))],
        );
    }
    let (root, faults) = tree(text);
    let mut errors: Vec<SettingsError> = faults
        .into_iter()
        .map(|fault| SettingsError::new("", say!(not_toml, told(fault.message())), fault.span()))
        .collect();
    // After a fault the rest of the line is the parser's guess.
    let line_ends: Vec<usize> = memchr::memchr_iter(b'\n', text.as_bytes()).collect();
    errors.dedup_by_key(|error| {
        error.range.as_ref().map_or(0, |range| {
            line_ends.partition_point(|&end| end < range.start)
        })
    });
    let (settings, misfits) = level::read(&root);
    errors.extend(misfits);
    errors.sort_by_key(|error| error.range.as_ref().map_or(0, |range| range.start));
    (settings, errors)
}

/// What the parser found, in our words where it is common.
fn told(message: &str) -> String {
    let first = message.lines().next().unwrap_or_default();
    // By a word of the parser's, the rarer ones first.
    let known: [(&str, &str); 15] = [
        ("empty", say!(a_sign_without_a_key)),
        ("unquoted", say!(a_key_of_other_letters)),
        ("quoted", say!(a_value_without_quotes)),
        ("duplicate", say!(a_key_that_is_repeated)),
        ("zero", say!(a_number_that_is_none)),
        ("unexpected", say!(text_behind_a_value)),
        ("unclosed", say!(a_bracket_that_is_open)),
        ("basic", say!(a_quote_that_is_open)),
        ("literal", say!(a_quote_that_is_open)),
        ("escaped", say!(a_backslash_that_stands_for_nothing)),
        ("mantissa", say!(a_number_that_is_none)),
        ("fraction", say!(a_number_that_is_none)),
        ("float", say!(a_number_that_is_none)),
        ("integer", say!(a_number_that_is_none)),
        ("value", say!(a_key_without_a_sign)),
    ];
    let found = known.iter().find(|(word, _)| first.contains(word));
    found.map_or_else(
        || message.replace('\n', ", "),
        |(_, words)| (*words).to_owned(),
    )
}

/// The place in a `wedm.toml` of a fault of the passes; `None` where the file does not set it.
pub(crate) fn place_in(text: &str, fault: &PassFault) -> Option<Range<usize>> {
    if text.len() > LARGEST {
        return None;
    }
    level::place_of(&tree(text).0, fault)
}
