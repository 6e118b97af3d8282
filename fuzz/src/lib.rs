//! What several fuzz targets share: an input cut in two, edits made of bytes, and a document put into words. A file for
//! each target; `tests/fuzz_seeds.rs` of the package above runs them, too, over the seeds.

pub mod dxf_lexer;
pub mod dxf_reader;
pub mod incremental_equals_fresh;
pub mod iso_reader;
pub mod sequence;
pub mod server_frames;
pub mod server_messages;
pub mod three_b_controller;
pub mod three_b_reader;

use std::ops::Range;
use wedm::document::Document;
use wedm::drawing::{Drawing, EntityId};
use wedm::finding::{Finding, Place};
use wedm::program::{Document as Program, Language};
use wedm::settings::Effective;

/// An input of two parts: a text, and after the first byte 0 what is done with it. A text without such a byte stands alone, so
/// that a plain file is an input, too.
pub fn text_and_script(data: &[u8]) -> (&[u8], &[u8]) {
    match data.iter().position(|&byte| byte == 0) {
        Some(at) => (&data[..at], &data[at + 1..]),
        None => (data, &[]),
    }
}

/// Bytes taken one after another; 0 when none is left.
pub struct Script<'a>(pub &'a [u8]);

impl Script<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> usize {
        let Some((&first, rest)) = self.0.split_first() else {
            return 0;
        };
        self.0 = rest;
        usize::from(first)
    }

    /// A place within `0..=length`.
    pub fn place(&mut self, length: usize) -> usize {
        let share = self.byte() << 8 | self.byte();
        share * (length + 1) / 0x1_0000
    }

    /// The next `count` bytes as text; what is no UTF-8 is replaced.
    pub fn text(&mut self, count: usize) -> String {
        let (text, rest) = self.0.split_at(count.min(self.0.len()));
        self.0 = rest;
        String::from_utf8_lossy(text).into_owned()
    }
}

/// A replacement of a few bytes of a text: what is typed is one of `phrases`, or what the script spells out.
pub fn edit_of(script: &mut Script, length: usize, phrases: &[&str]) -> (Range<usize>, String) {
    let start = script.place(length);
    let kind = script.byte();
    let removed = match kind % 4 {
        0 => 0,
        1 => 1,
        2 => 3,
        _ => script.byte() % 64,
    };
    let typed = match kind / 4 % 3 {
        0 => script.text(1),
        1 => String::new(),
        _ => phrases
            .get(script.byte() % phrases.len().max(1))
            .copied()
            .unwrap_or_default()
            .to_owned(),
    };
    (start..(start + removed).min(length), typed)
}

/// What is edited, as the first bytes of a program themselves say: from where, how much, and what comes in its place.
fn edit_of_program(data: &[u8]) -> (Range<usize>, String) {
    let number = |at: usize| data.get(at).copied().map_or(0, usize::from);
    let start = (number(0) * 256 + number(1)) % (data.len() + 1);
    let replacement =
        String::from_utf8_lossy(data.get(..number(2) % 8).unwrap_or_default()).into_owned();
    (start..start + number(3) % 64, replacement)
}

/// Bytes as a program: reading, findings, fixes and the trace end whatever they are, and a document that was edited is the one
/// read from scratch. Both are handed back.
pub fn check_program(language: Language, data: &[u8]) -> [Program; 2] {
    let settings = Effective::default();
    let mut edited = Program::read(language, data.to_vec(), &settings);
    check_places(&edited);
    let (range, replacement) = edit_of_program(data);
    edited.edit(range, &replacement);
    check_places(&edited);
    let fresh = Program::read(language, edited.text().bytes().to_vec(), &settings);
    assert_eq!(
        findings_of(&edited),
        findings_of(&fresh),
        "findings of an edited document"
    );
    assert_eq!(edited.trace(), fresh.trace(), "trace of an edited document");
    [edited, fresh]
}

fn findings_of(program: &Program) -> Vec<Finding> {
    program.findings(&Effective::default(), usize::MAX).0
}

/// Everything that is said of a program has its place in the text, and edits of a fix are sorted and disjoint.
fn check_places(program: &Program) {
    let length = program.text().len();
    for finding in findings_of(program).iter().take(64) {
        let Place::Text { range } = &finding.place else {
            panic!("{finding:?} has no place")
        };
        assert!(
            range.start <= range.end && range.end <= length,
            "{finding:?} in {length} bytes"
        );
        for fix in program.fixes(finding) {
            let mut from = 0;
            for edit in &fix.edit {
                assert!(
                    from <= edit.range.start
                        && edit.range.start <= edit.range.end
                        && edit.range.end <= length,
                    "{fix:?}"
                );
                from = edit.range.end;
            }
        }
    }
    for step in &program.trace().steps {
        assert!(
            step.range.end <= length && step.line < program.text().line_count(),
            "{step:?}"
        );
        assert!(step.end.x.is_finite() && step.end.y.is_finite(), "{step:?}");
    }
}

/// Everything that can be asked of an open document, the ids of entities replaced by their places in the machining order: two
/// documents that say the same here are the same to everybody.
pub fn described(document: &Document) -> Vec<String> {
    let mut all = Vec::new();
    let Some(drawing) = document.drawing() else {
        all.extend(
            document
                .all_findings()
                .iter()
                .map(|finding| format!("{finding:?}")),
        );
        return all;
    };
    all.push(format!("{:?}", drawing.unit));
    for (order, (id, entity)) in drawing.entities().enumerate() {
        let editable = drawing.is_editable(id);
        let look = (drawing.visibility(id), drawing.color(id));
        all.push(format!(
            "{order} {entity:?} {look:?} editable {editable} at {:?}",
            document.range_of(&Place::Entity { entity: id })
        ));
        for segment in 0..entity.geometry.segment_count() {
            all.push(format!(
                "  {segment} at {:?}",
                document.range_of(&Place::Segment {
                    entity: id,
                    segment
                })
            ));
        }
    }
    if let Some(snapshot) = document.snapshot() {
        for outline in snapshot.outlines.iter() {
            let pieces: Vec<String> = outline
                .contour
                .segments(drawing)
                .map(|piece| in_order(drawing, piece.entity, piece.segment))
                .collect();
            all.push(format!(
                "contour {:?} closed {} {pieces:?}",
                outline.role, outline.contour.closed
            ));
        }
    }
    all.extend(
        document
            .all_findings()
            .iter()
            .map(|finding| finding_in_words(drawing, finding)),
    );
    all
}

fn in_order(drawing: &Drawing, entity: EntityId, segment: usize) -> String {
    format!(
        "{:?}/{segment}",
        drawing.order().iter().position(|&other| other == entity)
    )
}

fn finding_in_words(drawing: &Drawing, finding: &Finding) -> String {
    let place = |place: &Place| match *place {
        Place::Segment { entity, segment } => in_order(drawing, entity, segment),
        Place::Entity { entity } => in_order(drawing, entity, usize::MAX),
        ref other => format!("{other:?}"),
    };
    let related: Vec<String> = finding.related.iter().map(place).collect();
    format!(
        "{:?} {:?} {} {related:?} {:?}",
        finding.rule,
        finding.severity,
        place(&finding.place),
        finding.detail
    )
}

/// Number of segments of a drawing: what work on it is bounded by.
pub fn segment_count(drawing: &Drawing) -> usize {
    drawing
        .entities()
        .map(|(_, entity)| entity.geometry.segment_count())
        .sum()
}
