//! The levels of settings, and which `wedm.toml` holds for which document.

use crate::settings::{Effective, FILE_NAME, Settings, SettingsError, from_json, from_toml};
use crate::text::SourceText;
use ls_types::Uri;
use rustc_hash::FxHashMap;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

/// A `wedm.toml` longer than this is none.
const FILE_CAP: u64 = 1024 * 1024;

/// A project's file as it was read last.
pub(super) struct ProjectFile {
    pub text: SourceText,
    pub settings: Settings,
    pub errors: Vec<SettingsError>,
}

#[derive(Default)]
pub(super) struct Config {
    initialization: Settings,
    /// `workspace/didChangeConfiguration` with the settings in it.
    pushed: Settings,
    /// The client's answer to `workspace/configuration`.
    pulled: Settings,
    folders: Vec<PathBuf>,
    files: FxHashMap<PathBuf, Option<ProjectFile>>,
    /// Misfits that the user has been shown, by level.
    shown: FxHashMap<&'static str, Vec<String>>,
}

/// Which level a JSON value belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    Initialization,
    Pushed,
    Pulled,
}

impl Level {
    fn name(self) -> &'static str {
        match self {
            Level::Initialization => "initializationOptions",
            Level::Pushed => "workspace/didChangeConfiguration",
            Level::Pulled => "workspace/configuration",
        }
    }
}

impl Config {
    pub fn set_folders(&mut self, folders: Vec<PathBuf>) {
        self.folders = folders;
    }

    pub fn change_folders(&mut self, removed: &[PathBuf], added: Vec<PathBuf>) {
        self.folders.retain(|folder| !removed.contains(folder));
        self.folders.extend(added);
    }

    /// Takes one level anew. Returns the misfits that the user has not been told of yet, as sentences.
    pub fn set_level(&mut self, level: Level, json: &Value) -> Vec<String> {
        let (settings, errors) = from_json(json);
        match level {
            Level::Initialization => self.initialization = settings,
            Level::Pushed => self.pushed = settings,
            Level::Pulled => self.pulled = settings,
        }
        let sentences: Vec<String> = errors.iter().map(|error| format!("settings in {}: {}", level.name(), error.message)).collect();
        let old = self.shown.insert(level.name(), sentences.clone()).unwrap_or_default();
        sentences.into_iter().filter(|sentence| !old.contains(sentence)).collect()
    }

    /// The settings for a document, before a request's own options; `file` is what [`Config::file_for`] gave.
    pub fn settings_for(&self, file: Option<&Path>) -> Settings {
        let levels = self.initialization.overlaid(&self.pushed).overlaid(&self.pulled);
        match file.and_then(|file| self.files.get(file)).and_then(Option::as_ref) {
            Some(project) => levels.overlaid(&project.settings),
            None => levels,
        }
    }

    pub fn effective_for(&self, file: Option<&Path>) -> Arc<Effective> {
        Arc::new(Effective::of(&self.settings_for(file)))
    }

    /// The project's file that holds for a document: upwards from it, or from the workspace folder where it is no file.
    /// `opened` are files whose text the client holds; the disk is asked for the others and read anew.
    pub fn file_for(&mut self, uri: &str, opened: &dyn Fn(&Path) -> Option<SourceText>) -> Option<PathBuf> {
        let document = path_of(uri);
        let start = match &document {
            Some(path) => path.parent()?.to_path_buf(),
            None => self.folders.first()?.clone(),
        };
        start.ancestors().map(|folder| folder.join(FILE_NAME)).find(|file| self.read(file, opened))
    }

    /// Reads a file anew; false where there is none.
    pub fn read(&mut self, file: &Path, opened: &dyn Fn(&Path) -> Option<SourceText>) -> bool {
        let project = match opened(file) {
            Some(text) => Some(parse(text)),
            None => match std::fs::metadata(file) {
                Ok(metadata) if metadata.is_file() => Some(read_file(file, metadata.len())),
                _ => None,
            },
        };
        let found = project.is_some();
        self.files.insert(file.to_path_buf(), project);
        found
    }

    pub fn project_file(&self, file: &Path) -> Option<&ProjectFile> {
        self.files.get(file)?.as_ref()
    }
}

fn parse(text: SourceText) -> ProjectFile {
    let (settings, errors) = from_toml(&text.as_str_lossy());
    ProjectFile { settings, errors, text }
}

fn read_file(file: &Path, length: u64) -> ProjectFile {
    let refused = |message: String| ProjectFile {
        text: SourceText::default(),
        settings: Settings::default(),
        errors: vec![SettingsError { key: String::new(), message, range: None }],
    };
    if length > FILE_CAP {
        return refused(format!("the file is {length} bytes long, expected at most {FILE_CAP}"));
    }
    match std::fs::read(file) {
        Ok(bytes) => parse(SourceText::new(bytes)),
        Err(error) => refused(format!("the file cannot be read: {error}")),
    }
}

/// The file that a URI names; `None` for anything but a `file:` URI.
pub(super) fn path_of(uri: &str) -> Option<PathBuf> {
    let parsed = Uri::from_str(uri).ok()?;
    let is_file = parsed.scheme().as_str().eq_ignore_ascii_case("file");
    is_file.then(|| parsed.to_file_path().map(|path| path.into_owned())).flatten()
}

/// The URI of a file.
pub(super) fn uri_of(path: &Path) -> Option<String> {
    Uri::from_file_path(path).map(|uri| uri.as_str().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn later_levels_win_and_the_file_upwards_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let deep = folder.path().join("a").join("b c");
        std::fs::create_dir_all(&deep).unwrap();
        std::fs::write(folder.path().join(FILE_NAME), "margin = 0.5\ncorrection = 0.3\n").unwrap();
        let mut config = Config::default();
        config.set_folders(vec![folder.path().to_path_buf()]);
        assert!(config.set_level(Level::Initialization, &json!({ "correction": 0.1, "side": "punch" })).is_empty());
        assert!(config.set_level(Level::Pulled, &json!({ "correction": 0.2, "gap": null })).is_empty());
        let nothing_open = |_: &Path| None;
        for uri in [uri_of(&deep.join("x.dxf")).unwrap(), "cad:///1".into()] {
            let file = config.file_for(&uri, &nothing_open).unwrap();
            let settings = config.settings_for(Some(&file));
            assert_eq!((settings.correction, settings.margin), (Some(0.3), Some(0.5)), "{uri}");
        }
        assert_eq!(config.settings_for(None).correction, Some(0.2));
        let edited = |_: &Path| Some(SourceText::new(b"correction = 0.4".to_vec()));
        let file = config.file_for("cad:///1", &edited).unwrap();
        assert_eq!(config.settings_for(Some(&file)).correction, Some(0.4));
    }

    #[test]
    fn a_misfit_is_told_once() {
        let mut config = Config::default();
        let bad = json!({ "correction": -1 });
        assert_eq!(
            config.set_level(Level::Pushed, &bad),
            ["settings in workspace/didChangeConfiguration: correction is -1, expected a number above 0"]
        );
        assert!(config.set_level(Level::Pushed, &bad).is_empty());
        assert!(config.set_level(Level::Pushed, &json!({})).is_empty());
        assert_eq!(config.set_level(Level::Pushed, &bad).len(), 1);
    }
}
