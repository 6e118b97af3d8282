//! The session on the DXF text of the cutting plate: edits, diagnostics, fixes, program.

use super::{Demo, Failure, elapsed, good, holds, list, number, otherwise, say, segment_of, show};
use crate::compare::Beside;
use crate::document::{Document, FileKind};
use crate::program::Language;
use crate::settings::{Effective, from_json};
use crate::text::{Encoding, SourceText};
use crate::{picture, toolpath};
use serde_json::{Value, json};
use std::cmp::Reverse;
use std::sync::Arc;
use std::time::Instant;

const PLATE: &str = include_str!("plate.dxf");
/// The plate has no file until the demonstration ends; no project's settings reach it.
const URI: &str = "untitled:plate.dxf";
/// The opening that the designer works on.
const DIE: &str = "2A";

/// What the demonstration gives to its user.
pub(crate) struct Made {
    pub(crate) dxf: String,
    pub(crate) program: String,
    pub(crate) picture: String,
}

/// The plate as client and user see it.
struct Plate<'a> {
    demo: &'a mut Demo,
    text: SourceText,
    version: i64,
    /// The newest diagnostics.
    diagnostics: Vec<Value>,
}

pub(crate) fn session(demo: &mut Demo) -> Result<Made, Failure> {
    let mut plate = Plate {
        demo,
        text: SourceText::new(PLATE.into()),
        version: 1,
        diagnostics: Vec::new(),
    };
    plate.open()?;
    plate.design()?;
    plate.ask_too_early()?;
    let faulty = plate.text.as_str_lossy().into_owned();
    plate.fix_one()?;
    plate.fix_the_rest(&faulty)?;
    let program = plate.generate()?;
    let dxf = plate.text.as_str_lossy().into_owned();
    let picture = plate.read_again(&faulty, &dxf, &program)?;
    Ok(Made {
        dxf,
        program,
        picture,
    })
}

impl Plate<'_> {
    fn open(&mut self) -> Result<(), Failure> {
        let heading = say!(the_drawing_of_a_cutting_plate_is_opened_as_dxf_text);
        self.demo.step(heading);
        let item = json!({ "uri": URI, "languageId": "dxf", "version": 1, "text": PLATE });
        self.tell("textDocument/didOpen", json!({ "textDocument": item }))
    }

    /// Tightens a fillet, opens it again, tightens another one.
    fn design(&mut self) -> Result<(), Failure> {
        let [tight, wide, other] = [0.6, 2.0, 0.9].map(|part| part * self.demo.correction);
        let by_the_tab = |r: f64| [(2, [31.0 - r, 13.0]), (3, [31.0, 13.0 + r])];
        let at_the_side = [(22, [16.0 + other, 24.0]), (23, [16.0, 24.0 - other])];
        let squeezed = say!(the_designer_squeezes_the_fillet_at_31_13_to_r, tight);
        for (heading, vertices, is_too_tight) in [
            (squeezed, by_the_tab(tight), true),
            (say!(and_opens_it_again_to_r, wide), by_the_tab(wide), false),
            (
                say!(the_fillet_at_16_24_becomes_r, other),
                at_the_side,
                true,
            ),
        ] {
            self.demo.step(&heading);
            let moves = vertices.iter();
            let edits = moves.flat_map(|&(index, to)| self.vertex_moved(index, to));
            self.change(edits.collect())?;
            let segment = vertices[0].0 as u64;
            let mut found = self.diagnostics.iter();
            let found = found.any(|one| segment_of(one) == (DIE, segment));
            holds(found == is_too_tight, &heading)?;
        }
        Ok(())
    }

    /// The edits of the two numbers of a vertex of the die. Each stands in the line after its group code.
    fn vertex_moved(&self, index: usize, to: [f64; 2]) -> Vec<Value> {
        let text = self.text.as_str_lossy();
        let lines = text.lines().enumerate();
        let of_die = lines.skip_while(|(_, line)| *line != DIE);
        let mut vertices = of_die.filter(|(_, line)| *line == " 10");
        let Some((code, _)) = vertices.nth(index) else {
            return Vec::new();
        };
        let edit = |line: usize, number: f64| {
            let end = self.text.line(line).len();
            let range = json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": end } });
            json!({ "range": range, "newText": format!("{number:.4}") })
        };
        vec![edit(code + 1, to[0]), edit(code + 3, to[1])]
    }

    /// Changes the text, and tells the server.
    fn change(&mut self, mut edits: Vec<Value>) -> Result<(), Failure> {
        // From the last to the first, so that the places of the others stay right.
        let place = |at: &Value| {
            [&at["line"], &at["character"]].map(|at| at.as_u64().unwrap_or(0) as usize)
        };
        edits.sort_by_key(|edit| Reverse(place(&edit["range"]["start"])));
        let mut changes = Vec::new();
        for edit in &edits {
            let [start, end] = [&edit["range"]["start"], &edit["range"]["end"]].map(|at| {
                let [line, character] = place(at);
                self.text.offset_of(line, character, Encoding::Utf16)
            });
            let text = edit["newText"].as_str().ok_or_else(|| otherwise(edit))?;
            self.text.replace(start..end, text);
            changes.push(json!({ "range": edit["range"], "text": text }));
        }
        self.version += 1;
        let document = json!({ "uri": URI, "version": self.version });
        self.tell(
            "textDocument/didChange",
            json!({ "textDocument": document, "contentChanges": changes }),
        )
    }

    /// Tells the server of a change, waits for the diagnostics of the new version, and shows which have appeared and
    /// which have gone.
    fn tell(&mut self, method: &str, params: Value) -> Result<(), Failure> {
        let begun = Instant::now();
        self.demo.client.notify(method, params)?;
        let new = self.demo.diagnostics(URI, self.version)?;
        let elapsed = elapsed(begun);
        let count = say!(diagnostics, new.len());
        say(&say!(
            version_after_it_was_sent,
            self.version,
            count,
            elapsed
        ));
        let old = std::mem::replace(&mut self.diagnostics, new);
        let is_in =
            |all: &[Value], one| all.iter().any(|other| segment_of(other) == segment_of(one));
        for diagnostic in self.diagnostics.iter().filter(|one| !is_in(&old, one)) {
            show(diagnostic, true);
        }
        for diagnostic in old.iter().filter(|one| !is_in(&self.diagnostics, one)) {
            let (handle, segment) = segment_of(diagnostic);
            good(&say!(gone, handle, segment));
        }
        Ok(())
    }

    /// A drawing that the wire cannot follow gives no program.
    fn ask_too_early(&mut self) -> Result<(), Failure> {
        self.demo.step(say!(a_program_is_asked_for_too_early));
        let params = json!({ "uri": URI, "format": "3b" });
        let id = self.demo.client.ask("wedm/generate", params)?;
        let reply = self.demo.client.reply(id)?;
        let error = &reply["error"];
        let listed = list(&error["data"]["diagnostics"]).len();
        let is_refused = error["code"] == -32803 && listed == self.diagnostics.len();
        holds(is_refused, &reply)?;
        let sentence = error["message"].as_str().unwrap_or_default();
        say(&say!(refused_with_of_them_listed, listed, sentence));
        Ok(())
    }

    fn fix_one(&mut self) -> Result<(), Failure> {
        let diagnostic = self.diagnostics.first().cloned().unwrap_or_default();
        let (handle, segment) = segment_of(&diagnostic);
        let heading = say!(what_can_be_done_about_segment, handle, segment);
        self.demo.step(&heading);
        let action = self.demo.fix(URI, &diagnostic)?;
        let edits = self.edits_of(&action)?;
        say(&say!(
            the_preferred_one_is_applied_in_the_text,
            say!(new_numbers, edits.len())
        ));
        let before = self.diagnostics.len();
        self.change(edits)?;
        holds(self.diagnostics.len() < before, self.diagnostics.len())
    }

    /// The edits of an action, which are of this text in this version.
    fn edits_of(&self, action: &Value) -> Result<Vec<Value>, Failure> {
        let document = &action["edit"]["documentChanges"][0];
        let of = json!({ "uri": URI, "version": self.version });
        holds(document["textDocument"] == of, action)?;
        Ok(list(&document["edits"]).to_vec())
    }

    fn fix_the_rest(&mut self, faulty: &str) -> Result<(), Failure> {
        self.demo.step(say!(all_others_are_fixed_at_once));
        let end = self.text.line_count();
        if !self.diagnostics.is_empty() {
            let params = json!({
                "textDocument": { "uri": URI },
                "range": { "start": { "line": 0, "character": 0 }, "end": { "line": end, "character": 0 } },
                "context": { "diagnostics": self.diagnostics, "only": ["source.fixAll.wedm"] },
            });
            let actions = self
                .demo
                .client
                .request("textDocument/codeAction", params)?;
            self.change(self.edits_of(&actions[0])?)?;
        }
        holds(self.diagnostics.is_empty(), self.diagnostics.len())?;
        let params = json!({ "uri": URI, "handle": DIE });
        let inspection = self.demo.client.request("wedm/inspect", params)?;
        let segments = list(&inspection["entities"][0]["segments"]);
        let are_ok = segments.iter().all(|segment| segment["verdict"] == "ok");
        holds(are_ok && !segments.is_empty(), &inspection)?;
        let segments = say!(segments, segments.len());
        good(&say!(the_drawing_is_clean_of_all_ok, segments, DIE));
        let text = self.text.as_str_lossy();
        let lines = faulty.lines().count();
        let differing = faulty.lines().zip(text.lines());
        let differing = differing.filter(|(old, new)| old != new).count();
        holds(lines == text.lines().count() && differing < 24, differing)?;
        say(&say!(lines_that_differ, differing, lines));
        Ok(())
    }

    fn generate(&mut self) -> Result<String, Failure> {
        self.demo.step(say!(now_the_3b_program));
        let begun = Instant::now();
        let params = json!({ "uri": URI, "format": "3b" });
        let result = self.demo.client.request("wedm/generate", params)?;
        let program = result["program"]
            .as_str()
            .ok_or_else(|| otherwise(&result))?;
        say(&say!(
            blocks_and_their_length,
            result["blocks"],
            number(&result["length"]),
            elapsed(begun)
        ));
        program.lines().take(3).for_each(say);
        let more = program.lines().count().saturating_sub(3);
        say(&say!(more_lines, more));
        Ok(program.to_owned())
    }

    /// Reads drawing and program again, from their text alone, and compares them as `wedm check` does. Returns the
    /// picture of both.
    fn read_again(&mut self, faulty: &str, dxf: &str, program: &str) -> Result<String, Failure> {
        let heading = say!(program_and_drawing_are_read_again_and_held_against_each);
        self.demo.step(heading);
        let correction = self.demo.correction;
        let (settings, _) = from_json(&super::settings(correction));
        let settings = Arc::new(Effective::of(&settings));
        let read = |kind: FileKind, text: &str| {
            let (source, _) = kind.read(text.into(), &settings);
            Document::new(source, settings.clone())
        };
        let before = read(FileKind::Drawing, faulty);
        let after = read(FileKind::Drawing, dxf);
        let mut program = read(FileKind::Program(Language::ThreeB), program);
        let form = after.form().ok_or_else(|| dxf.to_owned());
        program.set_beside(Beside::of_program((URI.into(), form), Vec::new()));
        let left: Vec<_> = [&after, &program]
            .iter()
            .flat_map(|of| of.all_findings().to_vec())
            .collect();
        holds(left.is_empty(), left.len())?;
        let snapshot = after.snapshot().ok_or_else(|| otherwise(0))?;
        say(&say!(the_program_cuts_the_drawing, correction));
        let (drawing, outlines) = (&snapshot.drawing, &snapshot.outlines);
        let paths = toolpath::plan(drawing, outlines, &settings, None).unwrap_or_default();
        Ok(picture::svg(&picture::View {
            name: None,
            drawing,
            outlines,
            findings: &before.all_findings(),
            paths: &paths,
            parts: &[],
            holes: &[],
            why: None,
            settings: &settings,
        }))
    }
}
