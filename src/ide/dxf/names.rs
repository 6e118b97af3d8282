//! Names: handles, layers, blocks, linetypes, text styles; where each is defined and where it is used.

use super::codes::{Value, value_of};
use super::outline::walk;
use super::spot::{section_of, spot, text_of};
use crate::dxf::Document;
use crate::dxf::lexer::Tag;
use crate::dxf::lines::Lines;
use crate::ide::{Occurrence, Role, Stop};
use crate::text::SourceText;
use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Names {
    Record,
    Layer,
    Block,
    Linetype,
    Style,
}

/// Something that one tag names and others refer to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Name {
    pub(crate) names: Names,
    /// As it stands in the text; compared without regard to case, handles also without regard to leading zeros.
    pub(crate) text: String,
}

/// The name at a byte, on either line of a tag; and the bytes of the value.
pub(crate) fn name_at(document: &Document, offset: usize) -> Option<(Name, Range<usize>)> {
    let spot = spot(document, document.text().line_of(offset))?;
    let tag = spot.tag?;
    let in_header = spot.name == b"SECTION"
        && section_of(document, spot.item).is_some_and(|(name, _)| name == "HEADER");
    let (names, _) = named_by(spot.name, in_header, tag.code)?;
    let value = spot.lines.trimmed(tag.value_line());
    let is_name = !value.is_empty()
        && (names != Names::Record || value.iter().all(u8::is_ascii_hexdigit) && value != b"0");
    is_name.then(|| {
        (
            Name {
                names,
                text: text_of(value),
            },
            spot.lines.trimmed_range(tag.value_line()),
        )
    })
}

/// Every place that defines or uses a name, in the order of the text, at most `limit`; `None` when it was stopped.
pub(crate) fn occurrences(
    text: &SourceText,
    name: &Name,
    limit: usize,
    stop: Stop<'_>,
) -> Option<Vec<Occurrence>> {
    let lines = Lines::new(text);
    let wanted = key(name.names, name.text.as_bytes());
    let mut found = Vec::new();
    let mut record: &[u8] = b"";
    let mut in_header = false;
    let mut in_group = false;
    let whole = walk(lines, stop, |tag: Tag| {
        if tag.code == 0 {
            record = lines.trimmed(tag.value_line());
            in_group = false;
            in_header = record == b"SECTION";
            return;
        }
        in_group = if tag.code == 102 {
            lines.trimmed(tag.value_line()).starts_with(b"{")
        } else {
            in_group
        };
        let Some((names, defines)) =
            named_by(record, in_header, tag.code).filter(|(names, _)| *names == name.names)
        else {
            return;
        };
        let value = lines.trimmed(tag.value_line());
        if found.len() < limit && key(names, value).eq_ignore_ascii_case(wanted) {
            found.push(Occurrence {
                range: lines.trimmed_range(tag.value_line()),
                role: if defines && !in_group {
                    Role::Defines
                } else {
                    Role::Uses
                },
            });
        }
    });
    whole.then_some(found)
}

/// The form for comparing: a handle without its leading zeros.
fn key(names: Names, value: &[u8]) -> &[u8] {
    let zeros = if names == Names::Record {
        value.iter().take_while(|&&digit| digit == b'0').count()
    } else {
        0
    };
    &value[zeros..]
}

/// The kind of name that a code of a record holds, and whether it defines it.
fn named_by(record: &[u8], in_header: bool, code: i16) -> Option<(Names, bool)> {
    if in_header {
        // Header variables use the codes of what they name.
        return match code {
            8 => Some((Names::Layer, false)),
            6 => Some((Names::Linetype, false)),
            7 => Some((Names::Style, false)),
            _ => None,
        };
    }
    match (record, code) {
        (b"LAYER", 2) => Some((Names::Layer, true)),
        (b"LTYPE", 2) => Some((Names::Linetype, true)),
        (b"STYLE", 2) => Some((Names::Style, true)),
        (b"BLOCK", 2) => Some((Names::Block, true)),
        (b"INSERT" | b"BLOCK_RECORD" | b"DIMENSION", 2) => Some((Names::Block, false)),
        // Names of arrow heads, not handles.
        (b"DIMSTYLE", 5..=7) => None,
        (b"LTYPE", 340) => Some((Names::Record, false)),
        (_, 5 | 105) => Some((Names::Record, true)),
        (_, 8 | 1003) => Some((Names::Layer, false)),
        (_, 6) => Some((Names::Linetype, false)),
        (b"TEXT" | b"MTEXT" | b"ATTRIB" | b"ATTDEF", 7) => Some((Names::Style, false)),
        (_, 320..=369 | 390..=399 | 480..=481 | 1005) => {
            (value_of(code) == Value::Handle).then_some((Names::Record, false))
        }
        _ => None,
    }
}
