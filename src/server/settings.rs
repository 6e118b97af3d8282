//! The settings of each open document: the client's levels, the projects' files, and what follows when they change.

use super::client::Weight;
use super::config::{self, Level, ProjectFile, Search};
use super::content::Content;
use super::convert::{settings_diagnostics, written};
use super::judge::Task;
use super::state::State;
use super::transport::Publish;
use crate::finding::{Rule, Severity};
use crate::protocol::Diagnostic;
use crate::settings::Effective;
use crate::text::SourceText;
use ls_types::{WorkspaceFolder, WorkspaceFoldersChangeEvent};
use rustc_hash::FxHashMap;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Documents are judged under other settings for as long as this between other messages.
const SLICE: Duration = Duration::from_millis(10);

impl State {
    /// The settings of a document, with its project's file read again.
    pub(crate) fn settings_for(&mut self, uri: &str) -> Arc<Effective> {
        let file = self.file_for(uri);
        self.config.effective_for(uri, file.as_deref())
    }

    pub(crate) fn file_for(&mut self, uri: &str) -> Option<Arc<ProjectFile>> {
        let file = self
            .config
            .file_for(uri, &mut Search::default(), &|file| self.opened_text(file))?;
        self.show_file(&file.path, Some(&file));
        Some(file)
    }

    /// The text of a project's file that the client holds open.
    fn opened_text(&self, file: &Path) -> Option<SourceText> {
        self.documents
            .get(self.settings_texts.get(file)?)?
            .content
            .source_text()
            .cloned()
    }

    /// Shows the errors of a file that the client does not hold open itself.
    fn show_file(&mut self, file: &Path, project: Option<&ProjectFile>) {
        if self.settings_texts.contains_key(file) {
            self.shown_files.remove(file);
            return;
        }
        let errors = match project {
            Some(project) => {
                let own = project
                    .errors
                    .iter()
                    .filter(|error| error.rule == Rule::Settings)
                    .cloned();
                let beside = self
                    .config
                    .errors_in(&project.text.as_str_lossy())
                    .into_iter()
                    .filter(|error| error.rule != Rule::Settings);
                settings_diagnostics(
                    &project.text,
                    &own.chain(beside).collect::<Vec<_>>(),
                    self.encoding,
                )
            }
            None => Vec::new(),
        };
        let was_shown = self.shown_files.contains(file);
        if errors.is_empty() && !was_shown {
            return;
        }
        if errors.is_empty() {
            self.shown_files.remove(file);
        } else {
            self.shown_files.insert(file.to_path_buf());
        }
        self.publish_file(file, errors);
    }

    fn publish_file(&self, file: &Path, diagnostics: Vec<Diagnostic>) {
        if let Some(uri) = config::uri_of(file) {
            self.client.writer().publish(Publish {
                uri: uri.into(),
                version: None,
                diagnostics: written(&diagnostics),
                owed: false,
            });
        }
    }

    /// Called when settings of any level may have changed: every open document is judged under its new settings. Each
    /// folder is searched and each file read once, however many documents there are.
    pub(crate) fn settings_changed(&mut self) {
        self.forget_files();
        for file in self.shown_files.iter().cloned().collect::<Vec<_>>() {
            let project = config::read(&file, &|file| self.opened_text(file));
            self.show_file(&file, project.as_ref());
        }
        let mut search = Search::default();
        let mut effective: FxHashMap<(Option<PathBuf>, Option<String>), Arc<Effective>> =
            FxHashMap::default();
        let mut uris: Vec<Arc<str>> = self.documents.keys().cloned().collect();
        uris.sort_unstable();
        for uri in uris {
            let file = self
                .config
                .file_for(&uri, &mut search, &|file| self.opened_text(file));
            let key = (
                file.as_ref().map(|file| file.path.clone()),
                config::name_of(&uri),
            );
            let settings = match effective.get(&key) {
                Some(settings) => settings.clone(),
                None => {
                    if let Some(file) = &file {
                        self.show_file(&file.path, Some(file));
                    }
                    let settings = self.config.effective_for(&uri, file.as_deref());
                    effective.insert(key, settings.clone());
                    settings
                }
            };
            let Some(open) = self.documents.get_mut(&uri) else {
                continue;
            };
            let is_other = std::mem::replace(&mut open.settings, settings.clone()) != settings;
            if matches!(open.content, Content::Settings(_)) {
                // What is at fault there depends on the client's settings, too.
                self.mark_dirty(&uri);
            } else if is_other {
                open.tasks.push(Task::Settings);
                self.give_stamp(&uri);
                self.unsettled.push_back(uri);
            }
        }
    }

    /// Judges some of the documents with changed settings; the others hold up no edit or request meanwhile.
    pub(crate) fn judge_unsettled(&mut self) {
        let began = Instant::now();
        while began.elapsed() < SLICE
            && let Some(uri) = self.unsettled.pop_front()
        {
            if self
                .documents
                .get(&uri)
                .is_some_and(|open| !open.tasks.is_empty() && !open.is_away())
            {
                self.judge(&uri);
            }
        }
    }

    /// Replaces one level of the client's settings.
    pub(crate) fn set_level(&mut self, level: Level, json: &Value) {
        for (severity, misfit) in Arc::make_mut(&mut self.config).set_level(level, json) {
            let weight = match severity {
                Severity::Error => Weight::Error,
                _ => Weight::Warning,
            };
            self.client.show(weight, misfit);
        }
    }

    pub(crate) fn configuration_changed(&mut self, settings: &Value) {
        if !settings.is_null() {
            self.set_level(Level::Pushed, settings);
            self.settings_changed();
        }
        self.pull_configuration();
    }

    /// Asks for the section `wedm`, where the client supports that.
    pub(crate) fn pull_configuration(&mut self) {
        if !self.client.abilities.configuration {
            return;
        }
        let params = json!({ "items": [{ "section": "wedm" }] });
        let take = |state: &mut State, answer: Result<Value, String>| match answer {
            Ok(answer) => {
                state.set_level(Level::Pulled, answer.get(0).unwrap_or(&Value::Null));
                state.settings_changed();
            }
            Err(reason) => state.client.log(Weight::Warning, reason),
        };
        self.client.ask("workspace/configuration", params, take);
    }

    pub(crate) fn folders_changed(&mut self, event: &WorkspaceFoldersChangeEvent) {
        let paths = |folders: &[WorkspaceFolder]| -> Vec<PathBuf> {
            folders
                .iter()
                .filter_map(|folder| config::path_of(folder.uri.as_str()))
                .collect()
        };
        Arc::make_mut(&mut self.config).change_folders(&paths(&event.removed), paths(&event.added));
        self.settings_changed();
    }
}
