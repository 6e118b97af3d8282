//! The one place where the core's findings, places and edits become the protocol's, and back.

use super::transport::Written;
use crate::document::Document;
use crate::drawing::Entity;
use crate::finding;
use crate::finding::{Finding, Place};
use crate::job;
use crate::protocol::{
    CodeDescription, Diagnostic, FindingData, Location, Position, Range, RelatedInformation,
    severity_number,
};
use crate::settings::SettingsError;
use crate::text::{Encoding, SourceText, TextEdit};
use ls_types as lsp;
use serde::Serialize;

/// The most findings in a publish.
pub(super) const PUBLISH_LIMIT: usize = 500;

/// The findings of one publish as JSON: at most [`PUBLISH_LIMIT`], errors first, then one that counts the others. And how many
/// there are in all.
///
/// With the document's `uri`, for a client that shows them, the other places of a finding are included.
pub(super) fn published(
    document: &mut Document,
    encoding: Encoding,
    uri: Option<&str>,
) -> (Written, usize) {
    let (findings, count) = job::check(document, PUBLISH_LIMIT);
    let told = each(document, findings.iter(), encoding, uri);
    (written(&told), count)
}

pub(super) fn diagnostics(
    document: &Document,
    findings: &[Finding],
    encoding: Encoding,
) -> Vec<Diagnostic> {
    let shown = findings.iter().take(PUBLISH_LIMIT);
    each(document, shown, encoding, None)
}

fn each<'a>(
    document: &Document,
    findings: impl Iterator<Item = &'a Finding>,
    encoding: Encoding,
    uri: Option<&str>,
) -> Vec<Diagnostic> {
    let mut whereabouts = document.whereabouts();
    let shown = |finding: &Finding| {
        let data = FindingData::of(document, finding, &mut whereabouts);
        diagnostic(document, finding, data, encoding, uri)
    };
    findings.map(shown).collect()
}

/// A finding of `document` as the client is shown it.
pub(super) fn diagnostic(
    document: &Document,
    finding: &Finding,
    data: FindingData,
    encoding: Encoding,
    uri: Option<&str>,
) -> Diagnostic {
    let related = uri
        .map(|uri| related_information(document, finding, encoding, uri))
        .filter(|related| !related.is_empty());
    Diagnostic {
        related_information: related,
        ..diagnostic_at(document, finding, data, encoding)
    }
}

/// The range of a place; in a drawing the line is the index of the segment within its entity.
fn range_at(document: &Document, place: &Place, encoding: Encoding) -> Range {
    match (document.text(), document.range_of(place), place) {
        (_, _, Place::Document) => Range::default(),
        (Some(text), Some(bytes), _) => range_of(text, bytes, encoding),
        (_, _, Place::Segment { segment, .. }) => Range::of_segment(*segment),
        _ => Range::default(),
    }
}

/// The entity of a place in a drawing, and the segment.
fn entity_of<'a>(document: &'a Document, place: &Place) -> Option<(&'a Entity, Option<usize>)> {
    let (entity, segment) = place.entity()?;
    Some((document.drawing()?.get(entity)?, segment))
}

/// The other places of a finding.
fn related_information(
    document: &Document,
    finding: &Finding,
    encoding: Encoding,
    uri: &str,
) -> Vec<RelatedInformation> {
    let related = |place: &Place| {
        let (entity, segment) = entity_of(document, place)?;
        Some(RelatedInformation {
            location: Location {
                uri: uri.into(),
                range: range_at(document, place, encoding),
            },
            message: finding::related(finding, &entity.handle, segment, document.telling()),
        })
    };
    finding.related.iter().filter_map(related).collect()
}

/// A finding at its place, without the other places.
fn diagnostic_at(
    document: &Document,
    finding: &Finding,
    data: FindingData,
    encoding: Encoding,
) -> Diagnostic {
    Diagnostic {
        range: range_at(document, &finding.place, encoding),
        severity: severity_number(finding.severity),
        code: finding.rule.name().into(),
        code_description: document
            .settings()
            .page_of(finding.rule)
            .map(|href| CodeDescription { href }),
        source: "wedm".into(),
        message: finding::sentence(finding, document.telling()),
        related_information: None,
        data: (!data.is_empty()).then_some(data),
    }
}

/// The faults in a `wedm.toml`.
pub(super) fn settings_diagnostics(
    text: &SourceText,
    errors: &[SettingsError],
    encoding: Encoding,
) -> Vec<Diagnostic> {
    let diagnostic = |error: &SettingsError| Diagnostic {
        range: error
            .range
            .clone()
            .map_or_else(Range::default, |bytes| range_of(text, bytes, encoding)),
        severity: severity_number(error.severity),
        code: error.rule.name().into(),
        code_description: None,
        source: "wedm".into(),
        message: error.message.clone(),
        related_information: None,
        data: None,
    };
    errors.iter().take(PUBLISH_LIMIT).map(diagnostic).collect()
}

/// Diagnostics, or one, as JSON text.
pub(super) fn written(told: &(impl Serialize + ?Sized)) -> Written {
    Written::of(&told).unwrap_or_else(|error| {
        tracing::error!("findings cannot be written: {error}");
        Written::default()
    })
}

pub(super) fn range_of(
    text: &SourceText,
    bytes: std::ops::Range<usize>,
    encoding: Encoding,
) -> Range {
    let position = |offset: usize| {
        let (line, character) = text.position_of(offset, encoding);
        Position {
            line: line.try_into().unwrap_or(u32::MAX),
            character: character.try_into().unwrap_or(u32::MAX),
        }
    };
    Range {
        start: position(bytes.start),
        end: position(bytes.end),
    }
}

/// Bytes of a client's range, clamped to the text; an end before the start is the start.
pub(super) fn bytes_of(
    text: &SourceText,
    range: lsp::Range,
    encoding: Encoding,
) -> std::ops::Range<usize> {
    let offset = |position: lsp::Position| {
        text.offset_of(
            position.line as usize,
            position.character as usize,
            encoding,
        )
    };
    let start = offset(range.start);
    start..offset(range.end).max(start)
}

pub(super) fn lsp_range(range: Range) -> lsp::Range {
    let position = |position: Position| lsp::Position {
        line: position.line,
        character: position.character,
    };
    lsp::Range {
        start: position(range.start),
        end: position(range.end),
    }
}

pub(super) fn lsp_edits(
    text: &SourceText,
    edits: Vec<TextEdit>,
    encoding: Encoding,
) -> Vec<lsp::TextEdit> {
    let edit = |edit: TextEdit| lsp::TextEdit {
        range: lsp_range(range_of(text, edit.range, encoding)),
        new_text: edit.text,
    };
    edits.into_iter().map(edit).collect()
}

/// The diagnostic in the framework's types, for a code action.
pub(super) fn lsp_diagnostic(diagnostic: &Diagnostic) -> Option<lsp::Diagnostic> {
    serde_json::from_value(serde_json::to_value(diagnostic).ok()?).ok()
}
