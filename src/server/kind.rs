//! The kind of an open text: by the client's language id, else by its name.

use crate::document::FileKind;
use crate::program::Language;
use crate::settings::FILE_NAME;

/// The kind of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Dxf,
    Program(Language),
    /// The project's `wedm.toml`.
    Settings,
    /// A text that is not read here.
    Foreign,
}

impl Kind {
    /// By the client's language id, else by the file's name.
    pub(crate) fn of(language: &str, uri: &str) -> Kind {
        let path = uri.split(['?', '#']).next().unwrap_or_default();
        let name = path.rsplit('/').next().unwrap_or_default();
        if name.eq_ignore_ascii_case(FILE_NAME) {
            return Kind::Settings;
        }
        let by_name = name
            .rsplit_once('.')
            .map(|(_, extension)| extension.to_ascii_lowercase());
        if language == "dxf" {
            return Kind::Dxf;
        }
        let of_language = Language::of_id(language).map(FileKind::Program);
        match of_language.or_else(|| FileKind::of_ending(&by_name?)) {
            Some(FileKind::Drawing) => Kind::Dxf,
            Some(FileKind::Program(language)) => Kind::Program(language),
            None => Kind::Foreign,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_known_by_its_language_or_its_name() {
        let check = |language: &str, uri: &str, expected: Kind| {
            assert_eq!(Kind::of(language, uri), expected, "{language} {uri}")
        };
        check("dxf", "file:///a/b", Kind::Dxf);
        check("plaintext", "file:///a/B.DXF", Kind::Dxf);
        check("", "file:///a/b.dxb", Kind::Dxf);
        check("", "file:///a/b.dxfb", Kind::Dxf);
        check("", "untitled:plate.3b", Kind::Program(Language::ThreeB));
        check("3b", "file:///a/plate.txt", Kind::Program(Language::ThreeB));
        check("toml", "file:///a/wedm.toml", Kind::Settings);
        check("toml", "file:///a/Cargo.toml", Kind::Foreign);
        check(
            "wire-iso",
            "file:///a/plate.txt",
            Kind::Program(Language::Iso),
        );
        check("", "file:///a/plate.NC", Kind::Program(Language::Iso));
    }
}
