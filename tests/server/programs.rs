//! Lists, contours, paths, pictures and programs of a drawing.

use crate::support::{Client, tight_plate, wide_plate};
use serde_json::{Value, json};

const URI: &str = "cad:///1";

#[test]
fn a_drawing_with_errors_is_refused_with_the_list_unless_forced() {
    let mut client = Client::start_with(crate::support::capabilities(), json!({ "side": "punch" }));
    // Concave to the wire outside: a dent in the square's side.
    let dent = json!({ "handle": "2A", "type": "polyline", "closed": true,
        "vertices": [[0, 0], [10, 0], [10, 10], [5.05, 10, -1], [4.95, 10], [0, 10]] });
    assert_eq!(client.open_drawing(URI, json!([dent])).len(), 1);
    let error = client
        .request("wedm/generate", json!({ "uri": URI, "format": "3b" }))
        .unwrap_err();
    assert_eq!(error["code"], -32803);
    assert_eq!(error["data"]["diagnostics"][0]["data"]["handle"], "2A");
    client.shut_down();
}

/// Errors of contours that are not cut do not stand in the way of those that are.
#[test]
fn only_what_is_cut_refuses_a_program() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([tight_plate("2A"), wide_plate("2B")]));
    let mut generate = |handles: Value| {
        let params = json!({ "uri": URI, "format": "3b", "handles": handles, "options": { "side": "opening" } });
        client.request("wedm/generate", params)
    };
    assert_eq!(generate(json!(["2B"])).unwrap()["warnings"], json!([]));
    for handles in [json!(null), json!(["2A"]), json!(["2B", "2A"])] {
        assert_eq!(
            generate(handles).unwrap_err()["data"]["diagnostics"][0]["data"]["handle"],
            "2A"
        );
    }
    let on_a_layer = |handle: &str, layer: &str| {
        let mut plate = if handle == "2A" {
            tight_plate(handle)
        } else {
            wide_plate(handle)
        };
        plate["layer"] = layer.into();
        plate
    };
    client.open_drawing(
        "cad:///layers",
        json!([on_a_layer("2A", "ROUGH"), on_a_layer("2B", "FINE")]),
    );
    let mut generate = |layers: Value| {
        let params = json!({ "uri": "cad:///layers", "format": "3b", "layers": layers, "options": { "side": "opening" } });
        client.request("wedm/generate", params)
    };
    assert_eq!(generate(json!(["FINE"])).unwrap()["warnings"], json!([]));
    let error = generate(json!(["FINE", "ROUGH"])).unwrap_err();
    assert_eq!(error["data"]["diagnostics"][0]["data"]["handle"], "2A");
    let error = generate(json!(["NONE"])).unwrap_err();
    assert!(
        error["message"].as_str().unwrap().contains("\"NONE\""),
        "{error}"
    );
    client.shut_down();
}

#[test]
fn a_program_is_handed_out_with_its_proof() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([wide_plate("2A")]));
    let options = json!({ "side": "opening" });
    let program = client
        .request(
            "wedm/generate",
            json!({ "uri": URI, "format": "3b", "options": options }),
        )
        .unwrap();
    let text = program["program"].as_str().unwrap();
    assert!(text.trim_end().ends_with("DD"), "{text}");
    assert_eq!(
        program["blocks"].as_u64().unwrap() as usize,
        text.lines().filter(|line| line.starts_with('B')).count()
    );
    assert!(program["length"].as_f64().unwrap() > 30.0);
    for axis in ["x", "y"] {
        assert!(program["closure"][axis].as_f64().unwrap().abs() < 10.0);
    }
    assert_eq!(program["warnings"], json!([]));
    client.shut_down();
}

#[test]
fn what_cannot_be_asked_for_is_refused_and_what_can_is_named() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([wide_plate("2A")]));
    let mut check = |params: Value, code: i64, message: &str| {
        let error = client.request("wedm/generate", params).unwrap_err();
        assert_eq!(error["code"], code, "{error}");
        assert!(
            error["message"].as_str().unwrap().contains(message),
            "{error}"
        );
    };
    check(
        json!({ "uri": URI, "format": "5x" }),
        -32602,
        "expected \"3b\"",
    );
    check(json!({ "uri": URI, "format": "step" }), -32602, "\"iso\"");
    let options = json!({ "side": "opening", "program": { "profile": "none" } });
    check(
        json!({ "uri": URI, "format": "iso", "options": options }),
        -32602,
        "expected fast-wire, generic, robofil",
    );
    check(json!({ "uri": URI }), -32602, "format");
    check(
        json!({ "uri": "cad:///none", "format": "3b" }),
        -32602,
        "is not open",
    );
    check(
        json!({ "uri": URI, "format": "3b" }),
        -32803,
        "side of contour 1 (2A) at",
    );
    check(
        json!({ "uri": URI, "format": "3b", "handles": ["ZZ"] }),
        -32602,
        "there is no entity ZZ",
    );
    check(
        json!({ "uri": URI, "format": "3b", "options": { "correction": -1 } }),
        -32602,
        "correction is -1",
    );
    check(
        json!({ "uri": URI, "format": "3b", "options": { "colour": 1 } }),
        -32602,
        "colour is not known",
    );
    let error = client
        .request("wedm/simulate", json!({ "uri": URI }))
        .unwrap_err();
    assert_eq!(error["code"], -32803);
    assert!(
        error["message"]
            .as_str()
            .unwrap()
            .contains("expected a program"),
        "{error}"
    );
    assert_eq!(
        client.code("wedm/simulate", json!({ "uri": "file:///none.3b" })),
        -32602
    );
    client.open_drawing("cad:///empty", json!([]));
    assert_eq!(
        client.code(
            "wedm/generate",
            json!({ "uri": "cad:///empty", "format": "3b" })
        ),
        -32803
    );
    client.shut_down();
}

/// The finding that refuses a program of DXF text stands where the text has its number.
#[test]
fn what_refuses_a_program_of_text_has_its_place_in_the_text() {
    let mut client = Client::start();
    let text = crate::support::dxf_of(&[(
        "2A",
        &[
            [2.5, 0.0, 0.0],
            [9.5, 0.0, 0.414213562373],
            [10.0, 0.5, 0.0],
            [10.0, 5.75, 0.41421356237309503],
            [5.75, 10.0, 0.41421356237309503],
            [1.5, 5.75, 0.0],
            [1.5, 1.0, 0.41421356237309503],
        ],
    )]);
    assert_eq!(
        client.open_text("untitled:a.dxf", "dxf", &text),
        Vec::<Value>::new()
    );
    let mut check = |method: &str, options: Value, rule: &str, expected: &str| {
        let error = client
            .request(
                method,
                json!({ "uri": "untitled:a.dxf", "format": "3b", "options": options }),
            )
            .unwrap_err();
        let diagnostic = &error["data"]["diagnostics"][0];
        assert_eq!(diagnostic["code"], rule, "{error}");
        let line = diagnostic["range"]["start"]["line"].as_u64().unwrap() as usize;
        assert_eq!(
            text.lines().nth(line).map(str::trim),
            Some(expected),
            "{error}"
        );
    };
    check(
        "wedm/generate",
        json!({ "side": "opening", "correction": 0.6 }),
        "small-radius",
        "0.414213562373",
    );
    let outside = json!({ "side": "opening", "program": { "thread": [5, -5] } });
    check("wedm/generate", outside.clone(), "lead-in", "2.5");
    check("wedm/toolpath", outside, "lead-in", "2.5");
    client.shut_down();
}

#[test]
fn options_hold_for_their_request_alone() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([wide_plate("2A")]));
    let path = |client: &mut Client, options: Value| {
        client.request("wedm/toolpath", json!({ "uri": URI, "options": options }))
    };
    let narrow = path(&mut client, json!({ "side": "opening" })).unwrap();
    let wide = path(&mut client, json!({ "side": "opening", "correction": 0.3 })).unwrap();
    assert_eq!(
        (
            &narrow["paths"][0]["correction"],
            &wide["paths"][0]["correction"]
        ),
        (&json!(0.1), &json!(0.3))
    );
    assert_eq!(narrow["paths"][0]["segments"][0]["source"], "lead-in");
    // A correction that puts the arc at fault refuses the program, and the drawing stays without faults.
    let error = client
        .request("wedm/generate", json!({ "uri": URI, "format": "3b", "options": { "side": "opening", "correction": 0.6 } }))
        .unwrap_err();
    assert_eq!(error["data"]["diagnostics"][0]["data"]["required"], 0.6);
    assert_eq!(path(&mut client, Value::Null).unwrap_err()["code"], -32803);
    client.shut_down();
}

#[test]
fn contours_tell_what_is_chained_to_what() {
    let mut client = Client::start();
    let line = |handle: &str, start: [f64; 2], end: [f64; 2]| json!({ "handle": handle, "type": "line", "start": start, "end": end });
    client.open_drawing(
        URI,
        json!([
            line("1", [0.0, 0.0], [10.0, 0.0]),
            line("2", [10.0, 5.0], [10.0, 0.005]),
            line("3", [10.0, 5.0], [0.0, 0.0]),
            { "handle": "4", "type": "circle", "center": [50, 0], "radius": 2 },
        ]),
    );
    let contours = client
        .request("wedm/contours", json!({ "uri": URI }))
        .unwrap();
    assert_eq!(contours["unitsToMm"], 1.0);
    let [triangle, circle] = contours["contours"].as_array().unwrap().as_slice() else {
        panic!("{contours}")
    };
    assert_eq!(
        (
            &triangle["closed"],
            &triangle["direction"],
            &triangle["role"]
        ),
        (&json!(true), &json!("ccw"), &json!("both"))
    );
    let reversed: Vec<&Value> = triangle["segments"]
        .as_array()
        .unwrap()
        .iter()
        .map(|segment| &segment["reversed"])
        .collect();
    assert_eq!(reversed, [false, true, false]);
    assert_eq!(triangle["gaps"].as_array().unwrap().len(), 1);
    assert!((triangle["gaps"][0]["distance"].as_f64().unwrap() - 0.005).abs() < 1e-12);
    assert!((circle["area"].as_f64().unwrap() - 4.0 * std::f64::consts::PI).abs() < 1e-9);
    assert_eq!(circle["segments"][0]["kind"], "circle");
    client.shut_down();
}

#[test]
fn the_list_may_be_of_one_entity() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([tight_plate("2A"), wide_plate("2B")]));
    let list = client
        .request("wedm/inspect", json!({ "uri": URI, "handle": "2B" }))
        .unwrap();
    assert_eq!(
        (
            list["entities"].as_array().unwrap().len(),
            &list["entities"][0]["handle"]
        ),
        (1, &json!("2B"))
    );
    assert_eq!(
        client.code("wedm/inspect", json!({ "uri": URI, "handle": "nobody" })),
        -32602
    );
    client.shut_down();
}

#[test]
fn a_picture_is_svg_whether_a_path_can_be_made_or_not() {
    let mut client = Client::start();
    client.open_drawing(URI, json!([tight_plate("2A")]));
    for options in [Value::Null, json!({ "side": "opening" })] {
        let picture = client
            .request("wedm/picture", json!({ "uri": URI, "options": options }))
            .unwrap();
        assert!(picture["svg"].as_str().unwrap().starts_with("<svg"));
    }
    client.shut_down();
}

/// A comb of `teeth` rounded teeth: four arcs and four lines each.
fn comb(teeth: u32) -> Value {
    let mut vertices = vec![json!([0, -5])];
    let bulge = 0.41421356237309503;
    vertices.push(json!([f64::from(teeth) * 2.0, -5]));
    for tooth in (0..teeth).rev() {
        let x = f64::from(tooth) * 2.0;
        for [dx, dy, b] in [
            [2.0, 0.2, bulge],
            [1.8, 0.4, 0.0],
            [1.4, 0.4, bulge],
            [1.2, 0.2, 0.0],
            [1.2, -0.2, -bulge],
            [1.0, -0.4, 0.0],
            [0.4, -0.4, -bulge],
            [0.2, -0.2, 0.0],
        ] {
            vertices.push(json!([x + dx, dy, b]));
        }
    }
    json!({ "handle": "C", "role": "punch", "type": "polyline", "closed": true, "vertices": vertices })
}

#[test]
fn a_long_request_reports_progress_may_be_cancelled_and_ends_when_the_drawing_moves_on() {
    let mut client = Client::start();
    let found = client.open_drawing(URI, json!([comb(4000)]));
    assert!(
        found.iter().all(|finding| finding["severity"] != 1),
        "no error refuses the program"
    );
    let generate = |client: &mut Client, token: &str| {
        client.ask(
            "wedm/generate",
            json!({ "uri": URI, "format": "3b", "workDoneToken": token }),
        )
    };
    // Whole.
    let whole = generate(&mut client, "whole");
    assert!(client.answer(whole).unwrap()["blocks"].as_u64().unwrap() > 30_000);
    let mut kinds = Vec::new();
    while kinds.last() != Some(&json!("end")) {
        let told = client.told("$/progress");
        assert_eq!(told["token"], "whole");
        kinds.push(told["value"]["kind"].clone());
    }
    assert_eq!(kinds[0], "begin");
    assert!(kinds.contains(&json!("report")));
    // Cancelled: answered at once, whatever the worker still does.
    let cancelled = generate(&mut client, "cancelled");
    client.notify("$/cancelRequest", json!({ "id": cancelled }));
    assert_eq!(client.answer(cancelled).unwrap_err()["code"], -32800);
    // Changed meanwhile.
    let outdated = generate(&mut client, "outdated");
    client.change_drawing(URI, 2, json!([{ "handle": "C", "vertices": { "start": 0, "deleteCount": 1, "insert": [[0, -6]] } }]));
    assert_eq!(client.answer(outdated).unwrap_err()["code"], -32801);
    client.shut_down();
}

/// A program is followed, drawn and repaired as a drawing is.
#[test]
fn a_program_is_followed_drawn_and_repaired() {
    let mut client = Client::start();
    let uri = "file:///a/hole.3b";
    let text = "; Start Point = 1.000 , 2.000\nN1: B9900B0B9900GXL1\nN2: B9900B0B39600GYNR1\nD\nN3: B9900B0B9900GXL3\nDD\n";
    assert_eq!(client.open_text(uri, "3b", text), Vec::<Value>::new());
    let simulation = client
        .request("wedm/simulate", json!({ "uri": uri, "feed": 2.0 }))
        .unwrap();
    assert_eq!(simulation["blocks"].as_array().unwrap().len(), 5);
    assert_eq!(
        simulation["blocks"][1],
        json!({ "line": 2, "number": 2, "kind": "arc", "start": [10900.0, 2000.0], "end": [10900.0, 2000.0],
            "idealEnd": [10900.0, 2000.0], "deviation": 0.0, "center": [1000.0, 2000.0], "radius": 9900.0, "sweep": 360.0, "contour": 0 })
    );
    assert_eq!(simulation["blocks"][2]["kind"], "pause");
    assert_eq!(simulation["blocks"][3]["contour"], 1);
    assert_eq!(simulation["closure"], json!({ "x": 0.0, "y": 0.0 }));
    assert_eq!(
        simulation["bounds"],
        json!({ "min": [-8900.0, -7900.0], "max": [10900.0, 11900.0] })
    );
    let length = 2.0 * 9.9 + std::f64::consts::TAU * 9.9;
    assert!((simulation["length"].as_f64().unwrap() - length).abs() < 1e-6);
    assert!((simulation["minutes"].as_f64().unwrap() - length / 2.0).abs() < 1e-6);
    let svg = client
        .request("wedm/picture", json!({ "uri": uri }))
        .unwrap()["svg"]
        .as_str()
        .unwrap()
        .to_owned();
    for line in [1, 2, 4] {
        assert!(
            svg.contains(&format!("data-line=\"{line}\"")),
            "{line}: {svg}"
        );
    }

    let found = client.open_text(
        "file:///a/length.3b",
        "3b",
        "B3000B4000B5000GYL1\nB3000B4000B4000GYL4\nB6000B0B6000GXL3\nDD\n",
    );
    let codes: Vec<_> = found
        .iter()
        .map(|found| found["code"].as_str().unwrap())
        .collect();
    assert_eq!(codes, ["length-in-j", "not-closed"]);
    let position = json!({ "line": 0, "character": 12 });
    let params = json!({ "textDocument": { "uri": "file:///a/length.3b" }, "range": { "start": position, "end": position },
        "context": { "diagnostics": [found[0]], "only": ["quickfix", "source"] } });
    let actions = client.request("textDocument/codeAction", params).unwrap();
    let titles: Vec<_> = actions
        .as_array()
        .unwrap()
        .iter()
        .map(|action| action["title"].as_str().unwrap())
        .collect();
    assert_eq!(
        titles,
        ["Set J to 4000", "Fix all that can be fixed safely"]
    );
    let edit = actions[0]["edit"]["documentChanges"][0]["edits"][0].clone();
    assert_eq!(edit["newText"], "4000");
    assert_eq!(
        edit["range"]["start"],
        json!({ "line": 0, "character": 11 })
    );
    client.shut_down();
}

/// Layers, feeds and the simulated wear stand beside the program of an electrode.
#[test]
fn an_electrode_mills_a_slot() {
    let mut client = Client::start();
    let slot = json!({ "handle": "2A", "type": "line", "start": [0, 0], "end": [10, 0] });
    client.open_drawing(URI, json!([slot]));
    let mut generate = |milling: Value| {
        let params = json!({ "uri": URI, "format": "milling", "options": { "milling": milling } });
        client.request("wedm/generate", params)
    };
    let electrode =
        json!({ "toolDiameter": 1, "gap": 0.05, "layer": 0.01, "depth": 0.2, "wear": 0.02 });
    let made = generate(electrode).unwrap();
    assert_eq!(made["milling"]["layers"], 20);
    let contour = &made["milling"]["contours"][0];
    assert_eq!(contour["contour"], "2A");
    let near = |value: &Value, expected: f64| (value.as_f64().unwrap() - expected).abs() < 6e-5;
    assert!(near(&contour["wearOfLayer"], 0.28011), "{contour}");
    assert!(near(&contour["feed"], 0.0128011), "{contour}");
    assert!(near(&contour["depth"], 0.2010), "{contour}");
    assert!(near(&contour["floor"]["least"], 0.1997), "{contour}");
    assert!(near(&contour["floor"]["most"], 0.2025), "{contour}");
    assert_eq!((made.get("threadHole"), &made["holes"]), (None, &json!([])));
    assert!(made["program"].as_str().unwrap().contains("G01 Z-0.013\n"));
    // An option that does not fit.
    let error = generate(json!({ "toolDiameter": 1, "gap": 0.05 })).unwrap_err();
    assert_eq!(error["code"], -32602);
    let sentence = error["message"].as_str().unwrap();
    assert!(
        sentence.contains("milling.layer, milling.depth, milling.wear"),
        "{sentence}"
    );
    client.shut_down();
}
