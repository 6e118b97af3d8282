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

/// The bytes of a settings file, bounded even where the file has no end.
///
/// # Errors
/// A sentence: it cannot be read, or is too long for a settings file.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, String> {
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
        .map(|fault| {
            SettingsError::new(
                "",
                say!(not_toml, fault.message().replace('\n', ", ")),
                fault.span(),
            )
        })
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

/// The place in a `wedm.toml` of a fault of the passes; `None` where the file does not set it.
pub(crate) fn place_in(text: &str, fault: &PassFault) -> Option<Range<usize>> {
    if text.len() > LARGEST {
        return None;
    }
    level::place_of(&tree(text).0, fault)
}
