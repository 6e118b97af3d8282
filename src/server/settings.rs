//! The settings of each open document: the client's levels, the projects' files, and what follows when they change.

use super::client::Weight;
use super::config::{self, Level, ProjectFile};
use super::content::Content;
use super::convert::{settings_diagnostics, written};
use super::judge::Task;
use super::state::State;
use super::transport::Publish;
use crate::finding::{Rule, Severity};
use crate::protocol::Diagnostic;
use ls_types::{WorkspaceFolder, WorkspaceFoldersChangeEvent};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Documents are judged under other settings for as long as this between other messages.
const SLICE: Duration = Duration::from_millis(10);

impl State {
    /// Shows the errors of a file that the client does not hold open itself.
    pub(super) fn show_file(&mut self, file: &Path, project: Option<&ProjectFile>) {
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
    /// folder is searched once, however many documents lie in it.
    pub(crate) fn settings_changed(&mut self) {
        self.forget_files();
        self.looks.begin_again();
        for file in self.shown_files.clone() {
            let folder = file.parent().map(Path::to_path_buf);
            self.look_for_file(folder, Vec::new(), move |state, found| {
                if found.is_none_or(|found| found.path != file) {
                    state.show_file(&file, None);
                }
            });
        }
        let mut uris: Vec<Arc<str>> = self.documents.keys().cloned().collect();
        uris.sort_unstable();
        let mut by_folder: BTreeMap<Option<PathBuf>, Vec<Arc<str>>> = BTreeMap::new();
        for uri in uris {
            let open = self.documents.get(&uri);
            if open.is_some_and(|open| matches!(open.content, Content::Settings(_))) {
                // What is at fault there depends on the client's settings, too.
                self.mark_dirty(&uri);
            }
            let folder = self.config.folder_of(&uri);
            by_folder.entry(folder).or_default().push(uri);
        }
        for (folder, uris) in by_folder {
            self.look_for_file(folder, uris.clone(), move |state, file| {
                state.settle(uris, file.as_deref());
            });
        }
    }

    /// Gives documents of one folder the settings that hold for them now.
    fn settle(&mut self, uris: Vec<Arc<str>>, file: Option<&ProjectFile>) {
        for uri in uris {
            let settings = self.config.effective_for(&uri, file);
            let Some(open) = self.documents.get_mut(&uri) else {
                continue;
            };
            let is_other = std::mem::replace(&mut open.settings, settings.clone()) != settings;
            if is_other && !matches!(open.content, Content::Settings(_)) {
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
