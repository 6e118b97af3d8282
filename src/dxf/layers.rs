//! Decodes texts, and keeps each layer name once.

use super::code_page::CodePage;
use super::strings::decoded;
use rustc_hash::FxHashMap;
use std::sync::Arc;

#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    by_bytes: FxHashMap<Box<[u8]>, Arc<str>>,
    last: Option<(Box<[u8]>, Arc<str>)>,
    code_page: Option<CodePage>,
}

impl Layers {
    pub(super) fn in_code_page(code_page: Option<CodePage>) -> Layers {
        Layers {
            code_page,
            ..Layers::default()
        }
    }

    /// A value of the text in Unicode, its escapes resolved.
    pub(super) fn text(&self, bytes: &[u8]) -> String {
        match self.code_page {
            Some(code_page) => decoded(&code_page.unicode(bytes)),
            None => decoded(bytes),
        }
    }

    /// The name that stands in the text as `bytes`.
    pub(super) fn name(&mut self, bytes: &[u8]) -> Arc<str> {
        if let Some((last, name)) = &self.last
            && **last == *bytes
        {
            return name.clone();
        }
        let name = match self.by_bytes.get(bytes) {
            Some(name) => name.clone(),
            None => {
                let name: Arc<str> = self.text(bytes).into();
                self.by_bytes.insert(bytes.into(), name.clone());
                name
            }
        };
        self.last = Some((bytes.into(), name.clone()));
        name
    }
}
