//! The handle of an entity.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// Bytes that are stored inline: more than any hexadecimal handle of a CAD program has.
const SHORT: usize = 14;

/// The handle of an entity, as text from the source. Short ones, as nearly all are, take no memory of their own.
#[derive(Clone)]
pub struct Handle(Held);

#[derive(Clone)]
enum Held {
    Short { length: u8, bytes: [u8; SHORT] },
    Long(Arc<Box<str>>),
}

impl Handle {
    pub(crate) fn new(text: &str) -> Handle {
        let mut bytes = [0; SHORT];
        match (bytes.get_mut(..text.len()), u8::try_from(text.len())) {
            (Some(place), Ok(length)) => {
                place.copy_from_slice(text.as_bytes());
                Handle(Held::Short { length, bytes })
            }
            _ => Handle(Held::Long(Arc::new(text.into()))),
        }
    }
}

impl Default for Handle {
    fn default() -> Handle {
        Handle::new("")
    }
}

impl Deref for Handle {
    type Target = str;

    fn deref(&self) -> &str {
        match &self.0 {
            Held::Short { length, bytes } => bytes
                .get(..usize::from(*length))
                .and_then(|bytes| std::str::from_utf8(bytes).ok())
                .unwrap_or_default(),
            Held::Long(text) => text,
        }
    }
}

impl From<&str> for Handle {
    fn from(text: &str) -> Handle {
        Handle::new(text)
    }
}

impl From<String> for Handle {
    fn from(text: String) -> Handle {
        Handle::new(&text)
    }
}

impl PartialEq for Handle {
    fn eq(&self, other: &Handle) -> bool {
        match (&self.0, &other.0) {
            (
                Held::Short { length, bytes },
                Held::Short {
                    length: other_length,
                    bytes: other_bytes,
                },
            ) => length == other_length && bytes == other_bytes,
            _ => **self == **other,
        }
    }
}

impl Eq for Handle {}

impl PartialEq<str> for Handle {
    fn eq(&self, other: &str) -> bool {
        **self == *other
    }
}

impl PartialEq<String> for Handle {
    fn eq(&self, other: &String) -> bool {
        **self == **other
    }
}

impl std::hash::Hash for Handle {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        (**self).hash(state);
    }
}

impl std::borrow::Borrow<str> for Handle {
    fn borrow(&self) -> &str {
        self
    }
}

impl fmt::Display for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&**self, f)
    }
}

impl fmt::Debug for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handle_is_the_text_it_was_made_of() {
        assert!(size_of::<Handle>() == 16);
        for text in [
            "",
            "2A",
            "FFFFFFFFFFFFFF",
            "FFFFFFFFFFFFFFF",
            "1234567890ABCDEF",
            "führung-äöü",
            "a longer name of a drawing's own",
        ] {
            let handle = Handle::new(text);
            assert_eq!(&*handle, text);
            assert_eq!(handle.to_string(), text);
            assert!(handle == *text && handle != Handle::new("2B"));
        }
    }
}
