//! The session on the DXF text of the cutting plate: edits, diagnostics, fixes, program.

use super::client::Client;
use super::copy::Copy;
use super::narrator::{Behind, Narrator, duration};
use super::{Failure, holds, preferred, proof, segment_of};
use serde_json::{Value, json};
use std::collections::BTreeSet;
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
struct Session<'a> {
    narrator: &'a mut Narrator,
    client: &'a mut Client,
    copy: Copy,
    /// The newest diagnostics.
    diagnostics: Vec<Value>,
}

pub(crate) fn session(
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
            .step(say!(the_drawing_of_a_cutting_plate_is_opened_as_dxf_text));
        let item = json!({ "uri": URI, "languageId": "dxf", "version": 1, "text": self.copy.text });
        self.tell("textDocument/didOpen", json!({ "textDocument": item }))
    }

    /// Tightens a fillet, opens it again, tightens another one.
    fn design(&mut self, correction: f64) -> Result<(), Failure> {
        let (tight, wide) = (0.6 * correction, 2.0 * correction);
        self.narrator
            .step(&say!(the_designer_squeezes_the_fillet_at_31_13_to_r, tight));
        self.fillet_by_the_tab(tight)?;
        let squeezed = self.has_segment(2);
        holds(squeezed, || say!(r_gets_no_diagnostic, tight))?;

        self.narrator.step(&say!(and_opens_it_again_to_r, wide));
        self.fillet_by_the_tab(wide)?;
        let still_there = self.has_segment(2);
        holds(!still_there, || say!(r_gets_a_diagnostic, wide))?;

        let tight = 0.9 * correction;
        self.narrator
            .step(&say!(the_fillet_at_16_24_becomes_r, tight));
        let params = self
            .copy
            .move_vertices(DIE, &[(22, 16.0 + tight, 24.0), (23, 16.0, 24.0 - tight)])?;
        self.tell("textDocument/didChange", params)?;
        let found = self.has_segment(22);
        holds(found, || say!(r_gets_no_diagnostic, tight))
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

    /// Tells the server of a change, waits for the diagnostics of the new version, and prints which
    /// have appeared and which have gone.
    fn tell(&mut self, method: &str, params: Value) -> Result<(), Failure> {
        let begun = Instant::now();
        self.client.notify(method, params)?;
        let diagnostics = self.client.diagnostics(URI, self.copy.version)?;
        let elapsed = duration(begun.elapsed());
        let before: BTreeSet<(String, u64)> = self.diagnostics.iter().map(segment_of).collect();
        let after: BTreeSet<(String, u64)> = diagnostics.iter().map(segment_of).collect();
        let count = say!(diagnostics, diagnostics.len());
        self.narrator.say(&say!(
            version_after_it_was_sent,
            self.copy.version,
            count,
            elapsed
        ));
        for diagnostic in diagnostics
            .iter()
            .filter(|diagnostic| !before.contains(&segment_of(diagnostic)))
        {
            self.narrator.diagnostic(diagnostic, Behind::Text);
        }
        for (handle, segment) in before.difference(&after) {
            self.narrator.good(&say!(gone, handle, segment));
        }
        self.diagnostics = diagnostics;
        Ok(())
    }

    /// A drawing that the wire cannot follow gives no program.
    fn ask_too_early(&mut self) -> Result<(), Failure> {
        self.narrator.step(say!(a_program_is_asked_for_too_early));
        let id = self
            .client
            .ask("wedm/generate", json!({ "uri": URI, "format": "3b" }))?;
        let error = match self.client.reply_or_error(id)? {
            Err(error) => error,
            Ok(_) => {
                return Err(Failure(
                    say!(the_server_made_a_program_of_a_drawing_with_errors).into(),
                ));
            }
        };
        let listed = error["data"]["diagnostics"].as_array().map_or(0, Vec::len);
        holds(
            error["code"] == -32803 && listed == self.diagnostics.len(),
            || say!(the_refusal_is, error),
        )?;
        self.narrator.say(&say!(
            refused_with_of_them_listed,
            listed,
            error["message"].as_str().unwrap_or_default()
        ));
        Ok(())
    }

    fn fix_one(&mut self) -> Result<(), Failure> {
        let Some(diagnostic) = self.diagnostics.first().cloned() else {
            return Err(Failure(say!(there_is_nothing_to_fix).into()));
        };
        let (handle, segment) = segment_of(&diagnostic);
        self.narrator
            .step(&say!(what_can_be_done_about_segment, handle, segment));
        let actions = self.actions(
            &diagnostic["range"].clone(),
            json!({ "diagnostics": [diagnostic], "only": ["quickfix"] }),
        )?;
        let action = preferred(self.narrator, &actions)?;
        let edits = action["edit"]["documentChanges"][0]["edits"]
            .as_array()
            .map_or(0, Vec::len);
        self.narrator.say(&say!(
            the_preferred_one_is_applied_in_the_text,
            say!(new_numbers, edits)
        ));
        let before = self.diagnostics.len();
        let params = self.copy.apply(&action["edit"])?;
        self.tell("textDocument/didChange", params)?;
        let after = self.diagnostics.len();
        holds(after < before, || {
            say!(diagnostics_after_the_fix_before, after, before)
        })
    }

    fn fix_the_rest(&mut self, faulty: &str) -> Result<(), Failure> {
        self.narrator.step(say!(all_others_are_fixed_at_once));
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
            say!(diagnostics_are_left_after_all_fixes, left)
        })?;
        let (old, new): (Vec<&str>, Vec<&str>) = (
            faulty.split('\n').collect(),
            self.copy.text.split('\n').collect(),
        );
        let differing = old.iter().zip(&new).filter(|(a, b)| a != b).count();
        holds(old.len() == new.len() && differing < 24, || {
            say!(lines_differ, differing)
        })?;
        let inspection = self
            .client
            .request("wedm/inspect", json!({ "uri": URI, "handle": DIE }))?;
        let segments = inspection["entities"][0]["segments"]
            .as_array()
            .map_or(&[][..], Vec::as_slice);
        holds(
            !segments.is_empty() && segments.iter().all(|segment| segment["verdict"] == "ok"),
            || say!(a_verdict_is_not_ok).into(),
        )?;
        self.narrator.good(&say!(
            the_drawing_is_clean_of_all_ok,
            say!(segments, segments.len()),
            DIE
        ));
        self.narrator
            .say(&say!(lines_that_differ, differing, old.len() - 1));
        Ok(())
    }

    fn actions(&mut self, range: &Value, context: Value) -> Result<Value, Failure> {
        let params = json!({ "textDocument": { "uri": URI }, "range": range, "context": context });
        self.client.request("textDocument/codeAction", params)
    }

    fn generate(&mut self) -> Result<String, Failure> {
        self.narrator.step(say!(now_the_3b_program));
        let begun = Instant::now();
        let mut result = self
            .client
            .request("wedm/generate", json!({ "uri": URI, "format": "3b" }))?;
        let elapsed = duration(begun.elapsed());
        let Value::String(program) = result["program"].take() else {
            return Err(Failure(say!(the_server_sent_no_program).into()));
        };
        // A drift that rounds to zero has no sign.
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let drift = |axis: &str| (number(&result["closure"][axis]) * 100.0).round() / 100.0 + 0.0;
        self.narrator.say(&say!(
            blocks_and_how_far_they_close,
            result["blocks"],
            number(&result["length"]),
            elapsed,
            drift("x"),
            drift("y")
        ));
        let lines: Vec<&str> = program.lines().collect();
        for line in lines.iter().take(3) {
            self.narrator.say(line);
        }
        self.narrator
            .say(&say!(more_lines, lines.len().saturating_sub(3)));
        Ok(program)
    }

    /// Reads the files again and compares them with the request.
    fn prove(&mut self, faulty: &str, program: &str, correction: f64) -> Result<String, Failure> {
        self.narrator.step(say!(
            program_and_drawing_are_read_again_and_held_against_each
        ));
        let toolpath = self
            .client
            .request("wedm/toolpath", json!({ "uri": URI }))?;
        let proof = proof::of(faulty, &self.copy.text, program, &toolpath, correction)?;
        self.narrator.say(&say!(
            decoded_one_from_the_end_of_the_other,
            say!(blocks, proof.blocks),
            proof.from_path_um,
            proof.open_um
        ));
        self.narrator.say(&say!(
            distance_of_the_wire_from_the_contours,
            proof.least_distance,
            proof.largest_distance,
            correction
        ));
        Ok(proof.picture)
    }
}
