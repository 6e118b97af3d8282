//! A document as the server and the command line hold it: its source, its drawing, its findings.
//!
//! The differences between DXF text, drawings sent by a CAD program and programs end here: nothing
//! above knows them.

mod compared;
mod file_kind;
mod rounds;

pub(crate) use file_kind::FileKind;

use crate::analysis::Analysis;
use crate::compare::{Beside, Drawn, Traced};
use crate::drawing::{Delta, Drawing, DrawingEdit, EntityId, Outline, Role};
use crate::dxf;
use crate::finding::{self, Detail, Edit, Finding, Fix, FixKind, Keep, Place, Rule, Telling};
use crate::fit::Laid;
use crate::program;
use crate::settings::{self, Effective};
use crate::text::{Again, SourceText};
use rustc_hash::FxHashMap;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The source of a document's drawing.
#[derive(Clone, Debug)]
pub enum Source {
    Dxf(dxf::Document),
    /// Sent by a CAD program; there is no text behind it.
    Cad(Arc<Drawing>),
    /// A program, in any language.
    Program(program::Document),
}

/// An open document.
#[derive(Clone, Debug)]
pub struct Document {
    source: Source,
    analysis: Analysis,
    /// The drawing of a program, or the programs of a drawing.
    beside: Beside,
    asked: Asked,
}

/// Answers for the present state of the document: an editor asks for actions at every step of the cursor.
#[derive(Clone, Debug, Default)]
struct Asked {
    taken: Taken,
    /// Those that concern the document beside it.
    beside: OnceLock<Arc<[Finding]>>,
    findings: OnceLock<Arc<[Finding]>>,
    fix_all: OnceLock<Option<Edit>>,
    /// The number of each entity's contour.
    numbers: OnceLock<FxHashMap<EntityId, usize>>,
}

/// The data for comparing the document with others, whatever lies beside it.
#[derive(Clone, Debug, Default)]
struct Taken {
    drawn: OnceLock<Arc<Drawn>>,
    traced: OnceLock<Arc<Traced>>,
}

/// The snapshot that long work reads while the document goes on changing.
#[derive(Clone, Debug)]
pub struct Snapshot {
    pub drawing: Arc<Drawing>,
    pub outlines: Arc<Vec<Outline>>,
    pub settings: Arc<Effective>,
}

impl Document {
    pub fn new(source: Source, settings: Arc<Effective>) -> Document {
        Document::without_text(source, settings, None)
    }

    /// The same for a document that is only checked: where its text can be read `again`, it is not kept.
    pub(crate) fn without_text(
        mut source: Source,
        settings: Arc<Effective>,
        again: Option<Again>,
    ) -> Document {
        if let Source::Program(program) = &mut source {
            program.set_settings(&settings);
        }
        if let Source::Dxf(text) = &mut source {
            text.set_arc_fit(settings.tolerances.arc_fit);
            if let Some(again) = again {
                text.set_text_aside(again);
            }
        }
        assume_unit(&mut source, &settings);
        let analysis = judged(&source, settings);
        Document {
            source,
            analysis,
            beside: Beside::default(),
            asked: Asked::default(),
        }
    }

    pub fn source(&self) -> &Source {
        &self.source
    }

    pub fn settings(&self) -> &Arc<Effective> {
        self.analysis.settings()
    }

    /// Checks everything again under other settings.
    pub(crate) fn set_settings(&mut self, settings: Arc<Effective>) {
        if *self.analysis.settings() != settings {
            self.asked = Asked::default();
            if let Source::Dxf(text) = &mut self.source {
                text.set_arc_fit(settings.tolerances.arc_fit);
            }
            if let Source::Program(program) = &mut self.source {
                program.set_settings(&settings);
            }
            assume_unit(&mut self.source, &settings);
            self.analysis = judged(&self.source, settings);
        }
    }

    /// The text, where there is one.
    pub fn text(&self) -> Option<&SourceText> {
        match &self.source {
            Source::Dxf(document) => Some(document.text()),
            Source::Program(program) => Some(program.text()),
            Source::Cad(_) => None,
        }
    }

    /// The drawing, if any: a program has none.
    pub fn drawing(&self) -> Option<&Arc<Drawing>> {
        match &self.source {
            Source::Dxf(document) => Some(document.drawing()),
            Source::Cad(drawing) => Some(drawing),
            Source::Program(_) => None,
        }
    }

    /// The unit of the findings' lengths in mm: the drawing's unit, or 1 for a program, whose
    /// findings are in mm.
    pub(crate) fn unit_mm(&self) -> f64 {
        self.drawing()
            .map_or(1.0, |drawing| self.settings().unit_of(drawing).mm)
    }

    /// How its findings are worded: the unit, and whether an electrode cuts.
    pub(crate) fn telling(&self) -> Telling {
        Telling {
            unit_mm: self.unit_mm(),
            mills: self.drawing().is_some() && self.settings().mills,
        }
    }

    /// The program, where the document is one.
    pub fn program(&self) -> Option<&program::Document> {
        match &self.source {
            Source::Program(program) => Some(program),
            Source::Dxf(_) | Source::Cad(_) => None,
        }
    }

    /// The machine's position at each finding of a program.
    pub(crate) fn whereabouts(&self) -> Option<program::Whereabouts<'_>> {
        self.program().map(program::Document::whereabouts)
    }

    /// Whether an entity of the drawing is a part of a contour that is cut.
    pub(crate) fn cuts(&self, id: EntityId) -> bool {
        self.analysis.cuts(id)
    }

    /// The snapshot for long work; `None` for a program.
    pub fn snapshot(&self) -> Option<Snapshot> {
        let drawing = self.drawing()?.clone();
        let outlines = self.analysis.outlines(&drawing).clone();
        Some(Snapshot {
            drawing,
            outlines,
            settings: self.settings().clone(),
        })
    }

    /// Makes ready what the first edit of a drawing needs.
    pub(crate) fn make_ready(&mut self) {
        self.analysis.make_ready();
    }

    /// All pairs of a drawing, each laid in the other, where that is known already.
    pub(crate) fn laid(&self) -> Option<Laid> {
        self.analysis.laid(self.drawing()?)
    }

    /// Replaces a range of bytes of the text. Does nothing for a drawing without text.
    pub fn edit_text(&mut self, range: Range<usize>, replacement: &str) {
        self.asked = Asked::default();
        match &mut self.source {
            Source::Dxf(document) => {
                let delta = document.edit(range, replacement);
                self.analysis.update(document.drawing(), &delta);
            }
            Source::Program(program) => {
                program.edit(range, replacement);
            }
            Source::Cad(_) => {}
        }
    }

    /// Lets `change` edit a drawing that a CAD program sent, and checks the parts that it touched.
    ///
    /// When `change` fails, the drawing is as before. `None` for a document with text.
    pub fn edit_drawing<E>(
        &mut self,
        change: impl FnOnce(&mut Drawing) -> Result<Delta, E>,
    ) -> Option<Result<(), E>> {
        let Source::Cad(drawing) = &mut self.source else {
            return None;
        };
        self.asked = Asked::default();
        Some(change(Arc::make_mut(drawing)).map(|delta| self.analysis.update(drawing, &delta)))
    }

    /// At most `limit` findings of reader and rules, errors first; and how many there are in all.
    pub fn findings(&mut self, limit: usize) -> (Vec<Finding>, usize) {
        let unlike = self.unlike();
        findings(&self.source, &mut self.analysis, &unlike, limit)
    }

    /// The suppressed findings of a drawing, each with its reason.
    pub(crate) fn suppressed(&self) -> Vec<(Finding, String)> {
        let of_drawing = |drawing: &Arc<Drawing>| self.analysis.suppressed(drawing);
        self.drawing().map_or_else(Vec::new, of_drawing)
    }

    /// All findings, for callers that share the document and cannot store answers in it.
    pub fn all_findings(&self) -> Arc<[Finding]> {
        self.asked
            .findings
            .get_or_init(|| {
                let mut analysis = self.analysis.clone();
                findings(&self.source, &mut analysis, &self.unlike(), usize::MAX)
                    .0
                    .into()
            })
            .clone()
    }

    /// The fixes of one finding, the preferred one first.
    pub fn fixes(&self, finding: &Finding) -> Vec<Fix<Edit>> {
        match &self.source {
            Source::Dxf(_) | Source::Cad(_) => {
                let of_drawing = |drawing| self.analysis.fixes(drawing, finding);
                self.drawing()
                    .map_or_else(Vec::new, |drawing| of_drawing(drawing))
                    .into_iter()
                    .map(|fix| fix.map(Edit::Drawing))
                    .chain(self.keeps(finding).map(|fix| fix.map(Edit::Settings)))
                    .collect()
            }
            Source::Program(program) => program
                .fixes(finding)
                .into_iter()
                .map(|fix| fix.map(Edit::Text))
                .collect(),
        }
    }

    /// The findings at a segment of a drawing that another one may stand for, each by itself, with its repairs.
    pub(crate) fn each_at(&self, at: (EntityId, usize)) -> Vec<Finding> {
        self.drawing()
            .map_or_else(Vec::new, |drawing| self.analysis.each_at(drawing, at))
    }

    /// The number of the contour that an entity belongs to, from 1 in machining order.
    pub(crate) fn contour_number(&self, entity: EntityId) -> Option<usize> {
        let numbers = self.asked.numbers.get_or_init(|| {
            let outlines = self
                .drawing()
                .map(|drawing| self.analysis.outlines(drawing));
            let numbered = outlines.into_iter().flat_map(|all| (1..).zip(all.iter()));
            let pieces = numbered.flat_map(|(number, outline)| {
                let pieces = outline.contour.pieces.iter();
                pieces.map(move |piece| (piece.entity, number))
            });
            let mut numbers = FxHashMap::default();
            // A common line has its edge from a part that is in the contour before it.
            pieces.for_each(|(entity, number)| {
                numbers.entry(entity).or_insert(number);
            });
            numbers
        });
        numbers.get(&entity).copied()
    }

    /// The repairs of a finding in a drawing that consist of settings.
    pub(crate) fn keeps(&self, finding: &Finding) -> impl Iterator<Item = Fix<Vec<Keep>>> {
        let role = self.settings().side.role().unwrap_or(Role::Both);
        let keeps = match &finding.detail {
            Detail::SetAside(parts) => parts.iter().flat_map(|part| part.keeps(role)).collect(),
            Detail::OpenContour { .. } => {
                self.spare_layer(finding).map_or_else(Vec::new, |layer| {
                    let (kind, keeps) = finding::ignored(&layer);
                    vec![Fix::keeping(kind, keeps)]
                })
            }
            _ => Vec::new(),
        };
        keeps.into_iter().chain(self.suppression(finding))
    }

    /// The repair that suppresses a finding at an entity of a file; the user still writes the reason.
    fn suppression(&self, finding: &Finding) -> Option<Fix<Vec<Keep>>> {
        let (entity, _) = finding.place.entity()?;
        if matches!(finding.detail, Detail::SetAside(_)) {
            return None;
        }
        let name = self.settings().document.as_ref()?;
        let handle = &self.drawing()?.get(entity)?.handle;
        let table = settings::table_of_suppressions(name, handle);
        let rule = finding.rule;
        Some(Fix::keeping(
            FixKind::Suppress { rule },
            vec![Keep::new(&table, rule.name(), "")],
        ))
    }

    /// The layer of a finding's contour, unless it also holds a closed contour.
    fn spare_layer(&self, finding: &Finding) -> Option<Arc<str>> {
        let drawing = self.drawing()?;
        let Place::Segment { entity, .. } = finding.place else {
            return None;
        };
        let layer = &drawing.get(entity)?.layer;
        let lies_there = |id: EntityId| drawing.get(id).is_some_and(|it| it.layer == *layer);
        let outlines = self.analysis.outlines(drawing);
        let closed = outlines.iter().filter(|outline| outline.contour.closed);
        (!closed
            .flat_map(|outline| &outline.contour.pieces)
            .any(|piece| lies_there(piece.entity)))
        .then(|| layer.clone())
    }

    /// One edit that makes every safe fix that the document can take.
    pub fn fix_all(&self) -> Option<Edit> {
        let edit = || match &self.source {
            Source::Dxf(text) => {
                let can = |edit: &DrawingEdit| text.text_edits(edit).is_ok();
                let all = self.analysis.fix_all(text.drawing())?;
                // A fix that the text refuses does not block the others.
                let edit = if can(&all) {
                    Some(all)
                } else {
                    self.analysis.fix_all_that(text.drawing(), &can).filter(can)
                };
                edit.map(Edit::Drawing)
            }
            Source::Cad(drawing) => self.analysis.fix_all(drawing).map(Edit::Drawing),
            Source::Program(program) => program.fix_all(self.settings()).map(Edit::Text),
        };
        self.asked.fix_all.get_or_init(edit).clone()
    }

    /// Whether [`Document::fix_all`] would change anything, without working it out completely. `found` are all
    /// findings, if the caller has them.
    pub(crate) fn can_be_fixed(&mut self, found: Option<&[Finding]>) -> bool {
        let settings = &self.settings().clone();
        match &self.source {
            Source::Dxf(text) => {
                let can = |edit: &DrawingEdit| text.text_edits(edit).is_ok();
                self.analysis.has_fix_that(text.drawing(), found, &can)
            }
            Source::Cad(drawing) => self.analysis.has_fix_that(drawing, found, &|_| true),
            Source::Program(program) => match found {
                Some(found) => program.can_be_fixed(found),
                None => {
                    let found = program.findings(settings, usize::MAX).0;
                    program.can_be_fixed(&found)
                }
            },
        }
    }

    /// A document of the same kind under the same settings with other bytes, such as a repair makes. Not for a drawing
    /// without text.
    pub(crate) fn reread(&self, bytes: Vec<u8>) -> Document {
        let settings = self.settings().clone();
        let source = match &self.source {
            Source::Program(program) => {
                let language = program.language();
                Source::Program(program::Document::read(language, bytes, &settings))
            }
            Source::Dxf(_) | Source::Cad(_) => Source::Dxf(dxf::Document::read(bytes)),
        };
        Document::new(source, settings)
    }

    /// The bytes of a place; `None` where there is no text.
    pub fn range_of(&self, place: &Place) -> Option<Range<usize>> {
        match (&self.source, place) {
            (_, Place::Text { range }) => Some(range.clone()),
            (Source::Dxf(document), place) => Some(document.range_of(place)),
            (Source::Program(_), _) => Some(0..0),
            (Source::Cad(_), _) => None,
        }
    }

    /// Segments whose text overlaps a range of bytes; empty where there is no text.
    pub(crate) fn segments_at(&self, range: Range<usize>) -> Vec<(EntityId, usize)> {
        match &self.source {
            Source::Dxf(document) => document.segments_at(range),
            _ => Vec::new(),
        }
    }
}

fn findings(
    source: &Source,
    analysis: &mut Analysis,
    unlike: &[Finding],
    limit: usize,
) -> (Vec<Finding>, usize) {
    let (of_source, of_rules) = match source {
        Source::Dxf(document) => (
            Cow::Borrowed(document.findings()),
            analysis.findings(document.drawing(), limit),
        ),
        Source::Cad(drawing) => (
            drawing.unseen().into_iter().map(Finding::from).collect(),
            analysis.findings(drawing, limit),
        ),
        Source::Program(program) => (Cow::default(), program.findings(analysis.settings(), limit)),
    };
    let settings = analysis.settings();
    let (mut findings, mut count) = of_rules;
    findings.extend_from_slice(unlike);
    count += unlike.len();
    for finding in of_source.iter() {
        // The reader knows no settings, so its findings get their severities here. A layer with a role is cut or not as
        // the role says. Where the settings give the unit, the drawing need not.
        let is_answered = match &finding.detail {
            Detail::Unseen { layer, .. } => settings.layers.contains(layer),
            Detail::Said(_) if finding.rule == Rule::Units => settings.states_unit,
            _ => false,
        };
        if let Some(severity) = settings.severity_of(finding).filter(|_| !is_answered) {
            findings.push(Finding {
                severity,
                ..finding.clone()
            });
            count += 1;
        }
    }
    findings.sort_by_key(|finding| finding.severity);
    findings.truncate(limit);
    (findings, count)
}

/// Gives a drawing that states no unit the one of the settings.
fn assume_unit(source: &mut Source, settings: &Effective) {
    match source {
        Source::Dxf(text) => text.assume_unit(settings.unit),
        Source::Cad(drawing) if drawing.assumes_another(settings.unit) => {
            Arc::make_mut(drawing).assume_unit(settings.unit)
        }
        Source::Cad(_) | Source::Program(_) => {}
    }
}

fn judged(source: &Source, settings: Arc<Effective>) -> Analysis {
    match source {
        Source::Dxf(text) => Analysis::new(text.drawing(), settings),
        Source::Cad(drawing) => Analysis::new(drawing, settings),
        Source::Program(_) => Analysis::new(&Drawing::default(), settings),
    }
}

#[cfg(test)]
mod tests;
