//! The request handlers, a file each: from the params to the core's answer.

pub(super) mod calibrate;
pub(super) mod code_action;
pub(super) mod commands;
pub(super) mod completion;
pub(super) mod contours;
pub(super) mod folding;
pub(super) mod formatting;
pub(super) mod generate;
pub(super) mod hints;
pub(super) mod hover;
pub(super) mod inspect;
pub(super) mod lenses;
pub(super) mod lifecycle;
pub(super) mod locate;
pub(super) mod navigation;
pub(super) mod pair;
mod params;
pub(super) mod picture;
#[cfg(feature = "testing")]
pub(super) mod probe;
pub(super) mod rename;
pub(super) mod selection;
pub(super) mod settings;
pub(super) mod signature;
pub(super) mod simulate;
pub(super) mod symbols;
pub(super) mod tokens;
pub(super) mod toolpath;

use super::context::RequestContext;
use super::errors::{self, refused};
use crate::document::{Document, Snapshot, Source};
use crate::finding::Finding;
use crate::job::{self, Cut, Refusal, Watch};
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, Result};

/// A drawing for one request, under its own options, if any.
struct Task {
    /// The document as it is open: findings have their places in it.
    subject: Arc<Document>,
    /// The document under the request's options.
    document: Arc<Document>,
    snapshot: Snapshot,
}

impl Task {
    fn of(context: &RequestContext) -> Result<Task> {
        let subject = context.drawn()?.clone();
        let under_options = context
            .options()?
            .filter(|options| options != subject.settings())
            .and_then(|options| {
                let drawing = subject.drawing()?.clone();
                Some(Arc::new(Document::new(Source::Cad(drawing), options)))
            });
        let document = under_options.unwrap_or_else(|| subject.clone());
        let snapshot = document
            .snapshot()
            .ok_or_else(|| refused(say!(the_document_is_a_program)))?;
        Ok(Task {
            subject,
            document,
            snapshot,
        })
    }

    /// All that is said is about the electrode, where one is set, also where a wire is.
    fn mill(&mut self) {
        let Ok(milled) = self.snapshot.settings.milled() else {
            return;
        };
        let milled = Arc::new(milled);
        let is_one = Arc::ptr_eq(&self.document, &self.subject);
        Arc::make_mut(&mut self.subject).set_settings(milled.clone());
        match is_one {
            true => self.document = self.subject.clone(),
            false => Arc::make_mut(&mut self.document).set_settings(milled),
        }
        if let Some(snapshot) = self.document.snapshot() {
            self.snapshot = snapshot;
        }
    }

    fn unit_mm(&self) -> f64 {
        self.document.unit_mm()
    }

    /// All findings under the task's settings; only those of the rules where the options made a document without its
    /// text.
    fn findings(&self) -> Vec<Finding> {
        self.document.all_findings().to_vec()
    }

    /// The wire's paths, part for part of a pair.
    fn cuts(&self, context: &RequestContext) -> Result<Vec<Cut>> {
        let cuts = job::cuts(&self.snapshot, context);
        cuts.map_err(|refusal| self.refused(context, &refusal))
    }

    fn refused(&self, context: &RequestContext, refusal: &Refusal) -> Error {
        errors::refusal(&self.subject, refusal, context.encoding)
    }
}

impl Watch for RequestContext {
    fn is_wanted(&self) -> bool {
        !self.is_cancelled()
    }

    fn at(&self, step: &'static str, share: Option<(usize, usize)>) {
        match share {
            Some((done, all)) => self.progress.share(step, done, all),
            None => self.progress.report(step),
        }
    }
}

fn no_entity(handle: &str) -> Error {
    Error::invalid_params(say!(there_is_no_entity, handle))
}
