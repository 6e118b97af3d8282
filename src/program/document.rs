//! A program as an open document, in any language. A new language adds its variant here and is complete when this
//! compiles.

use super::numbering::{Numbers, Renumbering};
use super::path::{Step, Trace};
use super::report::Report;
use super::steps::{self, CutAt, Program};
use super::whereabouts::Whereabouts;
use super::{iso, three_b};
use crate::finding::{Fault, Finding, Rule, Severity, TextFix};
use crate::settings::Effective;
use crate::text::{SourceText, TextEdit, is_binary, is_utf_16};
use std::ops::Range;

/// Bytes of a text that tell what it is.
const HEAD: usize = 1024;

/// The languages of programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// 3B, and 4B in the same text.
    ThreeB,
    /// ISO words (G code) of wire EDM.
    Iso,
}

impl Language {
    pub(crate) const ALL: [Language; 2] = [Language::ThreeB, Language::Iso];

    /// `languageId` in the protocol.
    pub(crate) fn id(self) -> &'static str {
        match self {
            Language::ThreeB => "3b",
            Language::Iso => "wire-iso",
        }
    }

    /// Endings of file names, lower-case, the usual one first.
    pub(crate) fn endings(self) -> &'static [&'static str] {
        match self {
            Language::ThreeB => &["3b", "4b"],
            Language::Iso => &["iso", "nc"],
        }
    }

    pub(crate) fn of_id(id: &str) -> Option<Language> {
        Language::ALL
            .into_iter()
            .find(|language| language.id() == id)
    }

    /// The language of files with an ending (lower-case, without its dot).
    pub fn of_ending(ending: &str) -> Option<Language> {
        Language::ALL
            .into_iter()
            .find(|language| language.endings().contains(&ending))
    }
}

/// A program's text, its reading, and its findings.
#[derive(Clone, Debug)]
pub enum Document {
    ThreeB(three_b::Document),
    /// Far larger than the other.
    Iso(Box<iso::Document>),
}

/// What a document answers, whatever its language.
macro_rules! of_language {
    ($document:expr, $own:ident => $answer:expr) => {
        match $document {
            Document::ThreeB($own) => $answer,
            Document::Iso($own) => $answer,
        }
    };
}

impl Document {
    /// Reads program text. Never fails: damage is in [`Document::findings`].
    pub fn read(language: Language, bytes: Vec<u8>, settings: &Effective) -> Document {
        match language {
            Language::ThreeB => Document::ThreeB(three_b::Document::read_with(bytes, settings)),
            Language::Iso => Document::Iso(Box::new(iso::Document::read_with(bytes, settings))),
        }
    }

    pub(crate) fn language(&self) -> Language {
        match self {
            Document::ThreeB(_) => Language::ThreeB,
            Document::Iso(_) => Language::Iso,
        }
    }

    pub fn text(&self) -> &SourceText {
        of_language!(self, document => document.text())
    }

    /// Replaces a range of bytes and rereads what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) {
        of_language!(self, document => document.edit(range, replacement));
    }

    /// Rereads where the settings change the meaning of a text or its faults; costs nothing otherwise.
    pub(crate) fn set_settings(&mut self, settings: &Effective) {
        of_language!(self, document => document.set_settings(settings))
    }

    /// At most `limit` findings under the settings' severities, errors first, then in the order of the text; and how
    /// many there are in all.
    pub fn findings(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        if let Some(finding) = self.is_no_text() {
            return (vec![finding], 1);
        }
        of_language!(self, document => document.told(settings, limit))
    }

    /// The one finding of bytes that are read as none of our texts: each of their lines would be another.
    pub(super) fn is_no_text(&self) -> Option<Finding> {
        let text = self.text();
        let head = text.slice(0..text.len().min(HEAD)).unwrap_or_default();
        let found =
            |sentence: &str| Finding::of(Fault::said(Rule::Syntax, sentence), text.line_range(0));
        // 3B says so itself.
        let is_blank = matches!(self, Document::Iso(_)) && text.len() <= HEAD;
        match head {
            _ if is_utf_16(head) => Some(found(say!(the_text_is_utf_16))),
            _ if is_binary(head) => Some(found(say!(the_file_is_binary_not_a_program))),
            _ if is_blank && head.iter().all(u8::is_ascii_whitespace) => {
                Some(found(say!(no_word_is_found)).with(Severity::Information))
            }
            _ => None,
        }
    }

    /// The edits that give the block whose number has its digits at `digits` another one, written as `name`; calls of
    /// it follow. An error where another block has it.
    pub(crate) fn renamed(
        &self,
        digits: Range<usize>,
        old: u32,
        name: &str,
        new: u32,
    ) -> Result<Vec<TextEdit>, String> {
        of_language!(self, document => document.renamed(digits, old, name, new))
    }

    /// The fixes that the language offers.
    pub(super) fn offered(&self, finding: &Finding, renumbering: Renumbering) -> Vec<TextFix> {
        of_language!(self, document => document.offered(finding, renumbering))
    }

    /// All findings, as the rules see them.
    pub(super) fn all(&self) -> Vec<Finding> {
        of_language!(self, document => document.all())
    }

    /// The lines of the cut around a line.
    pub(super) fn cut_lines(&self, line: usize) -> Range<usize> {
        of_language!(self, document => document.cut_lines(line))
    }

    /// True where coordinates stand after blocks.
    pub(crate) fn states_ends(&self) -> bool {
        matches!(self, Document::ThreeB(document) if document.states_ends())
    }

    /// True for a program for an electrode: no wire cuts it.
    pub(crate) fn mills(&self) -> bool {
        matches!(self, Document::Iso(document) if document.mills())
    }

    pub(super) fn program(&self) -> &dyn Program {
        match self {
            Document::ThreeB(document) => document,
            Document::Iso(document) => &**document,
        }
    }

    fn iso(&self) -> Option<&iso::Document> {
        match self {
            Document::ThreeB(_) => None,
            Document::Iso(document) => Some(document),
        }
    }

    /// The first line that cannot be read: what it does is unknown.
    pub(crate) fn unread_line(&self) -> Option<usize> {
        self.program().unread_line()
    }

    /// The line at which the program is no longer followed, since it calls its subprograms too often.
    pub(crate) fn unfollowed_line(&self) -> Option<usize> {
        self.iso()?.order()?.left_out
    }

    /// The machine's position at a finding.
    pub(crate) fn whereabouts(&self) -> Whereabouts<'_> {
        Whereabouts::within(self.program())
    }

    /// The machine's path, block by block.
    pub fn trace(&self) -> Trace {
        let trace = steps::trace(self.program());
        let Some(taper) = self.iso().and_then(iso::Document::taper) else {
            return trace;
        };
        let unknown = taper.unknown.map(|unknown| match unknown {
            iso::Unknown::Angle(line) => say!(how_far_the_wire_leans_needs_the_angle, line + 1),
            iso::Unknown::Steep(line) => say!(
                the_wire_leans_more_than_any_machine_does,
                line + 1,
                iso::STEEPEST
            ),
            iso::Unknown::Height(_) => say!(how_far_the_wire_leans_needs_the_height).to_owned(),
        });
        Trace {
            upper: taper.upper,
            upper_unknown: unknown,
            ..trace
        }
    }

    /// The cut that touches a byte, its division, and the number of the touching move.
    pub(crate) fn cut_at(&self, offset: usize) -> Option<CutAt> {
        steps::cut_at(self.program(), offset)
    }

    /// The first stop after a byte.
    pub(crate) fn stop_behind(&self, offset: usize) -> Option<Range<usize>> {
        steps::stop_behind(self.program(), offset)
    }

    /// The first block that moves.
    pub(crate) fn first_move(&self) -> Option<Range<usize>> {
        steps::first_move(self.program())
    }

    /// The steps whose text overlaps or touches a range of bytes. Costs the range, not the program.
    pub(crate) fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        steps::steps_in(self.program(), range)
    }
}
