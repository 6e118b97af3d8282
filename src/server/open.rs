//! An open document: the client's text or drawing, the result of judging it, and what the client has been told.

use super::content::Content;
use super::judge::Task;
use super::kind::Kind;
use super::links::Link;
use super::token_memory::TokenMemory;
use crate::compare::Form;
use crate::document::Document;
use crate::settings::Effective;
use crate::text::SourceText;
use std::sync::{Arc, Weak};

pub(super) struct Open {
    /// The URI in the client's own spelling.
    pub(crate) uri: Arc<str>,
    /// The version of the content.
    pub(crate) version: i64,
    pub(crate) content: Content,
    /// A drawing of a CAD program, not a text.
    pub(crate) is_drawing: bool,
    /// Its settings.
    pub(crate) settings: Arc<Effective>,
    /// Pending changes, in their order.
    pub(crate) tasks: Vec<Task>,
    /// It is to be judged and published.
    pub(crate) is_dirty: bool,
    /// Differs after every change: results for another stamp are out of date.
    pub(crate) stamp: u64,
    /// Number of findings at the last publish.
    pub(crate) findings: usize,
    /// The client has been told something since the opening.
    pub(crate) published: bool,
    /// The last judging took long.
    pub(crate) is_slow: bool,
    /// Dropped at the next change, which requests about the earlier state notice.
    revision: Arc<()>,
    /// The documents that it belongs to.
    pub(crate) link: Link,
    /// The data for comparing others with it, if there are any.
    pub(crate) form: Option<Form>,
    /// The semantic tokens that the client holds.
    pub(crate) tokens: Arc<TokenMemory>,
}

impl Open {
    /// A document that is yet to be read: its first task brings the text or drawing.
    pub(crate) fn new(
        uri: Arc<str>,
        version: i64,
        first: Task,
        settings: Arc<Effective>,
        stamp: u64,
    ) -> Open {
        let is_drawing = matches!(first, Task::Drawing(_));
        let (content, tasks) = match first {
            Task::Text {
                kind: Kind::Settings,
                text,
            } => (
                Content::Settings(SourceText::new(text.into_bytes())),
                Vec::new(),
            ),
            Task::Text {
                kind: Kind::Foreign,
                ..
            } => (Content::Foreign, Vec::new()),
            first => (Content::Foreign, vec![first]),
        };
        Open {
            uri,
            version,
            content,
            is_drawing,
            settings,
            tasks,
            is_dirty: false,
            stamp,
            findings: 0,
            published: false,
            is_slow: false,
            revision: Arc::default(),
            link: Link::default(),
            form: None,
            tokens: Arc::default(),
        }
    }

    /// Gives the document its next stamp: earlier results are out of date.
    pub(crate) fn set_stamp(&mut self, stamp: u64) {
        self.stamp = stamp;
        self.revision = Arc::default();
    }

    pub(crate) fn revision(&self) -> Weak<()> {
        Arc::downgrade(&self.revision)
    }

    pub(crate) fn document(&self) -> Option<&Arc<Document>> {
        match &self.content {
            Content::Read(document) => Some(document),
            _ => None,
        }
    }

    /// True for a program, read or not.
    pub(crate) fn is_program(&self) -> bool {
        let is_read = self.document().is_some_and(|own| own.program().is_some());
        let is_sent = |task: &Task| {
            matches!(
                task,
                Task::Text {
                    kind: Kind::Program(_),
                    ..
                }
            )
        };
        is_read || self.tasks.iter().any(is_sent)
    }

    pub(crate) fn is_away(&self) -> bool {
        matches!(self.content, Content::Away)
    }
}
