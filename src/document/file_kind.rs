//! The kind of a file: by its name, else by its content; and how its bytes become the source of a document.

use super::Source;
use crate::dxf;
use crate::program::{self, Language};
use crate::settings::Effective;
use crate::text::Writing;

/// The kind of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FileKind {
    /// DXF, as text or binary: its bytes tell which.
    Drawing,
    Program(Language),
}

impl FileKind {
    /// All file extensions, in lower case and without their dots.
    pub(crate) fn endings() -> impl Iterator<Item = &'static str> {
        let programs = Language::ALL.into_iter().flat_map(Language::endings);
        dxf::ENDINGS.iter().chain(programs).copied()
    }

    /// By the ending of a name, in lower case.
    pub(crate) fn of_ending(ending: &str) -> Option<FileKind> {
        if dxf::ENDINGS.contains(&ending) {
            return Some(FileKind::Drawing);
        }
        Language::of_ending(ending).map(FileKind::Program)
    }

    /// By its content; `None` where that is neither DXF text nor a program.
    pub(crate) fn of_content(bytes: &[u8]) -> Option<FileKind> {
        let mut words = bytes
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty());
        if words.next() == Some(b"0") && words.next() == Some(b"SECTION") {
            return Some(FileKind::Drawing);
        }
        Language::of_content(bytes).map(FileKind::Program)
    }

    /// The source that the bytes of a file hold, and the encoding of a program. A drawing states the code page of its texts itself.
    pub(crate) fn read(self, bytes: Vec<u8>, settings: &Effective) -> (Source, Writing) {
        match self {
            FileKind::Drawing => (Source::Dxf(dxf::Document::read_file(bytes)), Writing::Plain),
            FileKind::Program(language) => {
                let (text, writing) = Writing::read(bytes);
                let program = program::Document::read(language, text, settings);
                (Source::Program(program), writing)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_those_of_drawings_and_programs() {
        let all: Vec<&str> = FileKind::endings().collect();
        assert_eq!(all, ["dxf", "dxb", "dxfb", "3b", "4b", "iso", "nc"]);
        for ending in all {
            assert!(FileKind::of_ending(ending).is_some(), "{ending}");
        }
        assert_eq!(FileKind::of_ending("dwg"), None);
    }

    #[test]
    fn a_program_in_gb_18030_is_read_as_such() {
        let kind = FileKind::Program(Language::ThreeB);
        // 凸模 in GB 18030.
        let bytes = b"; \xcd\xb9\xc4\xa3\nB1000B0B1000GXL1\nDD\n".to_vec();
        let (source, writing) = kind.read(bytes, &Effective::default());
        assert_eq!(writing, Writing::Gb18030);
        let Source::Program(program) = source else {
            panic!("a drawing")
        };
        assert!(program.text().as_str_lossy().starts_with("; 凸模\n"));
    }
}
