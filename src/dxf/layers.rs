//! Layer names, each kept once.

use super::strings::decoded;
use rustc_hash::FxHashMap;
use std::sync::Arc;

#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    by_bytes: FxHashMap<Box<[u8]>, Arc<str>>,
    last: Option<(Box<[u8]>, Arc<str>)>,
}

impl Layers {
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
                let name: Arc<str> = decoded(bytes).into();
                self.by_bytes.insert(bytes.into(), name.clone());
                name
            }
        };
        self.last = Some((bytes.into(), name.clone()));
        name
    }
}
