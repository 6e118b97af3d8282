//! One file a request: params in, what the core says of the document out.

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
use super::errors::{refusal, refused};
use crate::document::{Document, Snapshot, Source};
use crate::drawing::{Drawing, Outline};
use crate::finding::Finding;
use crate::settings::Effective;
use crate::toolpath::{WirePath, plan_while};
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, Result};

/// A drawing as one request looks at it: under its own options, where it brings any.
struct Task {
    /// As it is open: findings have their places here.
    subject: Arc<Document>,
    /// Under the options.
    document: Arc<Document>,
    drawing: Arc<Drawing>,
    outlines: Arc<Vec<Outline>>,
    settings: Arc<Effective>,
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
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = document
            .snapshot()
            .ok_or_else(|| refused(say!(the_document_is_a_program)))?;
        Ok(Task {
            subject,
            document,
            drawing,
            outlines,
            settings,
        })
    }

    fn unit_mm(&self) -> f64 {
        self.settings.unit_of(&self.drawing).mm
    }

    /// All findings under the task's settings; of the rules alone where the options made a document without its text.
    fn findings(&self) -> Vec<Finding> {
        self.document.all_findings().to_vec()
    }

    /// The wire's path, of the contours with `handles` or of all.
    fn paths(
        &self,
        context: &RequestContext,
        settings: &Effective,
        handles: Option<&[String]>,
    ) -> Result<Vec<WirePath>> {
        plan_while(&self.drawing, &self.outlines, settings, handles, &|| {
            !context.is_cancelled()
        })
        .map_err(|reason| refusal(&self.subject, reason, context.encoding))
    }
}

fn no_entity(handle: &str) -> Error {
    Error::invalid_params(say!(there_is_no_entity, handle))
}
