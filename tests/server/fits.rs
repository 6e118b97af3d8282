//! `wedm/fit` after edits says what it says of a drawing that has just been opened.

use crate::support::Client;
use serde_json::{Value, json};

/// A gear of so many teeth: sharp corners, every second one rounded by half an arc.
fn gear(teeth: usize, grown: f64) -> Vec<[f64; 3]> {
    let count = teeth * 2;
    let turn = std::f64::consts::TAU / count as f64;
    let vertex = |at: usize| {
        let (sin, cos) = (at as f64 * turn).sin_cos();
        let (away, bulge) = match at % 2 {
            0 => (12.0 + grown, 0.3),
            _ => (11.0 + grown, 0.0),
        };
        [away * cos, away * sin, bulge]
    };
    (0..count).map(vertex).collect()
}

fn polyline(handle: &str, layer: &str, vertices: &[[f64; 3]]) -> Value {
    json!({ "handle": handle, "type": "polyline", "layer": layer, "closed": true, "vertices": vertices })
}

/// The outlines of a drawing, each with its handle and layer.
type Outlines = Vec<(&'static str, &'static str, Vec<[f64; 3]>)>;

fn entities(outlines: &Outlines) -> Value {
    let of =
        |(handle, layer, vertices): &(&str, &str, Vec<[f64; 3]>)| polyline(handle, layer, vertices);
    outlines.iter().map(of).collect()
}

/// Moves vertices one after the other, and asks after each edit.
fn after_each_edit(settings: &Value, mut outlines: Outlines) {
    let mut client = Client::start_with(json!({}), settings.clone());
    client.open_drawing("cad:///edited", entities(&outlines));
    // A little off its place and back, onto a neighbour, and so far away that the outline crosses itself.
    let moves = [
        (0, 0, [0.004, 0.0]),
        (0, 0, [0.0, 0.0]),
        (0, 5, [0.0, -0.02]),
        (1, 3, [0.01, 0.01]),
        (0, 7, [-25.0, 0.0]),
        (0, 7, [0.0, 0.0]),
        (1, 3, [0.0, 0.0]),
    ];
    let drawn = outlines.clone();
    let mut answered = 0;
    for (step, (outline, vertex, [x, y])) in moves.into_iter().enumerate() {
        let outline = outline % drawn.len();
        let (handle, _, vertices) = &mut outlines[outline];
        let [from_x, from_y, bulge] = drawn[outline].2[vertex];
        vertices[vertex] = [from_x + x, from_y + y, bulge];
        let insert = json!([vertices[vertex]]);
        let splice = json!([{ "handle": handle, "vertices": { "start": vertex, "deleteCount": 1, "insert": insert } }]);
        let version = 2 + step as i64;
        client.change_drawing("cad:///edited", version, splice);
        client.diagnostics("cad:///edited", version);
        let fresh = format!("cad:///fresh-{step}");
        client.open_drawing(&fresh, entities(&outlines));
        let [edited, opened] =
            ["cad:///edited", &fresh].map(|uri| client.request("wedm/fit", json!({ "uri": uri })));
        assert_eq!(
            edited.is_ok(),
            opened.is_ok(),
            "{step}: {edited:?} {opened:?}"
        );
        let (Ok(edited), Ok(opened)) = (edited, opened) else {
            continue;
        };
        answered += 1;
        for key in ["fits", "places", "alone", "least", "svg"] {
            assert_eq!(edited[key], opened[key], "{step}: {key}");
        }
    }
    assert!(answered >= 5, "{answered}");
    client.shut_down();
}

#[test]
fn a_contour_that_is_cut_twice() {
    let settings = json!({ "wire-diameter": 0.18, "gap": 0.01, "pair": { "drawn-as": "punch", "clearance": 0.01 } });
    after_each_edit(&settings, vec![("2A", "0", gear(12, 0.0))]);
}

#[test]
fn a_punch_and_a_plate_and_an_opening_without_a_punch() {
    let settings = json!({
        "wire-diameter": 0.18,
        "gap": 0.01,
        "pair": { "clearance": 0.01 },
        "workpieces": { "P": ["P"], "Q": ["Q"] },
        "layers": { "P": "punch", "Q": "opening" },
    });
    let mut lonely = gear(6, 0.0);
    lonely.iter_mut().for_each(|vertex| vertex[0] += 100.0);
    let outlines = vec![
        ("2A", "P", gear(12, 0.0)),
        ("2B", "Q", gear(12, 0.012)),
        ("2C", "Q", lonely),
    ];
    after_each_edit(&settings, outlines);
}
