//! `wedm demo`: a whole session with a real server, played by a small client that checks every answer.
//!
//! The client knows JSON-RPC and keeps its own copy of the text, as any other client would. Only
//! its proof of the result uses the library again.

mod client;
mod copy;
mod narrator;
mod pair;
mod plate;
mod proof;
mod punch;

use super::options::Common;
use super::{Failure, Verdict, output};
use crate::settings::FILE_NAME;
use clap::Args;
use client::Client;
use narrator::Narrator;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

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
    if settings.exists() {
        return Ok(());
    }
    let mut others = [DRAWING, PROGRAM, PICTURE]
        .map(|name| folder.join(name))
        .into_iter();
    match others.find(|other| other.exists()) {
        Some(other) => Err(Failure::of(&other, say!(it_is_of_somebody_else))),
        None => Ok(()),
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
    if !arguments.overwrite {
        refuse_foreign(&arguments.folder)?;
    }
    std::fs::create_dir_all(&arguments.folder).map_err(|error| {
        Failure(say!(
            could_not_be_made,
            arguments.folder.display(),
            crate::disk::plain(&error)
        ))
    })?;

    let mut narrator = Narrator::default();
    narrator.heading(&say!(
        heading_of_the_demo,
        env!("CARGO_PKG_VERSION"),
        correction
    ));
    let mut client = start(&mut narrator, correction)?;
    let made = plate::session(&mut narrator, &mut client, correction)?;
    punch::session(&mut narrator, &mut client, correction)?;
    pair::session(&mut narrator, &mut client, correction)?;
    client.end()?;

    // The settings of the session, so that commands in this folder see the drawing as the session did.
    let settings = format!(
        "{MARK}correction = {correction}\n\n[layers]\nDIE = \"opening\"\nHOLES = \"opening\"\nPLATE = \"ignore\"\n"
    );
    narrator.step(say!(the_server_has_ended_as_it_should));
    for (name, bytes, what) in [
        (DRAWING, made.dxf.as_bytes(), say!(the_plate_repaired)),
        (PROGRAM, made.program.as_bytes(), say!(its_program)),
        (
            FILE_NAME,
            settings.as_bytes(),
            say!(the_settings_of_this_session),
        ),
        (
            PICTURE,
            made.picture.as_bytes(),
            say!(contour_faults_and_wire_path),
        ),
    ] {
        let path = arguments.folder.join(name);
        output::write(Some(&path), bytes, true)?;
        narrator.say(&format!("{}  {what}", output::name(&path)));
    }
    narrator.step(say!(next_steps));
    let drawing = output::word(&arguments.folder.join(DRAWING));
    let program = output::word(&arguments.folder.join("plate.3b"));
    for words in [
        &["check", &drawing][..],
        &["inspect", &drawing],
        &["generate", &drawing, "-o", &program],
        &["check", &program],
        &["explain", "small-radius"],
    ] {
        narrator.say(&format!("wedm {}", words.join(" ")));
    }
    narrator.good(say!(everything_above_was_checked_as_it_was_said));
    Ok(Verdict::Clean)
}

fn start(narrator: &mut Narrator, correction: f64) -> Result<Client, Failure> {
    narrator.step(say!(the_server_starts_as_a_child_and_speaks_lsp_over));
    let begun = std::time::Instant::now();
    let mut client = Client::start()?;
    let params = json!({
        "processId": std::process::id(),
        "clientInfo": { "name": say!(wedm_demo) },
        "rootUri": null,
        "locale": crate::message::spoken().tag(),
        "capabilities": {
            "general": { "positionEncodings": ["utf-8", "utf-16"] },
            "workspace": { "workspaceEdit": { "documentChanges": true } },
            "textDocument": {
                "publishDiagnostics": { "versionSupport": true, "dataSupport": true },
                "codeAction": {
                    "isPreferredSupport": true,
                    "dataSupport": true,
                    "codeActionLiteralSupport": { "codeActionKind": { "valueSet": ["quickfix", "source.fixAll"] } },
                },
            },
            "experimental": { "wedm": { "applyDrawingEdit": true, "resendDrawing": true } },
        },
        "initializationOptions": {
            "correction": correction,
            "layers": { "DIE": "opening", "HOLES": "opening", "PLATE": "ignore" },
        },
    });
    let result = client.request("initialize", params)?;
    let elapsed = begun.elapsed();
    client.notify("initialized", json!({}))?;
    let (name, version) = (
        &result["serverInfo"]["name"],
        &result["serverInfo"]["version"],
    );
    let protocol = &result["capabilities"]["experimental"]["wedm"]["protocol"];
    holds(
        name == "wedm" && protocol == crate::protocol::PROTOCOL,
        || say!(the_server_says_it_is_protocol, name, protocol),
    )?;
    narrator.say(&say!(
        wedm_protocol_started_and_answered_within,
        version.as_str().unwrap_or(say!(of_unknown_version)),
        protocol,
        narrator::duration(elapsed)
    ));
    narrator.say(say!(layers_die_and_holes_are_openings));
    Ok(client)
}

/// What the demonstration claims; a claim that does not hold ends it.
fn holds(claim: bool, otherwise: impl FnOnce() -> String) -> Result<(), Failure> {
    if claim {
        Ok(())
    } else {
        Err(Failure(say!(
            the_demonstration_found_something_else_than_it_claims,
            otherwise()
        )))
    }
}

/// The place of a diagnostic's segment: handle and index.
fn segment_of(diagnostic: &Value) -> (String, u64) {
    let data = &diagnostic["data"];
    (
        data["handle"].as_str().unwrap_or_default().into(),
        data["segment"].as_u64().unwrap_or_default(),
    )
}

/// The preferred quick fix among `actions`; prints all titles.
fn preferred(narrator: &mut Narrator, actions: &Value) -> Result<Value, Failure> {
    let actions = actions.as_array().map_or(&[][..], Vec::as_slice);
    for action in actions {
        let title = action["title"].as_str();
        let title = title.unwrap_or(say!(action_without_a_title));
        narrator.item(&if action["isPreferred"] == true {
            say!(the_preferred_action, title)
        } else {
            say!(another_action, title)
        });
    }
    let preferred = actions
        .iter()
        .find(|action| action["isPreferred"] == true && action["kind"] == "quickfix");
    preferred
        .cloned()
        .ok_or_else(|| Failure(say!(the_server_offers_no_preferred_fix).into()))
}
