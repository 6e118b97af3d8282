//! What editors ask about the text of ISO programs, over the real process.

use crate::support::{Client, capabilities};
use serde_json::{Value, json};

const URI: &str = "file:///hole.iso";

fn start() -> Client {
    let mut all = capabilities();
    all["textDocument"] = json!({
        "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
        "codeAction": { "disabledSupport": true },
        "completion": { "completionItem": { "snippetSupport": true } },
    });
    all["workspace"]["applyEdit"] = json!(true);
    all["experimental"]["wedm"]["codeLens"] = json!(true);
    Client::start_with(all, json!({}))
}

fn at(line: u64, character: u64) -> Value {
    json!({ "textDocument": { "uri": URI }, "position": { "line": line, "character": character } })
}

fn document() -> Value {
    json!({ "textDocument": { "uri": URI } })
}

fn lines(start: u64, end: u64) -> Value {
    json!({ "start": { "line": start, "character": 0 }, "end": { "line": end, "character": 0 } })
}

fn applied(text: &str, edits: &Value) -> String {
    let offset = |position: &Value| {
        let line = position["line"].as_u64().unwrap() as usize;
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        start + position["character"].as_u64().unwrap() as usize
    };
    let mut result = text.to_owned();
    for edit in edits.as_array().unwrap().iter().rev() {
        result.replace_range(
            offset(&edit["range"]["start"])..offset(&edit["range"]["end"]),
            edit["newText"].as_str().unwrap(),
        );
    }
    result
}

/// R 5 in two halves from its middle, the wire inside; then a way to a second thread hole.
const HOLE: &str = "%\nN10 G92 X0. Y0.\nN20 G91\nN30 G41 D1\nN40 G01 X5.\nN50 G03 X-10. I-5. J0. (half)\nN60 X10. I5.\nN70 G40\nN80 G01 X-5.\nN90 M00\nN100 G00 X20.\nN110 M02\n%\n";

#[test]
fn each_question_has_its_answer() {
    let mut client = start();
    assert_eq!(client.open_text(URI, "wire-iso", HOLE), Vec::<Value>::new());
    let said = |client: &mut Client, line, character| {
        client
            .request("textDocument/hover", at(line, character))
            .unwrap()["contents"]["value"]
            .as_str()
            .unwrap()
            .to_owned()
    };
    let arc = said(&mut client, 5, 4);
    assert!(
        arc.contains("**G03** cuts along an arc counter-clockwise")
            && arc.contains("**N50: arc** counter-clockwise about"),
        "{arc}"
    );
    assert!(
        said(&mut client, 5, 16).contains("-5.000 mm along X from the arc's start to its centre")
    );
    assert!(said(&mut client, 3, 9).contains("place 1 of the control's table"));
    let mut params = document();
    params["range"] = lines(4, 7);
    let hints = client
        .request("textDocument/inlayHint", params.clone())
        .unwrap();
    let labels: Vec<_> = hints
        .as_array()
        .unwrap()
        .iter()
        .map(|hint| hint["label"].as_str().unwrap())
        .collect();
    assert_eq!(
        labels,
        [
            "→ 5.000, 0.000",
            "R 5.000, 180° → -5.000, 0.000",
            "R 5.000, 180° → 5.000, 0.000"
        ]
    );
    let symbols = client
        .request("textDocument/documentSymbol", document())
        .unwrap();
    let names = |symbols: &Value| {
        symbols
            .as_array()
            .unwrap()
            .iter()
            .map(|child| child["name"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        names(&symbols),
        ["contour 1", "N90", "way to (20.000, 0.000)", "N110"]
    );
    assert_eq!(
        names(&symbols[0]["children"]),
        ["lead-in", "N50", "N60", "lead-out"]
    );
    let folds = client
        .request("textDocument/foldingRange", document())
        .unwrap();
    assert_eq!(
        (&folds[0]["startLine"], &folds[0]["endLine"]),
        (&json!(4), &json!(8))
    );
    let full = client
        .request("textDocument/semanticTokens/full", document())
        .unwrap();
    assert!(full["data"].as_array().unwrap().len() > 5 * 30);
    let partner = |client: &mut Client, line, character| {
        client
            .request("textDocument/definition", at(line, character))
            .unwrap()[0]["range"]["start"]["line"]
            .clone()
    };
    assert_eq!(partner(&mut client, 3, 5), 7);
    assert_eq!(partner(&mut client, 7, 5), 3);
    assert_eq!(partner(&mut client, 0, 0), 12);
    assert_eq!(partner(&mut client, 4, 9), 8);
    let mut places = document();
    places["positions"] = json!([{ "line": 5, "character": 5 }]);
    let selection = client
        .request("textDocument/selectionRange", places)
        .unwrap();
    let mut around = &selection[0];
    let mut grown = Vec::new();
    while !around.is_null() {
        grown.push((
            around["range"]["start"]["line"].as_u64().unwrap(),
            around["range"]["end"]["line"].as_u64().unwrap(),
        ));
        around = &around["parent"];
    }
    assert_eq!(grown, [(5, 5), (5, 5), (5, 6), (4, 8), (0, 13)]);
    let lenses = client.request("textDocument/codeLens", document()).unwrap();
    let titles: Vec<_> = lenses
        .as_array()
        .unwrap()
        .iter()
        .map(|lens| lens["command"]["title"].as_str().unwrap())
        .collect();
    assert_eq!(
        titles,
        [
            "Simulate",
            "Open picture",
            "Convert to DXF",
            "contour 1: closed, 2 blocks, 31.416 mm, counter-clockwise"
        ]
    );
    client.shut_down();
}

#[test]
fn blocks_are_completed_and_their_form_is_shown() {
    let mut client = start();
    let text = "G92 X0. Y0.\nG90\nG01 X10. Y0.\nG03 X15. Y5. \n";
    client.open_text(URI, "wire-iso", text);
    let items = client
        .request("textDocument/completion", at(3, 13))
        .unwrap();
    assert_eq!(items[0]["textEdit"]["newText"], "I0. J5.");
    assert_eq!(
        items[0]["detail"],
        "R 5.000, 90.0°, leaves the block before without a corner"
    );
    let items = client.request("textDocument/completion", at(4, 0)).unwrap();
    assert_eq!(items[0]["label"], "G01 X0. Y0.");
    let help = client
        .request("textDocument/signatureHelp", at(3, 13))
        .unwrap();
    assert_eq!(
        (&help["activeParameter"], &help["signatures"][0]["label"]),
        (&json!(2), &json!("G03 X Y I J"))
    );
    client.shut_down();
}

#[test]
fn a_called_number_is_renamed_with_its_calls() {
    let mut client = start();
    let text = "M98 P7\nM02\nN7 G01 X1.\nN8 X0.\nM99\n";
    client.open_text(URI, "wire-iso", text);
    assert_eq!(
        client
            .request("textDocument/prepareRename", at(2, 1))
            .unwrap()["placeholder"],
        "7"
    );
    let mut params = at(2, 1);
    params["newName"] = json!("N70");
    let edit = client
        .request("textDocument/rename", params.clone())
        .unwrap();
    assert_eq!(
        applied(text, &edit["documentChanges"][0]["edits"]),
        "M98 P70\nM02\nN70 G01 X1.\nN8 X0.\nM99\n"
    );
    params["newName"] = json!("8");
    assert_eq!(
        client.request("textDocument/rename", params).unwrap_err()["message"],
        "N8 is the block in line 4"
    );
    client.shut_down();
}

#[test]
fn programs_are_formatted_whole_and_in_part() {
    let mut client = start();
    let text = "g01 x1.50y2\nG02  X3.  Y4. i1.\nm02\n";
    client.open_text(URI, "wire-iso", text);
    let mut params = document();
    params["options"] = json!({ "tabSize": 4, "insertSpaces": true });
    let whole = client
        .request("textDocument/formatting", params.clone())
        .unwrap();
    assert_eq!(
        applied(text, &whole),
        "G01 X1.50 Y2\nG02 X3. Y4. I1.\nM02\n"
    );
    params["range"] = lines(1, 2);
    let part = client
        .request("textDocument/rangeFormatting", params)
        .unwrap();
    assert_eq!(applied(text, &part), "g01 x1.50y2\nG02 X3. Y4. I1.\nm02\n");
    client.shut_down();
}

#[test]
fn faults_are_repaired_and_programs_rewritten() {
    let mut client = start();
    let text = "G92 X0. Y0.\nG90\nG01 X5. Y0.\nG03 X0. Y5. I-5. J0.\nG03 X-5. Y0. I0. J5.\nM02\n";
    let found = client.open_text(URI, "wire-iso", text);
    let codes: Vec<_> = found
        .iter()
        .map(|found| found["code"].as_str().unwrap())
        .collect();
    assert_eq!(codes, ["arc-off-radius", "not-closed"]);
    let mut params = document();
    params["range"] = lines(4, 5);
    params["context"] = json!({ "diagnostics": found, "only": ["quickfix"] });
    let actions = client
        .request("textDocument/codeAction", params.clone())
        .unwrap();
    let titles: Vec<_> = actions
        .as_array()
        .unwrap()
        .iter()
        .map(|action| action["title"].as_str().unwrap())
        .collect();
    assert_eq!(
        titles[0],
        "Take I and J as other controls do, and write them as this program does (R 5.000 mm)"
    );
    assert!(
        titles[1..].contains(&"Close the contour with a line of 5.000 mm"),
        "{titles:?}"
    );
    let repaired = applied(text, &actions[0]["edit"]["documentChanges"][0]["edits"]);
    assert!(repaired.contains("G03 X-5. Y0. I0. J-5.\n"), "{repaired}");
    client.open_text(URI, "wire-iso", HOLE);
    params["range"] = lines(5, 5);
    params["context"] = json!({ "diagnostics": [], "only": ["refactor"] });
    let actions = client.request("textDocument/codeAction", params).unwrap();
    let named = |kind: &str| {
        let kind = format!("refactor.rewrite.{kind}");
        let found = actions
            .as_array()
            .unwrap()
            .iter()
            .find(|action| action["kind"] == kind.as_str());
        found.unwrap_or_else(|| panic!("{kind} in {actions}"))["edit"]["documentChanges"][0].clone()
    };
    assert_eq!(named("reverse")["textDocument"]["version"], 1);
    assert!(
        applied(HOLE, &named("reverse")["edits"])
            .contains("N30 G42 D1\nN40 G01 X5.\nN50 G02 X-10. I-5. J0. (half)\n")
    );
    let absolute = applied(HOLE, &named("coordinates.absolute")["edits"]);
    assert!(
        absolute.contains(
            "N20 G90\nN30 G41 D1\nN40 G01 X5.\nN50 G03 X-5. I-5. J0. (half)\nN60 X5. I5. J0.\n"
        ),
        "{absolute}"
    );
    assert!(
        applied(HOLE, &named("rotate.left")["edits"])
            .contains("N50 G03 Y-10. I0. J-5. (half)\nN60 Y10. J5.\n")
    );
    assert!(
        applied(HOLE, &named("profile")["edits"])
            .starts_with("G92 X0 Y0\nG91\nG41 D0\nG01 X5000 Y0\n")
    );
    let id = client.ask(
        "workspace/executeCommand",
        json!({ "command": "wedm.scale", "arguments": [{ "uri": URI, "factor": 2 }] }),
    );
    let asked = client.asked("workspace/applyEdit");
    let scaled = applied(HOLE, &asked.params["edit"]["documentChanges"][0]["edits"]);
    assert!(
        scaled.contains("N50 G03 X-20. I-10. J0. (half)\nN60 X20. I10. J0.\n"),
        "{scaled}"
    );
    client.respond(&asked, json!({ "applied": true }));
    assert_eq!(client.answer(id).unwrap(), json!({ "applied": true }));
    client.shut_down();
}

#[test]
fn odd_programs_are_answered_too() {
    for text in [
        "",
        "\n",
        "%",
        "G",
        "G03 X5 Y5 I",
        "M98 P1\nM02\nN1 M98 P1\nM99",
        "\u{feff}G01X5\r\nM02",
        "(",
        "G92 X99999999999 Y1e5\nG03 I1 J1\nG41 D",
    ] {
        let mut client = start();
        client.open_text(URI, "wire-iso", text);
        for line in [0, 1, 99] {
            let mut range = document();
            range["range"] = lines(0, 9);
            range["options"] = json!({ "tabSize": 4, "insertSpaces": true });
            range["context"] =
                json!({ "diagnostics": [], "only": ["refactor", "quickfix", "source"] });
            let mut places = document();
            places["positions"] = json!([{ "line": line, "character": 1 }]);
            for (method, params) in [
                ("hover", at(line, 1)),
                ("completion", at(line, 99)),
                ("completion", at(line, 1)),
                ("signatureHelp", at(line, 1)),
                ("definition", at(line, 1)),
                ("documentHighlight", at(line, 0)),
                ("prepareRename", at(line, 0)),
                ("documentSymbol", document()),
                ("foldingRange", document()),
                ("selectionRange", places),
                ("codeLens", document()),
                ("codeAction", range.clone()),
                ("inlayHint", range.clone()),
                ("semanticTokens/full", document()),
                ("semanticTokens/range", range.clone()),
                ("formatting", range.clone()),
                ("rangeFormatting", range),
            ] {
                client
                    .request(&format!("textDocument/{method}"), params)
                    .unwrap_or_else(|error| panic!("{method} of {text:?}: {error}"));
            }
        }
        client.shut_down();
    }
}
