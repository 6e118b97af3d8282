//! `wedm demo`: a whole session with a real server, played by a small client that checks all it says.
//!
//! The client is one as anybody would write it: it knows JSON-RPC and keeps its own copy of the text. Only where it
//! proves what came out does it use the library again.

mod client;
mod copy;
mod narrator;
mod plate;
mod proof;
mod punch;

use super::options::Common;
use super::{Failure, Verdict, output};
use clap::Args;
use client::Client;
use narrator::Narrator;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Play a whole session with a real server, on a drawing that ships inside
///
/// Opens the drawing of a cutting plate, edits it as a designer would, shows each diagnostic as it arrives, applies the fixes,
/// asks for the 3B program, decodes it again, and writes demo.dxf, demo.3b and demo.svg. Ends with 0 only when all that it
/// says was found to be true.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm demo
  wedm demo --correction 0.12 plate")]
pub struct Arguments {
    /// Folder that the files are written to
    #[arg(value_name = "DIR", default_value = "wedm-demo")]
    folder: PathBuf,
    #[command(flatten)]
    common: Common,
}

/// mm. Below, no fillet of the plate is too tight; above, its slots are too narrow.
const CORRECTIONS: std::ops::RangeInclusive<f64> = 0.02..=0.5;

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let correction = arguments
        .common
        .correction
        .unwrap_or(crate::settings::Settings::default().correction());
    if !CORRECTIONS.contains(&correction) {
        let (least, most) = (CORRECTIONS.start(), CORRECTIONS.end());
        return Err(Failure(format!(
            "the plate of the demonstration is made for corrections from {least} to {most} mm, found {correction}"
        )));
    }
    if arguments.common.side.is_some() || arguments.common.config.is_some() {
        return Err(Failure(
            "the demonstration brings its own settings, expected --correction alone".into(),
        ));
    }
    std::fs::create_dir_all(&arguments.folder).map_err(|error| {
        Failure(format!(
            "{} could not be made: {error}",
            arguments.folder.display()
        ))
    })?;

    let mut narrator = Narrator::default();
    narrator.heading(&format!(
        "wedm {}: a cutting plate, a correction of {correction:.3} mm, a real server",
        env!("CARGO_PKG_VERSION")
    ));
    let mut client = start(&mut narrator, correction)?;
    let made = plate::session(&mut narrator, &mut client, correction)?;
    punch::session(&mut narrator, &mut client, correction)?;
    client.end()?;

    narrator.step("The server has ended as it should. These files are yours");
    for (name, bytes, what) in [
        ("demo.dxf", made.dxf.as_bytes(), "the plate, repaired"),
        ("demo.3b", made.program.as_bytes(), "its program"),
        (
            "demo.svg",
            made.picture.as_bytes(),
            "contour, faults and wire path: open it in a browser",
        ),
    ] {
        let path = arguments.folder.join(name);
        output::write(Some(&path), bytes)?;
        narrator.say(&format!("{}  {what}", output::name(&path)));
    }
    narrator.good("Everything above was checked as it was said.");
    Ok(Verdict::Clean)
}

fn start(narrator: &mut Narrator, correction: f64) -> Result<Client, Failure> {
    narrator.step("The server starts as a child and speaks LSP over stdio");
    let begun = std::time::Instant::now();
    let mut client = Client::start()?;
    let params = json!({
        "processId": std::process::id(),
        "clientInfo": { "name": "wedm demo" },
        "rootUri": null,
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
        || format!("the server says it is {name}, protocol {protocol}"),
    )?;
    narrator.say(&format!(
        "wedm {}, protocol {protocol}; started and answered within {}",
        version.as_str().unwrap_or("of unknown version"),
        narrator::duration(elapsed)
    ));
    narrator.say("Layers DIE and HOLES are openings: the wire runs inside. PLATE is not cut.");
    Ok(client)
}

/// What the demonstration claims; a claim that does not hold ends it.
fn holds(claim: bool, otherwise: impl FnOnce() -> String) -> Result<(), Failure> {
    if claim {
        Ok(())
    } else {
        Err(Failure(format!(
            "the demonstration found something else than it claims: {}",
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

/// The preferred quick fix among `actions`; the titles of all are said.
fn preferred(narrator: &mut Narrator, actions: &Value) -> Result<Value, Failure> {
    let actions = actions.as_array().map_or(&[][..], Vec::as_slice);
    for action in actions {
        let mark = if action["isPreferred"] == true {
            "preferred: "
        } else {
            "or: "
        };
        narrator.item(&format!(
            "{mark}{}",
            action["title"].as_str().unwrap_or("without a title")
        ));
    }
    let preferred = actions
        .iter()
        .find(|action| action["isPreferred"] == true && action["kind"] == "quickfix");
    preferred
        .cloned()
        .ok_or_else(|| Failure("the server offers no preferred fix".into()))
}
