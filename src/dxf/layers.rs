//! Decodes texts, and keeps each layer name once.

use super::code_page::CodePage;
use super::strings::decoded;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    by_bytes: FxHashMap<Box<[u8]>, Arc<str>>,
    /// Each name once, and the last one that was decoded elsewhere.
    by_text: FxHashSet<Arc<str>>,
    last_shared: Option<(Arc<str>, Arc<str>)>,
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

    /// The same code page without names.
    pub(super) fn empty(&self) -> Layers {
        Layers::in_code_page(self.code_page)
    }

    /// Replaces a name that was decoded elsewhere by the shared copy.
    pub(super) fn share(&mut self, name: &mut Arc<str>) {
        if let Some((other, own)) = &self.last_shared
            && Arc::ptr_eq(other, name)
        {
            *name = own.clone();
            return;
        }
        let own = self.one_of(name.clone());
        let other = std::mem::replace(name, own.clone());
        self.last_shared = Some((other, own));
    }

    fn one_of(&mut self, name: Arc<str>) -> Arc<str> {
        if let Some(own) = self.by_text.get(&*name) {
            return own.clone();
        }
        self.by_text.insert(name.clone());
        name
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
                let name = self.text(bytes).into();
                let name = self.one_of(name);
                self.by_bytes.insert(bytes.into(), name.clone());
                name
            }
        };
        self.last = Some((bytes.into(), name.clone()));
        name
    }
}
