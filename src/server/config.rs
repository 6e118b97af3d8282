//! The levels of settings, and which `wedm.toml` holds for which document.

use crate::disk::Fence;
use crate::finding::Severity;
use crate::settings::{
    Effective, FILE_NAME, Origin, Origins, Settings, SettingsError, from_json, from_toml, is_there,
    place_in, read_file as read_settings,
};
use crate::text::SourceText;
use ls_types::Uri;
use rustc_hash::{FxHashMap, FxHashSet};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

/// A project's file as it was found.
pub(super) struct ProjectFile {
    pub(crate) path: PathBuf,
    pub(crate) text: SourceText,
    pub(crate) settings: Settings,
    pub(crate) errors: Vec<SettingsError>,
}

/// The address of a rule's page, for clients that open such addresses by `wedm/rulePage`.
const PAGE_OF_CLIENT: &str = "wedm-rule:/{rule}.md";

#[derive(Clone, Default)]
pub(super) struct Config {
    /// Nothing beyond it is read but settings above it.
    fence: Fence,
    /// The client opens pages of rules itself.
    pub(crate) rule_pages: bool,
    initialization: Settings,
    /// `workspace/didChangeConfiguration` with the settings in it.
    pushed: Settings,
    /// The client's answer to `workspace/configuration`.
    pulled: Settings,
    folders: Vec<PathBuf>,
    /// Values at fault that the user has been shown, by level.
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
    pub(crate) fn within(fence: Fence) -> Config {
        Config {
            fence,
            ..Config::default()
        }
    }

    pub(crate) fn fence(&self) -> &Fence {
        &self.fence
    }

    pub(crate) fn set_folders(&mut self, folders: Vec<PathBuf>) {
        self.folders.clear();
        self.change_folders(&[], folders);
    }

    /// True for a document that may not be opened: its name is that of a file beyond the fence.
    pub(crate) fn bars(&self, uri: &str) -> bool {
        path_of(uri).is_some_and(|path| !self.fence.encloses(&path))
    }

    pub(crate) fn change_folders(&mut self, removed: &[PathBuf], added: Vec<PathBuf>) {
        self.folders.retain(|folder| !removed.contains(folder));
        let within = added
            .into_iter()
            .filter(|folder| self.fence.encloses(folder));
        self.folders.extend(within);
    }

    /// Replaces one level. Returns, as sentences with their severities, the values at fault that the user has not been
    /// told of yet.
    pub(crate) fn set_level(&mut self, level: Level, json: &Value) -> Vec<(Severity, String)> {
        let (settings, mut errors) = from_json(json);
        match level {
            Level::Initialization => self.initialization = settings,
            Level::Pushed => self.pushed = settings,
            Level::Pulled => self.pulled = settings,
        }
        errors.retain(|error| !error.of_levels);
        errors.extend(self.settings_for(None).contradictions(&|_| None));
        let said = |error: &SettingsError| {
            let sentence = say!(settings_in, level.name(), error.message);
            (error.severity, sentence)
        };
        let said: Vec<(Severity, String)> = errors.iter().map(said).collect();
        let sentences = said.iter().map(|(_, sentence)| sentence.clone());
        let old: FxHashSet<String> = self
            .shown
            .insert(level.name(), sentences.collect())
            .unwrap_or_default()
            .into_iter()
            .collect();
        said.into_iter()
            .filter(|(_, sentence)| !old.contains(sentence))
            .collect()
    }

    /// The settings for a document, before a request's own options; `file` is what [`Config::file_for`] found.
    pub(crate) fn settings_for(&self, file: Option<&ProjectFile>) -> Settings {
        let levels = self
            .initialization
            .overlaid(&self.pushed)
            .overlaid(&self.pulled);
        let mut settings = match file {
            Some(project) => levels.overlaid(&project.settings),
            None => levels,
        };
        if self.rule_pages && settings.docs_url.is_none() {
            settings.docs_url = Some(PAGE_OF_CLIENT.into());
        }
        settings
    }

    pub(crate) fn effective_for(&self, uri: &str, file: Option<&ProjectFile>) -> Arc<Effective> {
        let settings = self.settings_for(file);
        Arc::new(Effective {
            origins: self.origins(file, None),
            ..Effective::of_document(&settings, name_of(uri))
        })
    }

    /// Where correction, side and unit come from; `options` are those of a request.
    pub(crate) fn origins(
        &self,
        file: Option<&ProjectFile>,
        options: Option<&Settings>,
    ) -> Origins {
        let of_client = self.settings_for(None);
        let of_file = file.map(|file| (&file.settings, Origin::File));
        let of_options = options.map(|options| (options, Origin::Option));
        let levels = [Some((&of_client, Origin::Client)), of_file, of_options];
        Origins::of(levels.into_iter().flatten())
    }

    /// The folder from which the project's file for a document is looked for: its own, or that of the workspace where it
    /// is no file.
    pub(crate) fn folder_of(&self, uri: &str) -> Option<PathBuf> {
        match path_of(uri) {
            Some(path) if !self.fence.encloses(&path) => None,
            Some(path) => path.parent().map(Path::to_path_buf),
            None => self.folders.first().cloned(),
        }
    }

    /// The project's file for a document: upwards from its folder.
    pub(crate) fn file_for(
        &self,
        uri: &str,
        search: &mut Search,
        opened: &dyn Fn(&Path) -> Option<SourceText>,
    ) -> Option<Arc<ProjectFile>> {
        search.upwards(&self.folder_of(uri)?, opened)
    }

    /// The faults in a project's file with the text `text`, by itself and together with the client's settings.
    pub(crate) fn errors_in(&self, text: &str) -> Vec<SettingsError> {
        let (settings, mut errors) = from_toml(text);
        errors.retain(|error| !error.of_levels);
        let all = self.settings_for(None).overlaid(&settings);
        errors.extend(
            all.contradictions(&|fault| place_in(text, fault))
                .into_iter()
                .filter(|error| error.range.is_some()),
        );
        errors
    }
}

/// A search for project files at one moment: the disk is asked once for each folder, however many documents lie in it.
#[derive(Default)]
pub(super) struct Search {
    /// By folder: the file in it or in the nearest one above.
    found: FxHashMap<PathBuf, Option<Arc<ProjectFile>>>,
}

impl Search {
    pub(crate) fn upwards(
        &mut self,
        start: &Path,
        opened: &dyn Fn(&Path) -> Option<SourceText>,
    ) -> Option<Arc<ProjectFile>> {
        let mut asked = Vec::new();
        let mut found = None;
        for folder in start.ancestors() {
            if let Some(known) = self.found.get(folder) {
                found = known.clone();
                break;
            }
            asked.push(folder);
            found = read(&folder.join(FILE_NAME), opened).map(Arc::new);
            if found.is_some() {
                break;
            }
        }
        self.found.extend(
            asked
                .into_iter()
                .map(|folder| (folder.to_path_buf(), found.clone())),
        );
        found
    }
}

/// A project's file in its present state; `None` where there is none. `opened` are files whose text the client holds.
fn read(file: &Path, opened: &dyn Fn(&Path) -> Option<SourceText>) -> Option<ProjectFile> {
    match opened(file) {
        Some(text) => Some(parse(file, text)),
        None => is_there(file).then(|| read_file(file)),
    }
}

fn parse(path: &Path, text: SourceText) -> ProjectFile {
    let (settings, errors) = from_toml(&text.as_str_lossy());
    ProjectFile {
        path: path.to_path_buf(),
        settings,
        errors,
        text,
    }
}

fn read_file(path: &Path) -> ProjectFile {
    match read_settings(path) {
        Ok(bytes) => parse(path, SourceText::new(bytes)),
        Err(reason) => ProjectFile {
            path: path.to_path_buf(),
            text: SourceText::default(),
            settings: Settings::default(),
            errors: vec![SettingsError::new(
                "",
                say!(the_file_cannot_be_taken, reason),
                None,
            )],
        },
    }
}

/// The file that a URI names; `None` for anything but a `file:` URI.
pub(crate) fn path_of(uri: &str) -> Option<PathBuf> {
    let parsed = Uri::from_str(uri).ok()?;
    let is_file = parsed.scheme().as_str().eq_ignore_ascii_case("file");
    is_file
        .then(|| parsed.to_file_path().map(|path| path.into_owned()))
        .flatten()
}

/// The name of a document's file.
pub(super) fn name_of(uri: &str) -> Option<String> {
    let path = path_of(uri)?;
    Some(path.file_name()?.to_string_lossy().into_owned())
}

/// The URI of a file.
pub(crate) fn uri_of(path: &Path) -> Option<String> {
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
        std::fs::write(
            folder.path().join(FILE_NAME),
            "margin = 0.5\ncorrection = 0.3\n",
        )
        .unwrap();
        let mut config = Config::default();
        config.set_folders(vec![folder.path().to_path_buf()]);
        assert!(
            config
                .set_level(
                    Level::Initialization,
                    &json!({ "correction": 0.1, "side": "punch" })
                )
                .is_empty()
        );
        assert!(
            config
                .set_level(Level::Pulled, &json!({ "correction": 0.2, "gap": null }))
                .is_empty()
        );
        let nothing_open = |_: &Path| None;
        for uri in [uri_of(&deep.join("x.dxf")).unwrap(), "cad:///1".into()] {
            let file = config
                .file_for(&uri, &mut Search::default(), &nothing_open)
                .unwrap();
            let settings = config.settings_for(Some(&file));
            assert_eq!(
                (settings.correction, settings.margin),
                (Some(0.3), Some(0.5)),
                "{uri}"
            );
        }
        assert_eq!(config.settings_for(None).correction, Some(0.2));
        let edited = |_: &Path| Some(SourceText::new(b"correction = 0.4".to_vec()));
        let file = config
            .file_for("cad:///1", &mut Search::default(), &edited)
            .unwrap();
        assert_eq!(config.settings_for(Some(&file)).correction, Some(0.4));
    }

    #[test]
    fn one_search_asks_about_each_folder_once() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FILE_NAME), "margin = 0.5\n").unwrap();
        let asked = std::cell::Cell::new(0);
        let nothing_open = |_: &Path| {
            asked.set(asked.get() + 1);
            None
        };
        let (config, mut search) = (Config::default(), Search::default());
        for number in 0..1000 {
            let path = folder.path().join(format!("{}/{number}.dxf", number % 10));
            assert_eq!(
                config
                    .file_for(&uri_of(&path).unwrap(), &mut search, &nothing_open)
                    .unwrap()
                    .settings
                    .margin,
                Some(0.5)
            );
        }
        assert_eq!(asked.get(), 11);
    }

    #[test]
    fn a_misfit_is_told_once() {
        let mut config = Config::default();
        let bad = json!({ "correction": -1 });
        assert_eq!(
            config.set_level(Level::Pushed, &bad),
            [(
                Severity::Error,
                "settings in workspace/didChangeConfiguration: correction is -1, expected a number above 0".to_owned()
            )]
        );
        assert!(config.set_level(Level::Pushed, &bad).is_empty());
        assert!(config.set_level(Level::Pushed, &json!({})).is_empty());
        assert_eq!(config.set_level(Level::Pushed, &bad).len(), 1);
    }
}
