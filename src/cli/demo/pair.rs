//! A contour that is cut twice, once as the punch and once as the plate: it does not fit, is repaired, and fits.

use super::client::Client;
use super::narrator::{Behind, Narrator};
use super::punch::{ask_for_edit, change};
use super::{Failure, holds};
use crate::settings::part_title;
use serde_json::{Value, json};

const URI: &str = "cad:pair";
/// `tan(90° / 4)`: a quarter turn counter-clockwise.
const QUARTER: f64 = 0.414_213_562_373_095_03;

pub(crate) fn session(
    narrator: &mut Narrator,
    client: &mut Client,
    correction: f64,
) -> Result<(), Failure> {
    narrator.step(say!(one_contour_for_punch_and_plate));
    let clearance = correction / 10.0;
    let settings = json!({
        "wireDiameter": 1.8 * correction,
        "gap": 0.1 * correction,
        "correction": correction,
        "pair": { "drawnAs": "punch", "clearance": clearance },
    });
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": settings }),
    )?;
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
    let contour =
        json!({ "handle": "C1", "type": "polyline", "closed": true, "vertices": vertices });
    let drawing = json!({ "uri": URI, "version": 1, "units": "mm", "entities": [contour] });
    client.notify("wedm/didOpenDrawing", json!({ "drawing": drawing }))?;
    let diagnostics = client.diagnostics(URI, 1)?;
    let Some(diagnostic) = diagnostics.iter().find(|one| one["code"] == "does-not-fit") else {
        return Err(Failure(say!(the_pair_that_binds_gets_no_diagnostic).into()));
    };
    narrator.diagnostic(diagnostic, Behind::Nothing);
    let least = fit(narrator, client, false)?;
    holds(least < 0.0, || say!(the_fit_is_of, least))?;

    let edit = ask_for_edit(narrator, client, diagnostic, (URI, 1))?;
    change(client, (URI, 2), edit["changes"].clone())?;
    let left = client.diagnostics(URI, 2)?;
    let binds = left.iter().any(|one| one["code"] == "does-not-fit");
    holds(!binds, || {
        say!(diagnostics_are_left_in_the_punch, left.len())
    })?;
    fit(narrator, client, true)?;
    let made = client.request("wedm/pair", json!({ "uri": URI, "format": "3b" }))?;
    let programs = made["programs"].as_array().map_or(&[][..], Vec::as_slice);
    holds(programs.len() == 2, || say!(programs, programs.len()))?;
    for program in programs {
        let part = program["part"].as_str().unwrap_or_default();
        let blocks = program["blocks"].as_u64().unwrap_or_default() as usize;
        let own = program["corrections"][0].as_f64().unwrap_or(f64::NAN);
        narrator.good(&say!(
            the_program_of_a_part,
            part_title(part),
            own,
            say!(blocks, blocks)
        ));
    }
    client.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": URI } }))
}

/// Asks whether punch and plate fit, checks the answer, and returns the remaining clearance, mm.
fn fit(narrator: &mut Narrator, client: &mut Client, fits: bool) -> Result<f64, Failure> {
    let fit: Value = client.request("wedm/fit", json!({ "uri": URI }))?;
    let number = |key: &str| fit[key].as_f64().unwrap_or(f64::NAN);
    let (least, clearance) = (number("least"), number("clearance"));
    holds(fit["fits"] == fits, || say!(the_fit_is_of, least))?;
    narrator.say(&match least < 0.0 {
        true => say!(the_parts_overlap_of_a_clearance, -least, clearance),
        false => say!(what_is_left_of_the_clearance, least, clearance),
    });
    Ok(least)
}
