//! An open document: what the client sent, what was made of it, and what the client has been told.

use super::convert;
use super::requests::language::token_memory::TokenMemory;
use super::transport::panic_text;
use crate::document::{Document, Source};
use crate::drawing::Drawing;
use crate::program::{self, Language};
use crate::protocol::{Diagnostic, Range};
use crate::settings::{Effective, FILE_NAME, from_toml};
use crate::text::{Encoding, SourceText};
use crate::{dxf, finding::Rule};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Weak};

/// What a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Dxf,
    Program(Language),
    /// The project's `wedm.toml`.
    Settings,
    /// Nothing that is read here.
    Foreign,
}

impl Kind {
    /// By the language that the client names, else by the file's name.
    pub fn of(language: &str, uri: &str) -> Kind {
        let path = uri.split(['?', '#']).next().unwrap_or_default();
        let name = path.rsplit('/').next().unwrap_or_default();
        if name.eq_ignore_ascii_case(FILE_NAME) {
            return Kind::Settings;
        }
        let by_name = name.rsplit_once('.').map(|(_, extension)| extension.to_ascii_lowercase());
        match (language, by_name.as_deref()) {
            ("dxf", _) => Kind::Dxf,
            (language, ending) => match (Language::of_id(language), ending) {
                (Some(language), _) => Kind::Program(language),
                (None, Some("dxf")) => Kind::Dxf,
                (None, ending) => ending.and_then(Language::of_ending).map_or(Kind::Foreign, Kind::Program),
            },
        }
    }
}

pub(super) enum Content {
    /// Shared with workers: an edit while one still looks at it costs a copy.
    Read(Arc<Document>),
    Settings(SourceText),
    Foreign,
    /// Reading or judging it panicked: the text or drawing is kept, and tried again with the next change.
    Damaged(Remains),
}

pub(super) enum Remains {
    Text { kind: Kind, text: SourceText },
    Drawing(Arc<Drawing>),
}

pub(super) struct Open {
    /// The client's own spelling.
    pub uri: Arc<str>,
    pub version: i64,
    pub content: Content,
    /// Differs after every change: what was made for another stamp is out of date.
    pub stamp: u64,
    /// Number of findings at the last publish.
    pub findings: usize,
    /// The client has been told something since the opening.
    pub published: bool,
    /// The client has to be told something.
    pub dirty: bool,
    /// The copy of the text that requests look at, while any of them does.
    shot: Weak<Shot>,
    /// The semantic tokens that the client holds.
    pub tokens: Arc<TokenMemory>,
}

/// A text as it was at one stamp. Requests that come between two edits share one.
pub(super) struct Shot {
    pub text: SourceText,
    outdated: AtomicBool,
}

impl Shot {
    /// The document has changed since: nobody wants an answer about this text.
    pub fn is_outdated(&self) -> bool {
        self.outdated.load(Ordering::Relaxed)
    }
}

impl Open {
    pub fn text(uri: Arc<str>, version: i64, kind: Kind, text: String, settings: &Arc<Effective>, stamp: u64) -> Open {
        let content = match kind {
            Kind::Settings => Content::Settings(SourceText::new(text.into_bytes())),
            Kind::Foreign => Content::Foreign,
            Kind::Dxf | Kind::Program(_) => read_text(kind, text.into_bytes(), settings),
        };
        Open { uri, version, content, stamp, findings: 0, published: false, dirty: true, shot: Weak::new(), tokens: Arc::default() }
    }

    pub fn drawing(uri: Arc<str>, version: i64, drawing: Drawing, settings: &Arc<Effective>, stamp: u64) -> Open {
        Open {
            uri,
            version,
            content: judge_drawing(Arc::new(drawing), settings),
            stamp,
            findings: 0,
            published: false,
            dirty: true,
            shot: Weak::new(),
            tokens: Arc::default(),
        }
    }

    pub fn is_drawing(&self) -> bool {
        match &self.content {
            Content::Read(document) => matches!(document.source(), Source::Cad(_)),
            Content::Damaged(remains) => matches!(remains, Remains::Drawing(_)),
            Content::Settings(_) | Content::Foreign => false,
        }
    }

    /// The text for work beside the state thread; the first to ask between two edits has it copied (1 ms for 5 MB).
    pub fn shot(&mut self) -> Option<Arc<Shot>> {
        if let Some(shot) = self.shot.upgrade().filter(|shot| !shot.is_outdated()) {
            return Some(shot);
        }
        let text = self.source_text()?.clone();
        let shot = Arc::new(Shot { text, outdated: AtomicBool::new(false) });
        self.shot = Arc::downgrade(&shot);
        Some(shot)
    }

    /// Gives the document its next stamp: what was made for the one before is out of date.
    pub fn set_stamp(&mut self, stamp: u64) {
        self.stamp = stamp;
        if let Some(shot) = self.shot.upgrade() {
            shot.outdated.store(true, Ordering::Relaxed);
        }
        self.shot = Weak::new();
    }

    pub fn document(&self) -> Option<&Arc<Document>> {
        match &self.content {
            Content::Read(document) => Some(document),
            _ => None,
        }
    }

    pub fn source_text(&self) -> Option<&SourceText> {
        match &self.content {
            Content::Read(document) => document.text(),
            Content::Settings(text) | Content::Damaged(Remains::Text { text, .. }) => Some(text),
            Content::Foreign | Content::Damaged(Remains::Drawing(_)) => None,
        }
    }

    /// Replaces bytes of the text, whatever else comes of it.
    pub fn edit_text(&mut self, range: std::ops::Range<usize>, replacement: &str, settings: &Arc<Effective>) {
        match &mut self.content {
            Content::Settings(text) => text.replace(range, replacement),
            Content::Foreign | Content::Damaged(Remains::Drawing(_)) => {}
            Content::Damaged(Remains::Text { kind, text }) => {
                let kind = *kind;
                text.replace(range, replacement);
                let bytes = text.bytes().to_vec();
                self.content = read_text(kind, bytes, settings);
            }
            Content::Read(document) => {
                let before = document.text().map_or(0, SourceText::len);
                let edited = catch_unwind(AssertUnwindSafe(|| Arc::make_mut(document).edit_text(range.clone(), replacement)));
                if let Err(panic) = edited {
                    report(&*panic);
                    let (kind, mut text) = text_of(document);
                    // The panic came before the text was touched, or behind that.
                    let done = text.len() == before - range.len() + replacement.len()
                        && text.bytes().get(range.start..range.start + replacement.len()) == Some(replacement.as_bytes());
                    if !done {
                        text.replace(range, replacement);
                    }
                    self.content = read_text(kind, text.bytes().to_vec(), settings);
                }
            }
        }
    }

    /// Drops everything derived and makes it again from the text or drawing.
    pub fn rebuild(&mut self, settings: &Arc<Effective>) {
        let content = std::mem::replace(&mut self.content, Content::Foreign);
        self.content = match content {
            Content::Read(document) => match document.source() {
                Source::Cad(drawing) => judge_drawing(drawing.clone(), settings),
                _ => {
                    let (kind, text) = text_of(&document);
                    read_text(kind, text.bytes().to_vec(), settings)
                }
            },
            Content::Damaged(Remains::Text { kind, text }) => read_text(kind, text.bytes().to_vec(), settings),
            Content::Damaged(Remains::Drawing(drawing)) => judge_drawing(drawing, settings),
            other @ (Content::Settings(_) | Content::Foreign) => other,
        };
        self.dirty = true;
    }

    pub fn set_settings(&mut self, settings: &Arc<Effective>) {
        match &mut self.content {
            Content::Read(document) if document.settings() != settings => {
                let set = catch_unwind(AssertUnwindSafe(|| Arc::make_mut(document).set_settings(settings.clone())));
                self.dirty = true;
                if let Err(panic) = set {
                    report(&*panic);
                    self.rebuild(settings);
                }
            }
            Content::Damaged(_) => self.rebuild(settings),
            _ => {}
        }
    }

    /// What the client is shown now.
    pub fn diagnostics(&mut self, encoding: Encoding, shows_related: bool) -> Vec<Diagnostic> {
        let uri = shows_related.then_some(&*self.uri);
        match &mut self.content {
            Content::Read(document) => match catch_unwind(AssertUnwindSafe(|| convert::publish_of(Arc::make_mut(document), encoding, uri)))
            {
                Ok((diagnostics, count)) => {
                    self.findings = count;
                    diagnostics
                }
                Err(panic) => {
                    report(&*panic);
                    let settings = document.settings().clone();
                    self.rebuild(&settings);
                    vec![internal_error()]
                }
            },
            Content::Settings(text) => {
                let (_, errors) = from_toml(&text.as_str_lossy());
                convert::settings_diagnostics(text, &errors, encoding)
            }
            Content::Foreign => Vec::new(),
            Content::Damaged(_) => vec![internal_error()],
        }
    }
}

fn text_of(document: &Document) -> (Kind, SourceText) {
    let kind = document.program().map_or(Kind::Dxf, |program| Kind::Program(program.language()));
    (kind, document.text().cloned().unwrap_or_default())
}

fn read_text(kind: Kind, kept: Vec<u8>, settings: &Arc<Effective>) -> Content {
    let read = catch_unwind(AssertUnwindSafe(|| {
        let bytes = kept.clone();
        let source = match kind {
            Kind::Program(language) => Source::Program(program::Document::read(language, bytes, settings)),
            _ => Source::Dxf(dxf::Document::read(bytes)),
        };
        Arc::new(Document::new(source, settings.clone()))
    }));
    match read {
        Ok(document) => Content::Read(document),
        Err(panic) => {
            report(&*panic);
            Content::Damaged(Remains::Text { kind, text: SourceText::new(kept) })
        }
    }
}

fn judge_drawing(drawing: Arc<Drawing>, settings: &Arc<Effective>) -> Content {
    let kept = drawing.clone();
    let judged = catch_unwind(AssertUnwindSafe(|| Arc::new(Document::new(Source::Cad(drawing), settings.clone()))));
    match judged {
        Ok(document) => Content::Read(document),
        Err(panic) => {
            report(&*panic);
            Content::Damaged(Remains::Drawing(kept))
        }
    }
}

fn report(panic: &(dyn Any + Send)) {
    tracing::error!("a document could not be read or judged: {}", panic_text(panic));
}

fn internal_error() -> Diagnostic {
    Diagnostic {
        range: Range::default(),
        severity: 1,
        code: Rule::Syntax.name().into(),
        code_description: None,
        source: "wedm".into(),
        message: "internal error: the document could not be judged; its text is kept and is tried again with the next change".into(),
        related_information: None,
        data: None,
    }
}

#[cfg(test)]
mod tests {
    use super::Kind;
    use crate::program::Language;

    #[test]
    fn a_text_is_known_by_its_language_or_its_name() {
        let check = |language: &str, uri: &str, expected: Kind| assert_eq!(Kind::of(language, uri), expected, "{language} {uri}");
        check("dxf", "file:///a/b", Kind::Dxf);
        check("plaintext", "file:///a/B.DXF", Kind::Dxf);
        check("", "untitled:plate.3b", Kind::Program(Language::ThreeB));
        check("3b", "file:///a/plate.txt", Kind::Program(Language::ThreeB));
        check("toml", "file:///a/wedm.toml", Kind::Settings);
        check("toml", "file:///a/Cargo.toml", Kind::Foreign);
        check("wire-iso", "file:///a/plate.txt", Kind::Program(Language::Iso));
        check("", "file:///a/plate.NC", Kind::Program(Language::Iso));
    }
}
