//! Findings as rows: a file, a place in it, a rule, a sentence; each row as text with its excerpt, or as JSON.

use super::excerpt::{Excerpt, excerpt, place};
use super::lisp::Answer;
use super::output::{complain, styled};
use super::{Failure, Verdict, output};
use crate::document::{Document, Source};
use crate::drawing::DrawingEdit;
use crate::dxf::EntityChange;
use crate::finding;
use crate::finding::{Detail, Edit, Finding, Fix, Keep, Place, Rule, Severity};
use crate::job::{self, Refusal};
use crate::message::readable;
use crate::program::Whereabouts;
use crate::protocol::FindingData;
use crate::settings;
use crate::text::SourceText;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};
use std::ops::Range;
use std::path::Path;

/// The most other places shown in the text of one finding: a duplicated outline has many.
const MOST_OTHERS: usize = 5;

/// A place in a file. Lines and columns count from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Span {
    pub(crate) line: usize,
    pub(crate) column: usize,
    pub(crate) end_line: usize,
    pub(crate) end_column: usize,
}

impl Span {
    /// Bytes of a text; without one its beginning.
    fn of(text: Option<&SourceText>, range: &Range<usize>) -> Span {
        let place = |offset: usize| text.map_or((1, 1), |text| place(text, offset));
        let ((line, column), (end_line, end_column)) =
            (place(range.start), place(range.end.max(range.start)));
        Span {
            line,
            column,
            end_line,
            end_column,
        }
    }
}

/// One finding of one file.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Row {
    pub(crate) path: String,
    #[serde(flatten)]
    pub(crate) span: Span,
    #[serde(serialize_with = "rule_name")]
    pub(crate) rule: Rule,
    pub(crate) severity: Severity,
    pub(crate) message: String,
    pub(crate) data: FindingData,
    /// The other places that the finding concerns.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) related: Vec<RelatedRow>,
    /// The reason of a suppression.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) suppressed: Option<String>,
    /// The drawing itself suppresses it, not a `wedm.toml`.
    #[serde(skip)]
    pub(crate) is_marked: bool,
    /// Lines of a `wedm.toml`, each with its effect.
    #[serde(skip)]
    keeps: Vec<(String, String)>,
    #[serde(skip)]
    excerpt: Option<Excerpt>,
    /// mm of the unit of `data`.
    #[serde(skip)]
    unit_mm: f64,
    /// Repairs that may be chosen, where they were asked for: with their effect on the entities.
    #[serde(skip)]
    pub(crate) fixes: Vec<(Fix<()>, Vec<EntityChange>)>,
    /// Of a drawing: its text says nothing to those who draw. The layer and the number of the contour.
    #[serde(skip)]
    drawn: Option<String>,
}

/// Another place of a finding, in the same file.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct RelatedRow {
    #[serde(flatten)]
    pub(crate) span: Span,
    pub(crate) message: String,
}

fn rule_name<S: serde::Serializer>(rule: &Rule, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(rule.name())
}

/// Further findings of one file are counted: those of a drawing with millions of faults would take
/// gigabytes, and nobody would read them.
pub(crate) const MOST: usize = 100_000;

/// At least this many findings are worth another thread.
pub(crate) const SHARE: usize = 256;

/// The findings of a document, errors first; after [`MOST`] of them one that says how many more there are.
pub(crate) fn rows(path: &Path, document: &mut Document) -> Vec<Row> {
    let (findings, _) = job::check(document, MOST);
    rows_of(path, document, &findings)
}

/// The same for given findings.
pub(crate) fn rows_of(path: &Path, document: &Document, findings: &[Finding]) -> Vec<Row> {
    let rows = findings.par_iter().with_min_len(SHARE);
    let whereabouts = || document.whereabouts();
    rows.map_init(whereabouts, |own, finding| {
        row_at(path, document, finding, own)
    })
    .collect()
}

/// The suppressed findings of a document, with the reasons.
pub(crate) fn suppressed(path: &Path, document: &Document) -> Vec<Row> {
    let of_settings = &document.settings().suppressed;
    let told = |(finding, reason): (Finding, String)| {
        let row = row(path, document, &finding);
        let handle = row.data.handle.as_deref();
        let stated = handle.and_then(|handle| of_settings.get(handle));
        Row {
            suppressed: Some(reason),
            is_marked: !stated.is_some_and(|rules| rules.contains_key(&row.rule)),
            ..row
        }
    };
    document.suppressed().into_iter().map(told).collect()
}

/// Findings to stderr.
pub(crate) fn say(path: &Path, document: &Document, findings: &[Finding]) {
    for finding in findings.iter().take(MOST) {
        output::say(&row(path, document, finding).shown());
    }
}

/// The most findings whose repairs are listed: each is tried on the text.
const MOST_WITH_FIXES: usize = 200;

/// Adds the repairs of the first findings of a drawing to their rows, which begin with those of `findings`.
pub(crate) fn add_fixes(rows: &mut [Row], document: &Document, findings: &[Finding]) {
    let Source::Dxf(before) = document.source() else {
        return;
    };
    let may = |edit: &DrawingEdit| before.text_edits(edit).is_ok();
    for (row, finding) in rows.iter_mut().zip(findings).take(MOST_WITH_FIXES) {
        let safe = document.safe_fix(finding, &may).map(|fix| fix.edit);
        for fix in document.fixes(finding) {
            let Edit::Drawing(edit) = &fix.edit else {
                continue;
            };
            let Ok(edits) = before.text_edits(edit) else {
                continue;
            };
            let mut after = before.clone();
            for edit in edits.iter().rev() {
                after.edit(edit.range.clone(), &edit.text);
            }
            // Whether "fix all" makes it is tried there, too.
            let in_fix_all = safe.as_ref() == Some(&fix.edit);
            let fix = Fix {
                in_fix_all,
                ..fix.map(|_| ())
            };
            row.fixes.push((fix, after.changes_since(before)));
        }
    }
}

/// Reports to stderr why there is no result, with the faults; `advice` says what can be done about errors, given their
/// number.
pub(crate) fn refuse(
    path: &Path,
    document: &Document,
    refusal: &Refusal,
    advice: impl Fn(String) -> String,
) -> Result<Verdict, Failure> {
    match refusal {
        Refusal::Cancelled => return Ok(Verdict::Errors),
        Refusal::Fault(sentence) => {
            return Err(Failure::of(path, say!(internal_error, sentence)));
        }
        Refusal::Errors(errors) => {
            say(path, document, errors);
            let errors = say!(errors, errors.len().min(MOST));
            complain(&advice(errors));
        }
        Refusal::Findings(findings) => {
            say(path, document, findings);
            complain(&Failure::of(path, say!(no_program_is_written)).0);
        }
        Refusal::Parts(parts) => {
            let (parts, word) = (job::listed(parts), output::word(path));
            let sentence = say!(parts_of_have_a_program_each, parts, word);
            complain(&Failure::of(path, sentence).0);
        }
        Refusal::Sentence(sentence) | Refusal::Unproved(sentence, _) => {
            complain(&Failure::of(path, sentence).0);
        }
    }
    Ok(Verdict::Errors)
}

/// Why no program is made of a drawing.
pub(crate) fn refuse_programs(
    path: &Path,
    document: &mut Document,
    refusal: &Refusal,
) -> Result<Verdict, Failure> {
    let word = output::word(path);
    let can_be_fixed = document.can_be_fixed(None);
    let advice = |errors| match can_be_fixed {
        true => say!(no_program_of_a_drawing_with, path.display(), errors, word),
        false => say!(
            no_program_of_a_drawing_beyond_repair,
            path.display(),
            errors
        ),
    };
    refuse(path, document, refusal, advice)
}

/// One finding of a document.
pub(crate) fn row(path: &Path, document: &Document, finding: &Finding) -> Row {
    row_at(path, document, finding, &mut document.whereabouts())
}

fn row_at(
    path: &Path,
    document: &Document,
    finding: &Finding,
    whereabouts: &mut Option<Whereabouts<'_>>,
) -> Row {
    let data = FindingData::of(document, finding, whereabouts);
    let range = document.range_of(&finding.place).unwrap_or(0..0);
    let message = finding::sentence(finding, document.telling());
    let mut row = Row::new(
        path,
        document.text(),
        range,
        (finding.rule, finding.severity),
        message,
        data,
    );
    row.unit_mm = document.unit_mm();
    row.drawn = document.drawing().map(|drawing| {
        let entity = finding.place.entity().map(|(entity, _)| entity);
        let layer = entity.and_then(|entity| drawing.get(entity));
        let layer = layer.map(|entity| say!(on_the_layer, readable(&entity.layer)));
        let contour = entity.and_then(|entity| document.contour_number(entity));
        let contour = contour.map(|number| say!(contour_by_number, number));
        let places: Vec<String> = layer.into_iter().chain(contour).collect();
        places.join(say!(comma))
    });
    row.related = finding
        .related
        .iter()
        .filter_map(|place| related(document, finding, place))
        .collect();
    if matches!(finding.detail, Detail::SetAside(_)) {
        let told = |fix: Fix<Vec<Keep>>| {
            let title = fix.kind.title(document.unit_mm());
            (title, settings::as_lines(&fix.edit))
        };
        row.keeps = document.keeps(finding).map(told).collect();
    }
    row
}

fn related(document: &Document, finding: &Finding, other: &Place) -> Option<RelatedRow> {
    let (text, range) = (document.text()?, document.range_of(other)?);
    let (entity, segment) = other.entity()?;
    let handle = &document.drawing()?.get(entity)?.handle;
    let message = finding::related(finding, handle, segment, document.telling());
    Some(RelatedRow {
        span: Span::of(Some(text), &range),
        message,
    })
}

impl Row {
    /// A row whose place is a range of bytes of `text`.
    pub(crate) fn new(
        path: &Path,
        text: Option<&SourceText>,
        range: Range<usize>,
        (rule, severity): (Rule, Severity),
        message: String,
        data: FindingData,
    ) -> Row {
        Row {
            path: path.display().to_string(),
            span: Span::of(text, &range),
            rule,
            severity,
            message,
            data,
            related: Vec::new(),
            suppressed: None,
            is_marked: false,
            keeps: Vec::new(),
            excerpt: text.and_then(|text| excerpt(text, &range)),
            unit_mm: 1.0,
            fixes: Vec::new(),
            drawn: None,
        }
    }

    /// True for a finding of a drawing.
    pub(crate) fn is_drawn(&self) -> bool {
        self.drawn.is_some()
    }

    /// For a person: of a drawing one line, of a text with the lines at fault.
    pub(crate) fn shown(&self) -> String {
        let Some(drawn) = &self.drawn else {
            return self.rendered() + "\n";
        };
        let (style, name) = match self.severity {
            Severity::Error => (output::ERROR, say!(error)),
            Severity::Warning => (output::WARNING, say!(warning)),
            Severity::Information => (output::NOTE, say!(information)),
            Severity::Hint => (output::NOTE, say!(hint)),
        };
        let head = styled(style, format!("{name}[{}]", self.rule.name()));
        let places = [drawn.clone()].into_iter().filter(|it| !it.is_empty());
        // Where the sentence names the place already, the segment there says nothing more.
        let is_named = self
            .point()
            .is_some_and(|point| self.message.contains(&point));
        let whereabouts = self.whereabouts().filter(|_| !is_named);
        let places: Vec<String> = places.chain(whereabouts).collect();
        let said = match places.is_empty() {
            true => self.message.clone(),
            false => say!(with_its_places, self.message, places.join(say!(comma))),
        };
        let suppressed =
            (self.suppressed.iter()).map(|reason| say!(suppressed_since, readable(reason)));
        let said = std::iter::once(said).chain(suppressed);
        let said = said.collect::<Vec<_>>().join(say!(semicolon));
        say!(says, readable(&self.path), say!(says, head, said))
    }

    /// The row for a person: rule, sentence, place, and the lines at fault; with colours, which a stream may strip.
    pub(crate) fn rendered(&self) -> String {
        let level = match self.severity {
            Severity::Error => Level::ERROR.with_name(say!(error)),
            Severity::Warning => Level::WARNING.with_name(say!(warning)),
            Severity::Information => Level::INFO.with_name(say!(information)),
            Severity::Hint => Level::NOTE.with_name(say!(hint)),
        };
        let title = level
            .primary_title(self.message.as_str())
            .id(self.rule.name());
        let renderer = Renderer::styled();
        let path = readable(&self.path);
        match &self.excerpt {
            Some(excerpt) => {
                let snippet = Snippet::source(excerpt.text.as_str())
                    .line_start(excerpt.first_line)
                    .path(path.as_ref())
                    .fold(false)
                    .annotation(
                        AnnotationKind::Primary
                            .span(excerpt.span.clone())
                            .label(self.whereabouts()),
                    );
                let others = self
                    .others(|related| say!(in_line, related.message, related.span.line))
                    .map(|other| Level::NOTE.message(other));
                let keeps = self.keeps.iter().map(|(title, lines)| {
                    let lines = lines.trim_end().replace('\n', "  ");
                    Level::HELP.message(say!(says, readable(title), readable(&lines)))
                });
                let reason = self
                    .suppressed
                    .iter()
                    .map(|reason| Level::NOTE.message(say!(suppressed_since, readable(reason))));
                let group = title.element(snippet).elements(others);
                renderer.render(&[group.elements(keeps).elements(reason)])
            }
            None => {
                let place = annotate_snippets::Origin::path(path.as_ref())
                    .line(self.span.line)
                    .char_column(self.span.column);
                renderer.render(&[title.element(place)])
            }
        }
    }

    /// The other places, the first few as `told` words them, and how many more there are.
    pub(crate) fn others(
        &self,
        told: impl Fn(&RelatedRow) -> String,
    ) -> impl Iterator<Item = String> {
        let more = self.related.len().saturating_sub(MOST_OTHERS);
        let more = (more > 0).then(|| say!(and_more_of_them, more));
        self.related.iter().take(MOST_OTHERS).map(told).chain(more)
    }

    /// The entity, the segment of it, and the start of that or of a program's block, mm.
    pub(crate) fn whereabouts(&self) -> Option<String> {
        let data = &self.data;
        let entity = data.handle.as_deref().map(readable).map(|handle| {
            let of_segment = |segment| say!(segment, handle, segment);
            data.segment.map_or_else(|| handle.to_string(), of_segment)
        });
        let places: Vec<String> = entity.into_iter().chain(self.point()).collect();
        (!places.is_empty()).then(|| places.join(say!(comma)))
    }

    /// For a program: the fields of the JSON object in one level, the place in the drawing's unit, and the repairs.
    pub(crate) fn add_to(&self, answer: &mut Answer) {
        let mut row = serde_json::to_value(self).unwrap_or_default();
        let fields = row.as_object_mut();
        if let Some(fields) = fields {
            let data = fields.remove("data");
            fields.remove("related");
            if let Some(Value::Object(data)) = data {
                fields.extend(data);
            }
            let place = self.data.at.or(self.data.start).or(self.data.center);
            fields.insert(
                "place".into(),
                serde_json::to_value(place).unwrap_or_default(),
            );
        }
        let fix = |(fix, changes): &(Fix<()>, Vec<EntityChange>)| {
            let changes: Vec<String> = changes.iter().map(|one| answer.change(one)).collect();
            let title = fix.kind.title(self.unit_mm);
            let about =
                json!({ "title": title, "safe": fix.in_fix_all, "preferred": fix.preferred });
            let about = answer.fields(&about);
            format!(
                "({}{})",
                about.trim_start(),
                Answer::list("changes", &changes)
            )
        };
        let fixes: Vec<String> = self.fixes.iter().map(fix).collect();
        answer.push_with("finding", &row, &Answer::list("fixes", &fixes));
    }

    /// Where it is, mm.
    fn point(&self) -> Option<String> {
        let (data, unit_mm) = (&self.data, self.unit_mm);
        let point = data.at.or(data.start).or(data.center)?;
        Some(say!(at_point, point.0 * unit_mm, point.1 * unit_mm))
    }
}
