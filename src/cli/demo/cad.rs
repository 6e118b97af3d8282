//! Two sessions of a CAD program: drawings without text, splices, and edits that the server asks for.

use super::{Demo, Failure, elapsed, good, holds, list, number, otherwise, say, show};
use crate::settings::part_title;
use serde_json::{Value, json};
use std::time::Instant;

/// `tan(90° / 4)`: a quarter turn counter-clockwise.
const QUARTER: f64 = 0.414_213_562_373_095_03;

/// A punch with a slot, in which a fillet becomes too tight and is repaired.
pub(crate) fn punch(demo: &mut Demo) -> Result<(), Failure> {
    const URI: &str = "cad:punch";
    demo.step(say!(the_same_from_a_cad_program));
    // The two vertices of the fillet in the slot's right corner.
    let fillet = |r: f64| [json!([7.5, 5.0 + r, -QUARTER]), json!([7.5 - r, 5])];
    let [right, left] = fillet(2.0 * demo.correction);
    let vertices = json!([
        [0, 0],
        [12, 0],
        [12, 8],
        [7.5, 8],
        right,
        left,
        [4.7, 5, -QUARTER],
        [4.5, 5.2],
        [4.5, 8],
        [0, 8],
    ]);
    let first = demo.open(URI, Some("punch"), vertices)?.len();
    say(&say!(version_with, 1, say!(diagnostics, first)));

    let tight = 0.5 * demo.correction;
    say(&say!(two_of_its_10_vertices_are_spliced, tight));
    let splice = json!({ "start": 4, "deleteCount": 2, "insert": fillet(tight) });
    let begun = Instant::now();
    let changes = json!([{ "handle": "C1", "vertices": splice }]);
    let diagnostics = demo.change(URI, 2, changes)?;
    let count = say!(diagnostics, diagnostics.len());
    say(&say!(version_2_after_the_splice, count, elapsed(begun)));
    let mut found = diagnostics.iter();
    let found = found.find(|one| one["data"]["segment"] == 4);
    let found = found.ok_or_else(|| otherwise(diagnostics.len()))?;
    show(found, false);
    let left = demo.repair(URI, 2, found)?.len();
    holds(left == first, left)?;
    good(&say!(version_with, 3, say!(diagnostics, left)));
    demo.close(URI)
}

/// A contour that is cut twice, once as the punch and once as the plate: it does not fit, is repaired, and fits.
pub(crate) fn pair(demo: &mut Demo) -> Result<(), Failure> {
    const URI: &str = "cad:pair";
    demo.step(say!(one_contour_for_punch_and_plate));
    let correction = demo.correction;
    let settings = json!({
        "wireDiameter": 1.8 * correction,
        "gap": 0.1 * correction,
        "correction": correction,
        "pair": { "drawnAs": "punch", "clearance": correction / 10.0 },
    });
    let method = "workspace/didChangeConfiguration";
    demo.client
        .notify(method, json!({ "settings": settings }))?;
    // One corner is sharp, the others are wide enough.
    let wide = 2.0 * correction;
    let vertices = json!([
        [0, 0],
        [20.0 - wide, 0, QUARTER],
        [20, wide],
        [20, 10.0 - wide, QUARTER],
        [20.0 - wide, 10],
        [wide, 10, QUARTER],
        [0, 10.0 - wide],
    ]);
    let diagnostics = demo.open(URI, None, vertices)?;
    let binds = |all: &[Value]| {
        all.iter()
            .find(|one| one["code"] == "does-not-fit")
            .cloned()
    };
    let found = binds(&diagnostics).ok_or_else(|| otherwise(diagnostics.len()))?;
    show(&found, false);
    let fit = demo.client.request("wedm/fit", json!({ "uri": URI }))?;
    let (least, clearance) = (number(&fit["least"]), number(&fit["clearance"]));
    holds(fit["fits"] == false && least < 0.0, &fit)?;
    say(&say!(the_parts_overlap_of_a_clearance, -least, clearance));

    let left = demo.repair(URI, 1, &found)?;
    holds(binds(&left).is_none(), left.len())?;
    let fit = demo.client.request("wedm/fit", json!({ "uri": URI }))?;
    let (least, clearance) = (number(&fit["least"]), number(&fit["clearance"]));
    holds(fit["fits"] == true, &fit)?;
    say(&say!(what_is_left_of_the_clearance, least, clearance));
    let params = json!({ "uri": URI, "format": "3b" });
    let made = demo.client.request("wedm/pair", params)?;
    let programs = list(&made["programs"]);
    holds(programs.len() == 2, &made)?;
    for program in programs {
        let part = part_title(program["part"].as_str().unwrap_or_default());
        let own = number(&program["corrections"][0]);
        let blocks = say!(blocks, number(&program["blocks"]) as usize);
        good(&say!(the_program_of_a_part, part, own, blocks));
    }
    demo.close(URI)
}

impl Demo {
    /// Opens a drawing of one contour, `C1`; returns its diagnostics.
    fn open(
        &mut self,
        uri: &str,
        role: Option<&str>,
        vertices: Value,
    ) -> Result<Vec<Value>, Failure> {
        let contour = json!({ "handle": "C1", "role": role, "type": "polyline", "closed": true, "vertices": vertices });
        let drawing = json!({ "uri": uri, "version": 1, "units": "mm", "entities": [contour] });
        let params = json!({ "drawing": drawing });
        self.client.notify("wedm/didOpenDrawing", params)?;
        self.diagnostics(uri, 1)
    }

    /// Changes a drawing; returns the diagnostics of the new version.
    fn change(&mut self, uri: &str, version: i64, changes: Value) -> Result<Vec<Value>, Failure> {
        let drawing = json!({ "uri": uri, "version": version });
        let params = json!({ "drawing": drawing, "changes": changes });
        self.client.notify("wedm/didChangeDrawing", params)?;
        self.diagnostics(uri, version)
    }

    fn close(&mut self, uri: &str) -> Result<(), Failure> {
        let params = json!({ "drawing": { "uri": uri } });
        self.client.notify("wedm/didCloseDrawing", params)
    }

    /// Runs the command of the preferred fix: the server asks the CAD program to apply its edit, which it does.
    fn repair(
        &mut self,
        uri: &str,
        version: i64,
        diagnostic: &Value,
    ) -> Result<Vec<Value>, Failure> {
        let mut action = self.fix(uri, diagnostic)?;
        let command = action["command"].take();
        let id = self.client.ask("workspace/executeCommand", command)?;
        let method = "wedm/applyDrawingEdit";
        let mut asked = self.client.wait_for(|one| one["method"] == method)?;
        let edit = asked["params"]["edit"].take();
        holds(edit["version"] == version && edit["uri"] == uri, &edit)?;
        self.client.answer(&asked["id"])?;
        self.client.reply(id)?;
        say(say!(the_server_asks_for_the_edit));
        self.change(uri, version + 1, edit["changes"].clone())
    }
}
