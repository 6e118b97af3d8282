//! `wedm check --watch`: checks again whenever a file has changed. The files are polled a few times a second, which
//! also works on network drives, where the system reports no changes.

use super::{Arguments, report};
use crate::cli::{Failure, files, output};
use crate::settings;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

const PAUSE: Duration = Duration::from_millis(300);

/// Goes on until the process is ended.
pub(super) fn run(arguments: &Arguments) -> Result<std::convert::Infallible, Failure> {
    let mut seen = state(arguments);
    loop {
        report(arguments)?;
        let watched = say!(watching, say!(files, seen.len()));
        let now = chrono::Utc::now().format("%H:%M:%S UTC");
        output::say(&format!("{now} {watched}"));
        loop {
            std::thread::sleep(PAUSE);
            let now = state(arguments);
            if now != seen {
                seen = now;
                break;
            }
        }
    }
}

/// Every file that is checked, and every file of settings beside or above one, with its time of writing and its length.
fn state(arguments: &Arguments) -> Vec<(PathBuf, Option<SystemTime>, u64)> {
    let mut paths = files::search(&arguments.paths, &arguments.search()).files;
    let folders: std::collections::BTreeSet<PathBuf> = paths
        .iter()
        .filter_map(|path| path.canonicalize().ok()?.parent().map(Path::to_path_buf))
        .collect();
    let of_settings = folders.iter().flat_map(|folder| folder.ancestors());
    let of_settings: std::collections::BTreeSet<PathBuf> = of_settings
        .map(|folder| folder.join(settings::FILE_NAME))
        .filter(|file| settings::is_there(file))
        .collect();
    paths.extend(of_settings);
    paths.extend(arguments.common.config.clone());
    let stamp = |path: PathBuf| {
        let metadata = path.metadata().ok();
        let written = metadata.as_ref().and_then(|data| data.modified().ok());
        (path, written, metadata.map_or(0, |data| data.len()))
    };
    paths.into_iter().map(stamp).collect()
}
