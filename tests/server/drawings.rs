//! Drawings without text behind them.

use crate::support::{Client, capabilities, codes, small, tight_plate, wide_plate};
use serde_json::{Value, json};

const URI: &str = "cad:///1";

#[test]
fn a_splice_brings_the_diagnostics_of_its_version() {
    let mut client = Client::start();
    let found = client.open_drawing(URI, json!([tight_plate("2A"), wide_plate("2B")]));
    assert_eq!(codes(&found), ["small-radius"]);
    assert_eq!(
        found[0]["range"]["start"],
        json!({ "line": 2, "character": 0 })
    );
    assert_eq!(found[0]["source"], "wedm");
    let data = &found[0]["data"];
    assert_eq!(
        (&data["handle"], &data["segment"], &data["required"]),
        (&json!("2A"), &json!(2), &json!(0.1))
    );
    assert!(
        (data["radius"].as_f64().unwrap() - 0.05).abs() < 1e-9,
        "{data}"
    );
    let splice = |x: f64| json!([{ "handle": "2A", "vertices": { "start": 2, "deleteCount": 2, "insert": [[10, 10.0 - x, 0.41421356237309503], [10.0 - x, 10]] } }]);
    client.change_drawing(URI, 2, splice(0.5));
    assert_eq!(client.diagnostics(URI, 2).len(), 0);
    client.change_drawing(URI, 3, splice(0.06));
    assert_eq!(client.diagnostics(URI, 3).len(), 1);
    client.change_drawing(URI, 4, json!([{ "handle": "2A", "entity": null }]));
    assert_eq!(client.diagnostics(URI, 4).len(), 0);
    client.change_drawing(
        URI,
        9,
        json!([{ "handle": "2A", "entity": tight_plate("2A"), "before": "2B" }]),
    );
    assert_eq!(client.diagnostics(URI, 9).len(), 1);
    let list = client
        .request("wedm/inspect", json!({ "uri": URI }))
        .unwrap();
    let handles: Vec<&str> = list["entities"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|entity| entity["handle"].as_str())
        .collect();
    assert_eq!(handles, ["2A", "2B"]);
    client.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": URI } }));
    assert_eq!(
        client.published(URI),
        json!({ "uri": URI, "diagnostics": [] })
    );
    assert_eq!(client.code("wedm/inspect", json!({ "uri": URI })), -32602);
    client.shut_down();
}

#[test]
fn an_empty_change_and_an_unchanged_version_are_published_too() {
    let mut client = Client::start();
    assert_eq!(client.open_drawing(URI, json!([])).len(), 0);
    client.change_drawing(URI, 2, json!([]));
    assert_eq!(client.diagnostics(URI, 2).len(), 0);
    client.shut_down();
}

/// Sends a change that cannot apply, sees it refused, and the drawing as it was.
#[test]
fn a_change_that_cannot_apply_changes_nothing_and_asks_for_the_drawing() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([tight_plate("2A"), { "handle": "L", "type": "line", "start": [50, 0], "end": [60, 0] }]));
    let before = client
        .request("wedm/inspect", json!({ "uri": URI }))
        .unwrap();
    let mut check = |version: i64, changes: Value, reason: &str| {
        client.change_drawing(URI, version, changes);
        client.logged(reason);
        let asked = client.asked("wedm/resendDrawing");
        assert_eq!(asked.params, json!({ "uri": URI }));
        client.respond(&asked, Value::Null);
        client.logged("was not sent again");
        assert_eq!(
            client
                .request("wedm/inspect", json!({ "uri": URI }))
                .unwrap(),
            before,
            "{reason}"
        );
    };
    let splice = |start: Value, count: Value, insert: Value| json!({ "handle": "2A", "vertices": { "start": start, "deleteCount": count, "insert": insert } });
    let good = splice(json!(0), json!(1), json!([[0, 0.5]]));
    check(
        2,
        json!([splice(json!(6), json!(0), json!([]))]),
        "vertices 6 + 0 are out of range",
    );
    check(
        2,
        json!([splice(json!(u64::MAX), json!(u64::MAX), json!([]))]),
        "out of range",
    );
    check(
        2,
        json!([splice(json!(-1), json!(1), json!([]))]),
        "does not apply",
    );
    check(
        2,
        json!([good, splice(json!(0), json!(9), json!([]))]),
        "change 1: vertices 0 + 9 are out of range",
    );
    check(
        2,
        json!([good, { "handle": "nobody", "vertices": { "start": 0, "deleteCount": 0, "insert": [] } }]),
        "there is no entity nobody",
    );
    check(
        2,
        json!([good, { "handle": "nobody", "entity": null }]),
        "there is no entity nobody to delete",
    );
    check(
        2,
        json!([{ "handle": "L", "vertices": { "start": 0, "deleteCount": 1, "insert": [] } }]),
        "entity L is not a polyline",
    );
    check(
        2,
        json!([splice(json!(0), json!(1), json!([[null, 0]]))]),
        "vertex 0 to insert in 2A has a number that is not finite",
    );
    check(
        2,
        json!([splice(json!(0), json!(1), json!([["NaN", 0]]))]),
        "vertex 0 to insert in 2A has a number that is not finite",
    );
    check(
        2,
        json!([{ "handle": "L", "entity": { "handle": "L", "type": "circle", "center": [0, 0], "radius": -1 } }]),
        "radius is -1",
    );
    check(2, json!([{ "handle": "L" }]), "both or neither");
    check(1, json!([good]), "version 1 is not newer than 1");
    check(0, json!([good]), "version 0 is not newer than 1");
    check(2, json!("no list"), "does not apply");
    // The drawing goes on with the next change that fits.
    client.change_drawing(URI, 2, json!([good]));
    assert_eq!(small(&client.diagnostics(URI, 2)), 1);
    client.shut_down();
}

#[test]
fn numbers_that_overflow_are_refused_like_any_that_are_none() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([tight_plate("2A")]));
    let body = r#"{"jsonrpc":"2.0","method":"wedm/didChangeDrawing","params":{"drawing":{"uri":"cad:///1","version":2},"changes":[{"handle":"2A","vertices":{"start":0,"deleteCount":1,"insert":[[1e999,0]]}}]}}"#;
    client.send_bytes(&crate::support::frame(body));
    client.logged("vertex 0 to insert in 2A has a number that is not finite");
    let asked = client.asked("wedm/resendDrawing");
    client.respond(&asked, json!({ "drawing": { "uri": URI, "version": 2, "units": "mm", "entities": [wide_plate("2A")] } }));
    assert_eq!(client.diagnostics(URI, 2).len(), 0);
    client.shut_down();
}

#[test]
fn an_unsound_drawing_is_not_opened_and_asked_for_again() {
    let mut client = Client::start();
    let mut check = |uri: &str, entities: Value, reason: &str| {
        client.notify(
            "wedm/didOpenDrawing",
            json!({ "drawing": { "uri": uri, "version": 1, "entities": entities } }),
        );
        client.logged(reason);
        let asked = client.asked("wedm/resendDrawing");
        assert_eq!(
            client.code("wedm/inspect", json!({ "uri": uri })),
            -32602,
            "{reason}"
        );
        client.respond(
            &asked,
            json!({ "drawing": { "uri": uri, "version": 7, "entities": [tight_plate("2A")] } }),
        );
        assert_eq!(client.diagnostics(uri, 7).len(), 1);
    };
    check(
        "cad:///doubled",
        json!([tight_plate("2A"), wide_plate("2A")]),
        "handle 2A is repeated",
    );
    check(
        "cad:///null",
        json!([{ "handle": "1", "type": "line", "start": [0, null], "end": [1, 1] }]),
        "entity 1: start is not two finite numbers",
    );
    check(
        "cad:///nan",
        json!([{ "handle": "1", "type": "line", "start": [0, 0], "end": ["NaN", 1] }]),
        "entity 1: end is not two finite numbers",
    );
    check(
        "cad:///radius",
        json!([{ "handle": "1", "type": "circle", "center": [0, 0], "radius": 0 }]),
        "entity 1: radius is 0",
    );
    check(
        "cad:///type",
        json!([{ "handle": "1", "type": "spline" }]),
        "type is \"spline\"",
    );
    check("cad:///list", json!({}), "is not sound");
    client.shut_down();
}

#[test]
fn a_change_of_a_drawing_that_is_not_open_asks_for_it() {
    let mut client = Client::start();
    client.change_drawing("cad:///late", 5, json!([]));
    client.logged("no such drawing is open");
    let asked = client.asked("wedm/resendDrawing");
    client.respond(&asked, json!({ "drawing": { "uri": "cad:///late", "version": 5, "entities": [tight_plate("2A")] } }));
    assert_eq!(client.diagnostics("cad:///late", 5).len(), 1);
    // A text is no drawing.
    client.open_text("file:///a.dxf", "dxf", "0\nEOF\n");
    client.change_drawing("file:///a.dxf", 5, json!([]));
    client.logged("no such drawing is open");
    client.shut_down();
}

#[test]
fn a_drawing_is_asked_for_once_at_a_time_and_only_where_that_was_declared() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([tight_plate("2A")]));
    (0..20).for_each(|_| client.change_drawing(URI, 0, json!([])));
    let asked = client.asked("wedm/resendDrawing");
    let again = client
        .settle()
        .iter()
        .filter(|message| message["method"] == "wedm/resendDrawing")
        .count();
    assert_eq!(again, 0);
    client.respond(
        &asked,
        json!({ "drawing": { "uri": URI, "version": 3, "entities": [] } }),
    );
    assert_eq!(client.diagnostics(URI, 3).len(), 0);
    client.change_drawing(URI, 0, json!([]));
    let asked = client.asked("wedm/resendDrawing");
    // Closed while the answer is on its way: it stays closed.
    client.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": URI } }));
    client.respond(
        &asked,
        json!({ "drawing": { "uri": URI, "version": 9, "entities": [] } }),
    );
    assert_eq!(client.code("wedm/inspect", json!({ "uri": URI })), -32602);
    client.shut_down();

    let mut without = capabilities();
    without["experimental"] = Value::Null;
    let mut client = Client::start_with(without, json!({}));
    client.open_drawing(URI, json!([]));
    client.change_drawing(URI, 0, json!([]));
    client.logged("version 0 is not newer");
    assert!(
        client
            .settle()
            .iter()
            .all(|message| message["method"] != "wedm/resendDrawing")
    );
    client.shut_down();
}

#[test]
fn opening_what_is_open_replaces_it_and_says_so() {
    let mut client = Client::start();
    assert_eq!(
        client.open_drawing(URI, json!([tight_plate("2A")])).len(),
        1
    );
    assert_eq!(client.open_drawing(URI, json!([])).len(), 0);
    client.logged("was already open");
    // A text and a drawing with one name are one document.
    client.open_text(URI, "dxf", "0\nEOF\n");
    client.logged("was already open");
    client.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": URI } }));
    client.logged("was closed without being open");
    client.shut_down();
}

#[test]
fn each_opening_and_each_closing_is_published() {
    let mut client = Client::start();
    for round in 1..=50 {
        client.notify(
            "wedm/didOpenDrawing",
            json!({ "drawing": { "uri": URI, "version": round, "entities": [tight_plate("2A")] } }),
        );
        client.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": URI } }));
    }
    for round in 1..=50 {
        assert_eq!(client.published(URI)["version"], round);
        assert_eq!(
            client.published(URI),
            json!({ "uri": URI, "diagnostics": [] })
        );
    }
    client.shut_down();
}

#[test]
fn a_publish_holds_five_hundred_findings_and_the_count_of_the_others() {
    let mut client = Client::start();
    let plates: Vec<Value> = (0..1200)
        .map(|index| {
            let mut plate = tight_plate(&format!("H{index}"));
            for vertex in plate["vertices"].as_array_mut().unwrap() {
                vertex[0] = json!(vertex[0].as_f64().unwrap() + 20.0 * f64::from(index));
            }
            plate
        })
        .collect();
    let found = client.open_drawing(URI, json!(plates));
    assert_eq!(found.len(), 501);
    assert!(
        found[..500]
            .iter()
            .all(|finding| finding["code"] == "small-radius")
    );
    let more = &found[500];
    assert_eq!(
        (&more["code"], &more["severity"], &more["data"]["count"]),
        (&json!("more"), &json!(3), &json!(700))
    );
    assert_eq!(more["range"]["start"], json!({ "line": 0, "character": 0 }));
    let list = client
        .request("wedm/inspect", json!({ "uri": URI }))
        .unwrap();
    let faulty = list["entities"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|entity| entity["segments"].as_array().unwrap());
    assert_eq!(
        faulty
            .filter(|segment| segment["verdict"] == "small-radius")
            .count(),
        1200
    );
    client.shut_down();
}

#[test]
fn inches_and_roles_are_heeded() {
    let mut client = Client::start();
    // R 0.005 inch is 0.127 mm, R 0.003 inch is 0.076 mm.
    let square = |handle: &str, radius: f64, role: &str| {
        json!({ "handle": handle, "role": role, "type": "polyline", "closed": true,
            "vertices": [[0, 0], [1, 0], [1, 1.0 - radius, 0.41421356237309503], [1.0 - radius, 1], [0, 1]] })
    };
    let mut check = |version: i64, radius: f64, role: &str, expected: usize| {
        let entities = json!([square("1", radius, role)]);
        client
            .notify("wedm/didOpenDrawing", json!({ "drawing": { "uri": URI, "version": version, "units": "inch", "entities": entities } }));
        assert_eq!(
            small(&client.diagnostics(URI, version)),
            expected,
            "{radius} {role}"
        );
    };
    check(1, 0.005, "both", 0);
    check(2, 0.003, "both", 1);
    check(3, 0.003, "opening", 1);
    check(4, 0.003, "punch", 0);
    check(5, 0.003, "ignore", 0);
    client.shut_down();
}

#[test]
fn the_other_segment_is_told_to_clients_that_show_it() {
    let lines = json!([
        { "handle": "L1", "type": "polyline", "closed": true, "vertices": [[0, 0], [4, 4], [4, 0], [0, 4]] },
    ]);
    let crossing = |client: &mut Client| {
        let found = client.open_drawing(URI, lines.clone());
        let crossing = found
            .iter()
            .find(|finding| finding["code"] == "self-intersection")
            .cloned();
        crossing.unwrap_or_else(|| panic!("{found:?}"))
    };
    let mut client = Client::start();
    let found = crossing(&mut client);
    assert_eq!(found["relatedInformation"], Value::Null);
    assert_eq!(
        found["data"]["related"],
        json!([{ "handle": "L1", "segment": 2 }])
    );
    client.shut_down();
    let mut able = capabilities();
    able["textDocument"] = json!({ "publishDiagnostics": { "relatedInformation": true } });
    let mut client = Client::start_with(able, json!({}));
    let place = json!({ "line": 2, "character": 0 });
    assert_eq!(
        crossing(&mut client)["relatedInformation"],
        json!([{ "location": { "uri": URI, "range": { "start": place, "end": place } }, "message": "crosses this one: L1, segment 2" }])
    );
    client.shut_down();
}
