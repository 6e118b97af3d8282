//! `wedm demo`: a whole session with a real server, played by a small client that checks every answer.
//!
//! The client knows JSON-RPC and keeps its own copy of the text, as any other client would. Only
//! what it writes at the end is read again with the library.

mod cad;
mod client;
mod plate;

use super::options::Common;
use super::{Failure, Verdict, explain, output};
use crate::settings::FILE_NAME;
use anstyle::Style;
use clap::Args;
use client::Client;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Args, Debug)]
#[command(mut_arg("language", |language| language.hide(true)), after_help = "\
Examples:
  wedm demo
  wedm demo --correction 0.12 plate")]
pub(crate) struct Arguments {
    #[arg(value_name = "DIR", default_value = "wedm-demo")]
    folder: PathBuf,
    #[arg(long)]
    overwrite: bool,
    #[command(flatten)]
    common: Common,
}

/// mm. Below, no fillet of the plate is too tight; above, its slots are too narrow.
const CORRECTIONS: std::ops::RangeInclusive<f64> = 0.02..=0.5;

/// Begins the settings of a demonstration: a folder with them is one of an earlier run.
const MARK: &str = "# wedm demo\n";
const DRAWING: &str = "demo.dxf";
const PROGRAM: &str = "demo.3b";
const PICTURE: &str = "demo.svg";

/// Refuses to overwrite files that no demonstration has written.
fn refuse_foreign(folder: &Path) -> Result<(), Failure> {
    let settings = folder.join(FILE_NAME);
    output::refuse_foreign(&settings, MARK)?;
    let others = [DRAWING, PROGRAM, PICTURE].map(|name| folder.join(name));
    match others.iter().find(|other| other.exists()) {
        Some(other) if !settings.exists() => Err(Failure::of(other, say!(it_is_of_somebody_else))),
        _ => Ok(()),
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let stated = arguments.common.settings();
    let correction = stated.correction();
    if !CORRECTIONS.contains(&correction) {
        let (least, most) = (CORRECTIONS.start(), CORRECTIONS.end());
        return Err(Failure(say!(
            the_plate_of_the_demonstration_is_made_for_corrections_from_to_mm,
            least,
            most,
            correction
        )));
    }
    if stated.side.is_some() || arguments.common.config.is_some() {
        return Err(Failure(
            say!(the_demonstration_brings_its_own_settings_expected_correction_alone).into(),
        ));
    }
    let folder = &arguments.folder;
    if !arguments.overwrite {
        refuse_foreign(folder)?;
    }
    std::fs::create_dir_all(folder).map_err(|error| {
        let reason = crate::disk::plain(&error);
        Failure(say!(could_not_be_made, folder.display(), reason))
    })?;

    let mut demo = Demo::start(correction)?;
    let made = plate::session(&mut demo)?;
    cad::punch(&mut demo)?;
    cad::pair(&mut demo)?;
    holds(demo.client.end()?, "exit")?;

    demo.step(say!(the_server_has_ended_as_it_should));
    // Commands in this folder then see the drawing as the session did.
    let settings = format!(
        "{MARK}correction = {correction}\n\n[layers]\nDIE = \"opening\"\nHOLES = \"opening\"\nPLATE = \"ignore\"\n"
    );
    for (name, text, what) in [
        (DRAWING, made.dxf, say!(the_plate_repaired)),
        (PROGRAM, made.program, say!(its_program)),
        (FILE_NAME, settings, say!(the_settings_of_this_session)),
        (PICTURE, made.picture, say!(contour_faults_and_wire_path)),
    ] {
        let path = folder.join(name);
        output::write(Some(&path), text.as_bytes(), true)?;
        say(&format!("{}  {what}", output::name(&path)));
    }
    demo.step(say!(next_steps));
    let [drawing, program] = [DRAWING, "plate.3b"].map(|name| output::word(&folder.join(name)));
    for words in [
        &["check", &drawing][..],
        &["inspect", &drawing],
        &["generate", &drawing, "-o", &program],
        &["check", &program],
        &["explain", "small-radius"],
    ] {
        say(&format!("wedm {}", words.join(" ")));
    }
    say(&say!(the_same_in_a_browser, output::word(folder)));
    good(say!(everything_above_was_checked_as_it_was_said));
    Ok(Verdict::Clean)
}

/// A session that is shown step by step.
struct Demo {
    client: Client,
    correction: f64,
    /// Steps shown so far: they are numbered.
    steps: usize,
}

/// The settings of the plate in JSON.
fn settings(correction: f64) -> Value {
    json!({
        "correction": correction,
        "layers": { "DIE": "opening", "HOLES": "opening", "PLATE": "ignore" },
    })
}

impl Demo {
    fn start(correction: f64) -> Result<Demo, Failure> {
        let version = env!("CARGO_PKG_VERSION");
        let heading = say!(heading_of_the_demo, version, correction);
        print(output::STRONG, 0, "", &heading);
        let begun = Instant::now();
        let mut demo = Demo {
            client: Client::start()?,
            correction,
            steps: 0,
        };
        demo.step(say!(the_server_starts_as_a_child_and_speaks_lsp_over));
        let params = json!({
            "processId": std::process::id(),
            "rootUri": null,
            "locale": crate::message::spoken().tag(),
            "capabilities": {
                "workspace": { "workspaceEdit": { "documentChanges": true } },
                "experimental": { "wedm": { "applyDrawingEdit": true, "resendDrawing": true } },
            },
            "initializationOptions": settings(correction),
        });
        let result = demo.client.request("initialize", params)?;
        let elapsed = elapsed(begun);
        demo.client.notify("initialized", json!({}))?;
        let protocol = &result["capabilities"]["experimental"]["wedm"]["protocol"];
        holds(protocol == crate::protocol::PROTOCOL, &result)?;
        say(&say!(
            wedm_protocol_started_and_answered_within,
            version,
            protocol,
            elapsed
        ));
        say(say!(layers_die_and_holes_are_openings));
        Ok(demo)
    }

    fn step(&mut self, text: &str) {
        self.steps += 1;
        let _ = output::print("\n");
        let number = format!("{:>2}  ", self.steps);
        print(output::STRONG, INDENT, &number, text);
    }

    /// The diagnostics of a version of a document.
    fn diagnostics(&mut self, uri: &str, version: i64) -> Result<Vec<Value>, Failure> {
        let mut message = self.client.wait_for(|message| {
            let params = &message["params"];
            message["method"] == "textDocument/publishDiagnostics"
                && params["uri"] == uri
                && params["version"] == version
        })?;
        Ok(match message["params"]["diagnostics"].take() {
            Value::Array(diagnostics) => diagnostics,
            _ => Vec::new(),
        })
    }

    /// The preferred quick fix for a diagnostic; all titles are shown.
    fn fix(&mut self, uri: &str, diagnostic: &Value) -> Result<Value, Failure> {
        let params = json!({
            "textDocument": { "uri": uri },
            "range": diagnostic["range"],
            "context": { "diagnostics": [diagnostic], "only": ["quickfix"] },
        });
        let actions = self.client.request("textDocument/codeAction", params)?;
        let mut preferred = None;
        for action in list(&actions) {
            let title = action["title"].as_str().unwrap_or_default();
            let is_preferred = action["isPreferred"] == true;
            let shown = match is_preferred {
                true => say!(the_preferred_action, title),
                false => say!(another_action, title),
            };
            print(Style::new(), INDENT + 2, "    - ", &shown);
            preferred = preferred.or(is_preferred.then(|| action.clone()));
        }
        preferred.ok_or_else(|| otherwise(&actions))
    }
}

/// What the demonstration claims; a claim that does not hold ends it with what came instead.
fn holds(claim: bool, instead: impl std::fmt::Display) -> Result<(), Failure> {
    match claim {
        true => Ok(()),
        false => Err(otherwise(instead)),
    }
}

fn otherwise(instead: impl std::fmt::Display) -> Failure {
    let instead = instead.to_string();
    Failure(say!(
        the_demonstration_found_something_else_than_it_claims,
        instead
    ))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// The time since then, in milliseconds.
fn elapsed(begun: Instant) -> String {
    format!("{:.1} ms", begun.elapsed().as_secs_f64() * 1e3)
}

/// The segment that a diagnostic is about.
fn segment_of(diagnostic: &Value) -> (&str, u64) {
    let data = &diagnostic["data"];
    let handle = data["handle"].as_str().unwrap_or_default();
    (handle, data["segment"].as_u64().unwrap_or_default())
}

const COLUMNS: usize = 80;
const INDENT: usize = 4;

fn say(text: &str) {
    print(Style::new(), INDENT, "    ", text);
}

fn good(text: &str) {
    print(output::GOOD, INDENT, "    ", text);
}

/// A diagnostic as it arrived: its place, with the line where there is a text, then its sentence.
fn show(diagnostic: &Value, is_of_text: bool) {
    let (handle, segment) = segment_of(diagnostic);
    let line = diagnostic["range"]["start"]["line"].as_u64();
    let line = line.filter(|_| is_of_text);
    let line = line.map_or_else(String::new, |line| {
        say!(line_number, line + 1) + say!(comma)
    });
    let at = &diagnostic["data"]["start"];
    let rule = diagnostic["code"].as_str().unwrap_or_default();
    let place = say!(
        rule_and_place_of_a_segment,
        rule,
        line,
        handle,
        segment,
        number(&at[0]),
        number(&at[1])
    );
    print(output::ERROR, INDENT + 2, "    ! ", &place);
    let sentence = diagnostic["message"].as_str().unwrap_or_default();
    print(Style::new(), INDENT + 2, "      ", sentence);
}

/// Prints text in lines of at most 80 columns, the first after `lead`, the others indented.
fn print(style: Style, indent: usize, lead: &str, text: &str) {
    let margin = " ".repeat(indent);
    let leads = std::iter::once(lead).chain(std::iter::repeat(&*margin));
    for (lead, line) in leads.zip(explain::wrapped(text, COLUMNS - indent)) {
        // A reader that has gone away has seen enough; the files are still written.
        let _ = output::print(format!("{lead}{}\n", output::styled(style, line)));
    }
}
