//! The session of a CAD program: a drawing without text, splices, and an edit that the server asks for.

use super::client::Client;
use super::narrator::{Behind, Narrator, duration};
use super::{Failure, holds, preferred};
use serde_json::{Value, json};
use std::time::Instant;

const URI: &str = "cad:punch";
/// `tan(−90° / 4)`: a quarter turn clockwise.
const QUARTER: f64 = -0.414_213_562_373_095_03;

pub(crate) fn session(
    narrator: &mut Narrator,
    client: &mut Client,
    correction: f64,
) -> Result<(), Failure> {
    narrator.step(say!(the_same_from_a_cad_program));
    let wide = 2.0 * correction;
    let mut vertices = vec![
        json!([0, 0]),
        json!([12, 0]),
        json!([12, 8]),
        json!([7.5, 8]),
    ];
    vertices.extend(fillet(wide));
    vertices.extend([
        json!([4.7, 5, QUARTER]),
        json!([4.5, 5.2]),
        json!([4.5, 8]),
        json!([0, 8]),
    ]);
    let punch = json!({ "handle": "9F", "role": "punch", "type": "polyline", "closed": true, "vertices": vertices });
    let drawing = json!({ "uri": URI, "version": 1, "units": "mm", "entities": [punch] });
    client.notify("wedm/didOpenDrawing", json!({ "drawing": drawing }))?;
    let first = client.diagnostics(URI, 1)?.len();
    narrator.say(&say!(version_with, 1, say!(diagnostics, first)));

    let tight = 0.5 * correction;
    narrator.say(&say!(two_of_its_10_vertices_are_spliced, tight));
    let splice = json!({ "handle": "9F", "vertices": { "start": 4, "deleteCount": 2, "insert": fillet(tight) } });
    let begun = Instant::now();
    change(client, (URI, 2), json!([splice]))?;
    let diagnostics = client.diagnostics(URI, 2)?;
    narrator.say(&say!(
        version_2_after_the_splice,
        say!(diagnostics, diagnostics.len()),
        duration(begun.elapsed())
    ));
    let found = diagnostics
        .iter()
        .find(|diagnostic| diagnostic["data"]["segment"] == 4);
    let Some(diagnostic) = found else {
        return Err(Failure(say!(the_splice_gets_no_diagnostic).into()));
    };
    narrator.diagnostic(diagnostic, Behind::Nothing);

    let edit = ask_for_edit(narrator, client, diagnostic, (URI, 2))?;
    change(client, (URI, 3), edit["changes"].clone())?;
    let left = client.diagnostics(URI, 3)?.len();
    holds(left == first, || {
        say!(diagnostics_are_left_in_the_punch, left)
    })?;
    narrator.good(&say!(version_with, 3, say!(diagnostics, left)));
    client.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": URI } }))
}

/// The two vertices of the fillet in the slot's right corner.
fn fillet(radius: f64) -> [Value; 2] {
    [
        json!([7.5, 5.0 + radius, QUARTER]),
        json!([7.5 - radius, 5]),
    ]
}

pub(super) fn change(
    client: &mut Client,
    (uri, version): (&str, i64),
    changes: Value,
) -> Result<(), Failure> {
    client.notify(
        "wedm/didChangeDrawing",
        json!({ "drawing": { "uri": uri, "version": version }, "changes": changes }),
    )
}

/// Runs the preferred fix's command; the server asks the CAD program to apply its edit, which it does.
pub(super) fn ask_for_edit(
    narrator: &mut Narrator,
    client: &mut Client,
    diagnostic: &Value,
    (uri, version): (&str, i64),
) -> Result<Value, Failure> {
    let params = json!({
        "textDocument": { "uri": uri },
        "range": diagnostic["range"],
        "context": { "diagnostics": [diagnostic], "only": ["quickfix"] },
    });
    let actions = client.request("textDocument/codeAction", params)?;
    let action = preferred(narrator, &actions)?;
    let command = &action["command"];
    let id = client.ask(
        "workspace/executeCommand",
        json!({ "command": command["command"], "arguments": command["arguments"] }),
    )?;
    let (asked, mut params) = client.asked("wedm/applyDrawingEdit")?;
    let edit = params["edit"].take();
    holds(edit["version"] == version && edit["uri"] == uri, || {
        say!(the_edit_is, edit)
    })?;
    client.answer(&asked, json!({ "applied": true }))?;
    client.reply(id)?;
    narrator.say(say!(the_server_asks_for_the_edit));
    Ok(edit)
}
