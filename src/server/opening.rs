//! Documents come and go.

use super::client::Weight;
use super::config;
use super::content::Content;
use super::kind::Kind;
use super::open::Open;
use super::state::State;
use super::transport::{Publish, Written};
use std::sync::Arc;

impl State {
    /// Adds an open document, replacing one of the same URI.
    pub(crate) fn insert(&mut self, open: Open) {
        let uri = open.uri.clone();
        if matches!(open.content, Content::Settings(_))
            && let Some(path) = config::path_of(&uri)
        {
            self.settings_texts.insert(path, uri.clone());
        }
        let is_program = open.is_program();
        let old = self.documents.insert(uri.clone(), open);
        let link = old.map(|old| old.link).unwrap_or_default();
        self.opened_beside(&uri, &link, is_program);
        self.mark_dirty(&uri);
    }

    pub(crate) fn log_if_open(&self, uri: &Arc<str>) {
        if self.documents.contains_key(uri) {
            self.client.log(Weight::Info, say!(was_open_already, uri));
        }
    }

    /// Closes a document; false when it is not open.
    pub(crate) fn close(&mut self, uri: &Arc<str>) -> bool {
        let Some(open) = self.documents.remove(uri) else {
            return false;
        };
        if open.content.kind() == Kind::Settings {
            self.settings_texts.retain(|_, other| other != uri);
        }
        self.closed_beside(uri, &open.link);
        self.client.writer().publish(Publish {
            uri: uri.clone(),
            version: None,
            diagnostics: Written::default(),
            owed: true,
        });
        true
    }
}
