//! A document with everything derived from it, and the changes to it. All of it may run on a worker.

use super::convert;
use super::kind::Kind;
use super::transport::{Written, panic_text};
use crate::compare::{Beside, Form};
use crate::document::{Document, Source};
use crate::drawing::Drawing;
use crate::dxf;
use crate::finding::Rule;
use crate::program::{self, Language};
use crate::protocol::{self, Diagnostic, DrawingChange, Range};
use crate::settings::{Effective, from_toml};
use crate::text::{Encoding, SourceText};
use memchr::memmem;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

pub(super) enum Content {
    /// Shared with workers: an edit copies it while a worker still reads it.
    Read(Arc<Document>),
    Settings(SourceText),
    Foreign,
    /// A change of the text could not be read: what it is now only the client knows.
    Lost(Kind),
    /// Not read yet, or reading or judging it panicked: the text or drawing is kept, and tried again with the next
    /// change.
    Unread(Remains),
    /// A worker has it.
    Away,
}

pub(super) enum Remains {
    Text { kind: Kind, text: SourceText },
    Drawing(Arc<Drawing>),
}

/// Up to this many bytes of a text, or segments of a drawing, the state thread does the work: handing it over costs as
/// much.
const SMALL_TEXT: usize = 16 * 1024;
const SMALL_DRAWING: usize = 500;

/// Words by which a drawing or program may become much larger than its text.
const MULTIPLIERS_IN_DXF: [&[u8]; 4] = [b"INSERT", b"SPLINE", b"ELLIPSE", b"HATCH"];
const MULTIPLIERS_IN_ISO: [&[u8]; 2] = [b"98", b"L"];

impl Content {
    /// True where it is small, whatever it contains: reading it holds up nothing.
    pub(crate) fn is_small(&self) -> bool {
        match self {
            Content::Read(document) => match document.source() {
                Source::Cad(drawing) => is_small_drawing(drawing),
                Source::Dxf(dxf) => {
                    dxf.text().len() <= SMALL_TEXT && is_small_text(Kind::Dxf, dxf.text().bytes())
                }
                Source::Program(program) => is_small_text(self.kind(), program.text().bytes()),
            },
            Content::Unread(Remains::Text { kind, text }) => is_small_text(*kind, text.bytes()),
            Content::Unread(Remains::Drawing(drawing)) => is_small_drawing(drawing),
            Content::Settings(_) | Content::Foreign | Content::Lost(_) | Content::Away => true,
        }
    }

    pub(crate) fn kind(&self) -> Kind {
        match self {
            Content::Read(document) => kind_of(document),
            Content::Unread(Remains::Text { kind, .. }) | Content::Lost(kind) => *kind,
            Content::Settings(_) => Kind::Settings,
            _ => Kind::Foreign,
        }
    }

    pub(crate) fn source_text(&self) -> Option<&SourceText> {
        match self {
            Content::Read(document) => document.text(),
            Content::Settings(text) | Content::Unread(Remains::Text { text, .. }) => Some(text),
            Content::Foreign
            | Content::Lost(_)
            | Content::Away
            | Content::Unread(Remains::Drawing(_)) => None,
        }
    }

    /// The drawing, once it has been read.
    pub(crate) fn drawing(&self) -> Option<&Drawing> {
        match self {
            Content::Read(document) => document.drawing().map(|drawing| &**drawing),
            Content::Unread(Remains::Drawing(drawing)) => Some(drawing),
            _ => None,
        }
    }

    /// Replaces bytes of the text; does not read the document first if it has not been read.
    pub(crate) fn edit_text(&mut self, range: std::ops::Range<usize>, replacement: &str) {
        match self {
            Content::Settings(text) | Content::Unread(Remains::Text { text, .. }) => {
                text.replace(range, replacement)
            }
            Content::Foreign
            | Content::Lost(_)
            | Content::Away
            | Content::Unread(Remains::Drawing(_)) => {}
            Content::Read(document) => {
                let before = document.text().map_or(0, SourceText::len);
                let edited = catch_unwind(AssertUnwindSafe(|| {
                    Arc::make_mut(document).edit_text(range.clone(), replacement)
                }));
                if let Err(panic) = edited {
                    report(&*panic);
                    let (kind, mut text) = text_of(document);
                    // Tells whether the panic came before the text was changed or after.
                    let done = text.len() == before - range.len() + replacement.len()
                        && text
                            .bytes()
                            .get(range.start..range.start + replacement.len())
                            == Some(replacement.as_bytes());
                    if !done {
                        text.replace(range, replacement);
                    }
                    *self = Content::Unread(Remains::Text { kind, text });
                }
            }
        }
    }

    /// Makes changes of a drawing. The error says why nothing was changed, and whether it was a panic: then the drawing
    /// may hold half of them, and only the client knows the whole.
    pub(crate) fn change_drawing(&mut self, changes: Vec<DrawingChange>) -> Result<(), String> {
        let changed = catch_unwind(AssertUnwindSafe(|| match &mut *self {
            Content::Read(document) => Arc::make_mut(document)
                .edit_drawing(|drawing| protocol::apply(drawing, changes))
                .unwrap_or(Err(no_drawing())),
            Content::Unread(Remains::Drawing(drawing)) => {
                protocol::apply(Arc::make_mut(drawing), changes).map(|_| ())
            }
            _ => Err(no_drawing()),
        }));
        changed.unwrap_or_else(|panic| {
            report(&*panic);
            self.forget();
            Err(say!(internal_error, panic_text(&*panic)))
        })
    }

    pub(crate) fn set_settings(&mut self, settings: &Arc<Effective>) {
        if let Content::Read(document) = self
            && document.settings() != settings
            && let Err(panic) = catch_unwind(AssertUnwindSafe(|| {
                Arc::make_mut(document).set_settings(settings.clone())
            }))
        {
            report(&*panic);
            self.forget();
        }
    }

    /// Sets the document beside it; true where that is another one than before.
    pub(crate) fn set_beside(&mut self, beside: Beside) -> bool {
        let Content::Read(document) = self else {
            return false;
        };
        *document.beside() != beside && Arc::make_mut(document).set_beside(beside)
    }

    /// Prepares what the first edit needs, unless the document is in use.
    pub(crate) fn make_ready(&mut self) {
        if let Content::Read(document) = self
            && let Some(document) = Arc::get_mut(document)
            && let Err(panic) = catch_unwind(AssertUnwindSafe(|| document.make_ready()))
        {
            report(&*panic);
            self.forget();
        }
    }

    /// The data for comparing others with it.
    pub(super) fn form(&self) -> Option<Form> {
        let Content::Read(document) = self else {
            return None;
        };
        let form = catch_unwind(AssertUnwindSafe(|| document.form()));
        form.map_err(|panic| report(&*panic)).ok().flatten()
    }

    /// Drops everything that was derived from the text or drawing.
    pub(crate) fn forget(&mut self) {
        if let Content::Read(document) = self {
            let remains = match document.source() {
                Source::Cad(drawing) => Remains::Drawing(drawing.clone()),
                _ => {
                    let (kind, text) = text_of(document);
                    Remains::Text { kind, text }
                }
            };
            *self = Content::Unread(remains);
        }
    }

    /// Reads it, if it has not been read.
    pub(crate) fn read(&mut self, settings: &Arc<Effective>) {
        let Content::Unread(remains) = self else {
            return;
        };
        let read = catch_unwind(AssertUnwindSafe(|| {
            let source = match &*remains {
                Remains::Text {
                    kind: Kind::Program(language),
                    text,
                } => Source::Program(program::Document::read(
                    *language,
                    SourceText::with_room(text.bytes().to_vec()),
                    settings,
                )),
                Remains::Text { text, .. } => Source::Dxf(dxf::Document::of_text(text.clone())),
                Remains::Drawing(drawing) => Source::Cad(drawing.clone()),
            };
            Arc::new(Document::new(source, settings.clone()))
        }));
        match read {
            Ok(document) => *self = Content::Read(document),
            Err(panic) => report(&*panic),
        }
    }

    /// The findings for the client, and how many there are in all.
    pub(crate) fn diagnostics(
        &mut self,
        encoding: Encoding,
        related_of: Option<&str>,
        settings: &Arc<Effective>,
    ) -> (Written, usize) {
        match self {
            Content::Read(document) => {
                let found = catch_unwind(AssertUnwindSafe(|| {
                    convert::published(Arc::make_mut(document), encoding, related_of)
                }));
                found.unwrap_or_else(|panic| {
                    report(&*panic);
                    self.forget();
                    self.read(settings);
                    (convert::written(&[internal_error()]), 1)
                })
            }
            Content::Settings(text) => {
                let (_, errors) = from_toml(&text.as_str_lossy());
                let told = convert::settings_diagnostics(text, &errors, encoding);
                (convert::written(&told), 0)
            }
            Content::Foreign | Content::Away => (Written::default(), 0),
            Content::Lost(_) => (convert::written(&[fault(say!(the_text_is_not_known))]), 1),
            Content::Unread(_) => (convert::written(&[internal_error()]), 1),
        }
    }
}

fn no_drawing() -> String {
    say!(there_is_no_such_drawing_open).into()
}

fn kind_of(document: &Document) -> Kind {
    document
        .program()
        .map_or(Kind::Dxf, |program| Kind::Program(program.language()))
}

fn text_of(document: &Document) -> (Kind, SourceText) {
    (
        kind_of(document),
        document.text().cloned().unwrap_or_default(),
    )
}

pub(super) fn is_small_text(kind: Kind, text: &[u8]) -> bool {
    let multipliers: &[&[u8]] = match kind {
        Kind::Dxf => &MULTIPLIERS_IN_DXF,
        Kind::Program(Language::Iso) => &MULTIPLIERS_IN_ISO,
        Kind::Program(Language::ThreeB) | Kind::Settings | Kind::Foreign => &[],
    };
    text.len() <= SMALL_TEXT
        && !multipliers
            .iter()
            .any(|word| memmem::find(text, word).is_some())
}

pub(super) fn is_small_drawing(drawing: &Drawing) -> bool {
    let mut left = SMALL_DRAWING;
    drawing.entities().all(|(_, entity)| {
        let count = entity.geometry.segment_count().max(1);
        let fits = count <= left;
        left = left.saturating_sub(count);
        fits
    })
}

fn report(panic: &(dyn Any + Send)) {
    tracing::error!(
        "a document could not be read or judged: {}",
        panic_text(panic)
    );
}

fn internal_error() -> Diagnostic {
    fault(say!(internal_error_the_document_could_not_be_judged))
}

/// A fault of the whole document.
fn fault(message: &str) -> Diagnostic {
    Diagnostic {
        range: Range::default(),
        severity: 1,
        code: Rule::Syntax.name().into(),
        code_description: None,
        source: "wedm".into(),
        message: message.into(),
        related_information: None,
        data: None,
    }
}
