//! The session on the DXF text of the cutting plate: edits, diagnostics, fixes, program.

use super::client::Client;
use super::copy::Copy;
use super::narrator::{Behind, Narrator, duration};
use super::{Failure, holds, preferred, proof, segment_of};
use crate::cli::output::counted;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::time::Instant;

const PLATE: &str = include_str!("plate.dxf");
/// The plate has no file until the demonstration ends; no project's settings reach it.
const URI: &str = "untitled:plate.dxf";
/// The opening that the designer works on.
const DIE: &str = "2A";

/// What the demonstration gives to its user.
pub struct Made {
    pub dxf: String,
    pub program: String,
    pub picture: String,
}

/// The plate as client and user see it.
struct Session<'a> {
    narrator: &'a mut Narrator,
    client: &'a mut Client,
    copy: Copy,
    /// The newest diagnostics.
    diagnostics: Vec<Value>,
}

pub fn session(
    narrator: &mut Narrator,
    client: &mut Client,
    correction: f64,
) -> Result<Made, Failure> {
    let mut session = Session {
        narrator,
        client,
        copy: Copy::new(URI, PLATE),
        diagnostics: Vec::new(),
    };
    session.open()?;
    session.design(correction)?;
    session.ask_too_early()?;
    let faulty = session.copy.text.clone();
    session.fix_one()?;
    session.fix_the_rest(&faulty)?;
    let program = session.generate()?;
    let picture = session.prove(&faulty, &program, correction)?;
    Ok(Made {
        dxf: session.copy.text,
        program,
        picture,
    })
}

impl Session<'_> {
    fn open(&mut self) -> Result<(), Failure> {
        self.narrator
            .step("The drawing of a cutting plate is opened as DXF text");
        let item = json!({ "uri": URI, "languageId": "dxf", "version": 1, "text": self.copy.text });
        self.tell("textDocument/didOpen", json!({ "textDocument": item }))
    }

    /// Squeezes a fillet, opens it again, squeezes another one.
    fn design(&mut self, correction: f64) -> Result<(), Failure> {
        let (tight, wide) = (0.6 * correction, 2.0 * correction);
        self.narrator.step(&format!(
            "The designer squeezes the fillet at 31, 13 to R {tight:.3}"
        ));
        self.fillet_by_the_tab(tight)?;
        let squeezed = self.has_segment(2);
        holds(squeezed, || format!("R {tight:.3} gets no diagnostic"))?;

        self.narrator
            .step(&format!("... and opens it again, to R {wide:.3}"));
        self.fillet_by_the_tab(wide)?;
        let still_there = self.has_segment(2);
        holds(!still_there, || format!("R {wide:.3} gets a diagnostic"))?;

        let tight = 0.9 * correction;
        self.narrator
            .step(&format!("The fillet at 16, 24 becomes R {tight:.3}"));
        let params = self
            .copy
            .move_vertices(DIE, &[(22, 16.0 + tight, 24.0), (23, 16.0, 24.0 - tight)])?;
        self.tell("textDocument/didChange", params)?;
        let found = self.has_segment(22);
        holds(found, || format!("R {tight:.3} gets no diagnostic"))
    }

    fn fillet_by_the_tab(&mut self, radius: f64) -> Result<(), Failure> {
        let params = self
            .copy
            .move_vertices(DIE, &[(2, 31.0 - radius, 13.0), (3, 31.0, 13.0 + radius)])?;
        self.tell("textDocument/didChange", params)
    }

    fn has_segment(&self, segment: u64) -> bool {
        self.diagnostics
            .iter()
            .any(|diagnostic| segment_of(diagnostic) == (DIE.to_string(), segment))
    }

    /// Tells the server of a change, waits for the diagnostics of the new version and says which came and which went.
    fn tell(&mut self, method: &str, params: Value) -> Result<(), Failure> {
        let begun = Instant::now();
        self.client.notify(method, params)?;
        let diagnostics = self.client.diagnostics(URI, self.copy.version)?;
        let elapsed = duration(begun.elapsed());
        let before: BTreeSet<(String, u64)> = self.diagnostics.iter().map(segment_of).collect();
        let after: BTreeSet<(String, u64)> = diagnostics.iter().map(segment_of).collect();
        let count = counted(diagnostics.len(), "diagnostic");
        self.narrator.say(&format!(
            "version {}: {count}, {elapsed} after it was sent",
            self.copy.version
        ));
        for diagnostic in diagnostics
            .iter()
            .filter(|diagnostic| !before.contains(&segment_of(diagnostic)))
        {
            self.narrator.diagnostic(diagnostic, Behind::Text);
        }
        for (handle, segment) in before.difference(&after) {
            self.narrator
                .good(&format!("gone: {handle} segment {segment}"));
        }
        self.diagnostics = diagnostics;
        Ok(())
    }

    /// No program comes out of a drawing that the wire cannot follow.
    fn ask_too_early(&mut self) -> Result<(), Failure> {
        self.narrator.step("A program is asked for too early");
        let id = self
            .client
            .ask("wedm/generate", json!({ "uri": URI, "format": "3b" }))?;
        let error = match self.client.reply_or_error(id)? {
            Err(error) => error,
            Ok(_) => {
                return Err(Failure(
                    "the server made a program of a drawing with errors".into(),
                ));
            }
        };
        let listed = error["data"]["diagnostics"].as_array().map_or(0, Vec::len);
        holds(
            error["code"] == -32803 && listed == self.diagnostics.len(),
            || format!("the refusal is {error}"),
        )?;
        self.narrator.say(&format!(
            "refused, with {listed} of them listed: {}",
            error["message"].as_str().unwrap_or_default()
        ));
        Ok(())
    }

    fn fix_one(&mut self) -> Result<(), Failure> {
        let Some(diagnostic) = self.diagnostics.first().cloned() else {
            return Err(Failure("there is nothing to fix".into()));
        };
        let (handle, segment) = segment_of(&diagnostic);
        self.narrator.step(&format!(
            "What can be done about {handle} segment {segment}?"
        ));
        let actions = self.actions(
            &diagnostic["range"].clone(),
            json!({ "diagnostics": [diagnostic], "only": ["quickfix"] }),
        )?;
        let action = preferred(self.narrator, &actions)?;
        let edits = action["edit"]["documentChanges"][0]["edits"]
            .as_array()
            .map_or(0, Vec::len);
        self.narrator.say(&format!(
            "The preferred one is applied: {} in the text.",
            counted(edits, "new number")
        ));
        let before = self.diagnostics.len();
        let params = self.copy.apply(&action["edit"])?;
        self.tell("textDocument/didChange", params)?;
        let after = self.diagnostics.len();
        holds(after < before, || {
            format!("{after} diagnostics after the fix, {before} before it")
        })
    }

    fn fix_the_rest(&mut self, faulty: &str) -> Result<(), Failure> {
        self.narrator
            .step("All others are fixed at once (source.fixAll.wedm)");
        let lines = self.copy.text.lines().count();
        let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": lines, "character": 0 } });
        let context = json!({ "diagnostics": self.diagnostics, "only": ["source.fixAll.wedm"] });
        if !self.diagnostics.is_empty() {
            let actions = self.actions(&whole, context)?;
            let params = self.copy.apply(&actions[0]["edit"])?;
            self.tell("textDocument/didChange", params)?;
        }
        let left = self.diagnostics.len();
        holds(left == 0, || {
            format!("{left} diagnostics are left after all fixes")
        })?;
        let (old, new): (Vec<&str>, Vec<&str>) = (
            faulty.split('\n').collect(),
            self.copy.text.split('\n').collect(),
        );
        let differing = old.iter().zip(&new).filter(|(a, b)| a != b).count();
        holds(old.len() == new.len() && differing < 24, || {
            format!("{differing} lines differ")
        })?;
        let inspection = self
            .client
            .request("wedm/inspect", json!({ "uri": URI, "handle": DIE }))?;
        let segments = inspection["entities"][0]["segments"]
            .as_array()
            .map_or(&[][..], Vec::as_slice);
        holds(
            !segments.is_empty() && segments.iter().all(|segment| segment["verdict"] == "ok"),
            || "a verdict is not ok".into(),
        )?;
        self.narrator.good(&format!(
            "The drawing is clean: {} of {DIE}, all ok.",
            counted(segments.len(), "segment")
        ));
        self.narrator.say(&format!(
            "{differing} of {} lines differ, every other byte is as it was.",
            old.len() - 1
        ));
        Ok(())
    }

    fn actions(&mut self, range: &Value, context: Value) -> Result<Value, Failure> {
        let params = json!({ "textDocument": { "uri": URI }, "range": range, "context": context });
        self.client.request("textDocument/codeAction", params)
    }

    fn generate(&mut self) -> Result<String, Failure> {
        self.narrator.step("Now the 3B program");
        let begun = Instant::now();
        let mut result = self
            .client
            .request("wedm/generate", json!({ "uri": URI, "format": "3b" }))?;
        let elapsed = duration(begun.elapsed());
        let Value::String(program) = result["program"].take() else {
            return Err(Failure("the server sent no program".into()));
        };
        // A drift that rounds to zero has no sign.
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let drift = |axis: &str| (number(&result["closure"][axis]) * 100.0).round() / 100.0 + 0.0;
        self.narrator.say(&format!(
            "{} blocks, {:.3} mm, after {elapsed}; closes within {:.2}, {:.2} µm",
            result["blocks"],
            number(&result["length"]),
            drift("x"),
            drift("y")
        ));
        let lines: Vec<&str> = program.lines().collect();
        for line in lines.iter().take(3) {
            self.narrator.say(line);
        }
        self.narrator
            .say(&format!("... {} more lines", lines.len().saturating_sub(3)));
        Ok(program)
    }

    /// Reads the files' contents as a stranger would and holds them against what was asked for.
    fn prove(&mut self, faulty: &str, program: &str, correction: f64) -> Result<String, Failure> {
        self.narrator
            .step("Program and drawing are read again and held against each other");
        let toolpath = self
            .client
            .request("wedm/toolpath", json!({ "uri": URI }))?;
        let proof = proof::of(faulty, &self.copy.text, program, &toolpath, correction)?;
        self.narrator.say(&format!(
            "{} decoded one from the end of the other: at most {:.2} µm from the path, and back in the last thread hole within {:.2} µm.",
            counted(proof.blocks, "block"),
            proof.from_path_um,
            proof.open_um
        ));
        self.narrator.say(&format!(
            "Along the contours the wire's centre keeps {:.4} to {:.4} mm from them: the correction is {correction:.3}.",
            proof.least_distance, proof.largest_distance
        ));
        Ok(proof.picture)
    }
}
