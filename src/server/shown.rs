//! The findings that a client is shown, kept as JSON: an unchanged finding is copied, its range moved with its lines, and
//! only new or changed ones are rendered.

use super::convert::{PUBLISH_LIMIT, diagnostic, ranges_of, written};
use super::transport::Written;
use crate::document::{Document, Since};
use crate::finding::{Finding, Place};
use crate::job;
use crate::protocol::{FindingData, Range};
use crate::settings::Effective;
use crate::text::Encoding;
use memchr::memmem::Finder;
use rustc_hash::FxHasher;
use std::cell::OnceCell;
use std::hash::{Hash, Hasher};
use std::io::Write as _;
use std::sync::Arc;

/// The findings of one publish: at most [`PUBLISH_LIMIT`], errors first, then one that counts the others. And how many
/// there are in all.
///
/// With the document's `uri`, for a client that shows them, the other places of a finding are included.
pub(super) fn publish_of(
    document: &mut Document,
    encoding: Encoding,
    uri: Option<&str>,
    shown: &mut Shown,
) -> (Written, usize) {
    let (findings, count) = job::check(document, PUBLISH_LIMIT);
    shown.follow(&document.take_changes());
    let told = shown.render(document, findings, encoding, uri);
    (told, count)
}

/// The findings of the last publish.
#[derive(Default)]
pub(super) struct Shown {
    /// The conditions under which they were made: the settings, and mm of the drawing's unit.
    under: Option<(Arc<Effective>, f64)>,
    /// The mark of each kept finding, by which it is searched for.
    marks: Vec<u64>,
    /// First those of the last publish, then the most recently removed ones: often one keystroke
    /// removes a finding and the next brings it back.
    kept: Vec<Option<Box<Kept>>>,
    /// The number of findings of the last publish, and of their bytes.
    count: usize,
    length: usize,
}

/// A finding as it was rendered.
struct Kept {
    /// The source of the text, except the ranges.
    finding: Finding,
    data: FindingData,
    /// As it is shown, and where its ranges begin and end in that.
    json: Box<[u8]>,
    places: Box<[[usize; 2]]>,
    /// The ranges themselves.
    ranges: Box<[Range]>,
    /// What it is about may have changed: its data and ranges must be checked.
    is_in_doubt: bool,
}

/// A range as it is written in the kept text.
const PLACE: &str = r#"{"start":{"line":0,"character":0},"end":{"line":0,"character":0}}"#;

/// How many findings with one mark are compared: a text may hold many of one rule.
const MOST_ALIKE: usize = 16;

/// The most removed findings that are kept.
const MOST_GONE: usize = 256;

impl Shown {
    /// Notes what has changed since the last publish, so that findings about other things stay as they are.
    fn follow(&mut self, since: &Since) {
        for kept in self.kept.iter_mut().flatten() {
            kept.is_in_doubt |= !kept.follow(since);
        }
    }

    /// The findings as a JSON array; with the document's `uri` their other places, too.
    pub(crate) fn render(
        &mut self,
        document: &Document,
        findings: Vec<Finding>,
        encoding: Encoding,
        uri: Option<&str>,
    ) -> Written {
        let (settings, unit_mm) = (document.settings(), document.unit_mm());
        let is_under = |(old, mm): &(Arc<Effective>, f64)| old == settings && *mm == unit_mm;
        if !self.under.as_ref().is_some_and(is_under) {
            *self = Shown::default();
            self.under = Some((settings.clone(), unit_mm));
        }
        let mut whereabouts = document.whereabouts();
        let mut marks: Vec<u64> = findings.iter().map(mark).collect();
        let (mut kept, mut next) = (Vec::with_capacity(marks.len()), 0);
        let mut shown = Vec::with_capacity(self.length + PLACE.len());
        shown.push(b'[');
        // No text within a string looks like this: its quotes are escaped.
        let needle = format!("\"range\":{PLACE}");
        let ranges_in = Finder::new(&needle);
        for (finding, &mark) in findings.into_iter().zip(&marks) {
            let data = OnceCell::new();
            let mut data_now =
                || data.get_or_init(|| FindingData::of(document, &finding, &mut whereabouts));
            let known = self.find(mark, next, |old| {
                says_the_same(&old.finding, &finding)
                    && match old.is_in_doubt {
                        true => old.data == *data_now(),
                        false => old.finding.place == finding.place,
                    }
            });
            let own = match known.and_then(|at| self.kept.get_mut(at)?.take().zip(Some(at + 1))) {
                Some((mut old, behind)) => {
                    if behind <= self.count {
                        next = behind;
                    }
                    if std::mem::take(&mut old.is_in_doubt) {
                        let ranges = ranges_of(document, &finding, encoding, uri.is_some());
                        let ranges: Box<[Range]> = ranges.collect();
                        if ranges != old.ranges {
                            old.ranges = ranges;
                            old.write();
                        }
                    }
                    old.finding = finding;
                    old
                }
                None => {
                    let data = data_now().clone();
                    let mut rendered = diagnostic(document, &finding, data.clone(), encoding, uri);
                    rendered.range = Range::default();
                    for related in rendered.related_information.iter_mut().flatten() {
                        related.location.range = Range::default();
                    }
                    let json = written(&rendered).into_json();
                    let found = ranges_in.find_iter(&json).map(|at| at + "\"range\":".len());
                    let mut new = Kept {
                        data,
                        places: found.map(|at| [at, at + PLACE.len()]).collect(),
                        json: json.into(),
                        ranges: ranges_of(document, &finding, encoding, uri.is_some()).collect(),
                        finding,
                        is_in_doubt: false,
                    };
                    new.write();
                    Box::new(new)
                }
            };
            if shown.len() > 1 {
                shown.push(b',');
            }
            shown.extend_from_slice(&own.json);
            kept.push(Some(own));
        }
        shown.push(b']');
        (self.count, self.length) = (kept.len(), shown.len());
        let old = self.marks.drain(..).zip(self.kept.drain(..));
        let gone = old.filter(|(_, kept)| kept.is_some()).take(MOST_GONE);
        let (gone_marks, gone): (Vec<u64>, Vec<Option<Box<Kept>>>) = gone.unzip();
        marks.extend(gone_marks);
        kept.extend(gone);
        (self.marks, self.kept) = (marks, kept);
        Written::from(shown)
    }

    /// The index of a kept finding. Findings come in roughly their earlier order, so the search
    /// goes from `next` on, then before it.
    fn find(&self, mark: u64, next: usize, mut is_it: impl FnMut(&Kept) -> bool) -> Option<usize> {
        let behind = (next..self.marks.len()).chain(0..next.min(self.marks.len()));
        behind
            .filter(|&at| self.marks.get(at) == Some(&mark))
            .take(MOST_ALIKE)
            .find(|&at| matches!(self.kept.get(at), Some(Some(kept)) if is_it(kept)))
    }
}

impl Kept {
    /// Moves the ranges with their lines; false where what the finding is about has changed.
    fn follow(&mut self, since: &Since) -> bool {
        if let Place::Text { .. } = self.finding.place {
            let mut lines = self.ranges.iter().map(|range| range.end.line as usize);
            return lines.all(|line| since.is_as_before(line));
        }
        let mut places = std::iter::once(&self.finding.place).chain(&self.finding.related);
        let stays = |place: &Place| {
            let entity = place.entity();
            entity.is_some_and(|(entity, segment)| !since.has_changed(entity, segment))
        };
        if !places.all(stays) {
            return false;
        }
        let mut has_moved = false;
        for range in &mut self.ranges {
            for line in [&mut range.start.line, &mut range.end.line] {
                let now = since.line(*line as usize);
                let Some(now) = now.and_then(|now| u32::try_from(now).ok()) else {
                    return false;
                };
                has_moved |= std::mem::replace(line, now) != now;
            }
        }
        if has_moved {
            self.write();
        }
        true
    }

    /// Puts the ranges in their places of the text.
    fn write(&mut self) {
        let mut json = Vec::with_capacity(self.json.len() + PLACE.len());
        let mut from = 0;
        for (place, Range { start, end }) in self.places.iter_mut().zip(&self.ranges) {
            json.extend_from_slice(self.json.get(from..place[0]).unwrap_or_default());
            from = place[1];
            place[0] = json.len();
            for (label, number) in [
                (r#"{"start":{"line":"#, start.line),
                (r#","character":"#, start.character),
                (r#"},"end":{"line":"#, end.line),
                (r#","character":"#, end.character),
            ] {
                json.extend_from_slice(label.as_bytes());
                // A list of bytes takes all that is written.
                let _ = write!(json, "{number}");
            }
            json.extend_from_slice(b"}}");
            place[1] = json.len();
        }
        json.extend_from_slice(self.json.get(from..).unwrap_or_default());
        self.json = json.into();
    }
}

/// True where two findings differ at most in their range of the text.
fn says_the_same(one: &Finding, other: &Finding) -> bool {
    let in_text = |place: &Place| matches!(place, Place::Text { .. });
    one.rule == other.rule
        && one.severity == other.severity
        && (one.place == other.place || in_text(&one.place) && in_text(&other.place))
        && one.related == other.related
        && one.detail == other.detail
}

/// Equal for findings with the same content.
fn mark(finding: &Finding) -> u64 {
    let mut hasher = FxHasher::default();
    finding.rule.hash(&mut hasher);
    for place in std::iter::once(&finding.place).chain(&finding.related) {
        match place {
            Place::Segment { entity, segment } => (entity, segment).hash(&mut hasher),
            Place::Entity { entity } => entity.hash(&mut hasher),
            Place::Text { .. } | Place::Document => {}
        }
    }
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Source;
    use crate::dxf;
    use crate::program;
    use proptest::prelude::*;
    use std::fmt::Write as _;

    /// After any edits the kept text equals that of a first publish.
    fn check(mut document: Document, edits: &[(usize, usize, &str)]) {
        let mut shown = Shown::default();
        let uri = Some("file:///a\"range\":b");
        for (round, (line, width, text)) in edits.iter().enumerate() {
            let settings = Arc::new(Effective::of(&crate::settings::Settings::default()));
            if round % 5 == 4 {
                document.set_settings(settings);
            }
            let at = document.text().unwrap().line_range(*line);
            document.edit_text(at.start..(at.start + width).min(at.end), text);
            let mut told = |shown: &mut Shown| {
                let (told, _) = publish_of(&mut document, Encoding::Utf16, uri, shown);
                String::from_utf8(told.json().to_vec()).unwrap()
            };
            let known = told(&mut shown);
            assert_eq!(known, told(&mut Shown::default()));
            serde_json::from_str::<Vec<crate::protocol::Diagnostic>>(&known).unwrap();
        }
    }

    /// Squares with a corner radius below the correction, two of which cross, and one without closing line.
    fn drawing() -> String {
        let mut text = String::from(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
        );
        for square in 0..6 {
            let x = 7 * square;
            let _ = write!(
                text,
                "0\nLWPOLYLINE\n5\nA{square}\n8\n0\n90\n5\n70\n{}\n10\n{x}.5\n20\n0\n10\n{}\n20\n0\n10\n{}\n20\n9\n42\n0.4\n10\n{}\n20\n9.1\n10\n{x}\n20\n9\n",
                i32::from(square != 3),
                x + 8,
                x + 8,
                f64::from(x + 8) - 0.1,
            );
        }
        // Lines that continue each other, and cross the first square.
        for line in 0..4 {
            let _ = write!(
                text,
                "0\nLINE\n5\nB{line}\n8\n0\n10\n{line}\n20\n4\n11\n{}\n21\n4.{line}\n",
                line + 2
            );
        }
        text + "0\nENDSEC\n0\nEOF\n"
    }

    fn edits() -> impl Strategy<Value = Vec<(usize, usize, &'static str)>> {
        let text = prop::sample::select(vec!["1", "0", "-", "", ".5", "\n", "9\n10\n4\n20\n8"]);
        prop::collection::vec((0usize..280, 0usize..3, text), 1..12)
    }

    /// Edits of a drawing, also of its unit and of handles.
    fn drawn_edits() -> impl Strategy<Value = Vec<(usize, usize, &'static str)>> {
        let unit = prop::sample::select(vec!["1", "4", "5", "13", ""]);
        let handle = prop::sample::select(vec!["1", "B", ""]);
        let whole = prop_oneof![
            unit.prop_map(|unit| (7, 2, unit)),
            (0usize..3, 0usize..3, handle).prop_map(|(square, width, handle)| (
                17 + 32 * square,
                width,
                handle
            )),
        ];
        (
            edits(),
            prop::collection::vec((any::<prop::sample::Index>(), whole), 0..5),
        )
            .prop_map(|(mut edits, whole)| {
                for (at, edit) in whole {
                    edits.insert(at.index(edits.len() + 1), edit);
                }
                edits
            })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn a_drawing_is_shown_as_afresh(edits in drawn_edits()) {
            let settings = Arc::new(Effective::of(&crate::settings::Settings::default()));
            check(Document::new(Source::Dxf(dxf::Document::read(drawing().into())), settings), &edits);
        }

        #[test]
        fn a_program_is_shown_as_afresh(edits in edits()) {
            let text = "B3000B4000B4000GYL1\nB1B2\nB0B0B1000GXL1\nB1B1B1GXL9\n".repeat(20);
            check(program(program::Language::ThreeB, text), &edits);
        }

        /// Where the machine stands at a finding depends on what comes before: nothing behind an edit may be left as it was.
        #[test]
        fn a_long_program_is_shown_as_afresh((edits, language) in long_edits()) {
            let text = match language {
                program::Language::ThreeB => OPEN_3B.repeat(60),
                program::Language::Iso => format!("G92X0Y0\n{}M02\n", OPEN_ISO.repeat(60)),
            };
            check(program(language, text), &edits);
        }
    }

    /// Nothing stands before the first step but the beginning, which it gives.
    #[test]
    fn what_stands_before_all_steps_follows_the_first_of_them() {
        let text = "G777\n".repeat(60) + "G92X3.Y4.\nG01X5.Y6.\nM02\n";
        let edits = [(62, 0, " "), (60, 6, "G92X9."), (61, 9, ""), (62, 4, "M30")];
        check(program(program::Language::Iso, text), &edits);
        let text = "hello\n".repeat(60) + "B0B6000B6000GYL2\nDD\n";
        let edits = [(61, 0, " "), (60, 1, "A"), (60, 1, "B")];
        check(program(program::Language::ThreeB, text), &edits);
    }

    /// Open contours with findings, one after the other, with coordinates after the blocks of some.
    const OPEN_3B: &str = "B2000B0B2000GXL1\nB0B6000B6000GYL2\nB0B0B0GXL1\nB1000B0B1000GXNR1;  1.0, 2.0\nB6000B0B6000GXL3\nD\nB9000B0B9000GXL1\nD\n";
    const OPEN_ISO: &str =
        "G01X2.Y0.\nG02X3.Y4.I0.3J0.1\nG01X3.Y4.\nG91X1.\nG90Y9.\nM00\nG00X20.\nM00\n";

    fn program(language: program::Language, text: String) -> Document {
        let settings = Arc::new(Effective::of(&crate::settings::Settings::default()));
        let read = program::Document::read(language, text.into(), &settings);
        Document::new(Source::Program(read), settings)
    }

    /// Edits anywhere in a program of 480 lines, most of them in its last third; some change what all of it means.
    fn long_edits() -> impl Strategy<Value = (Vec<(usize, usize, &'static str)>, program::Language)>
    {
        let of = |texts: Vec<&'static str>| {
            let line = prop_oneof![0usize..481, 320usize..481];
            prop::collection::vec((line, 0usize..4, prop::sample::select(texts)), 1..10)
        };
        let three_b = vec![
            "1",
            "",
            "\n",
            "B1B",
            "DD\n",
            "D\n",
            "B5B5B5GXL1\n",
            ";",
            "GYL2\n",
            "A",
        ];
        let iso = vec![
            "1", "", "\n", "M02\n", "G91\n", "G20\n", "%\n", "M98P1\n", "X1.\n", "(", "G92X5.\n",
            "O1\n",
        ];
        prop_oneof![
            of(three_b).prop_map(|edits| (edits, program::Language::ThreeB)),
            of(iso).prop_map(|edits| (edits, program::Language::Iso)),
        ]
    }
}
