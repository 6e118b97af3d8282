//! What editors ask about the text of programs, over the real process.

use crate::support::{Client, capabilities};
use serde_json::{Value, json};

const URI: &str = "file:///plate.3b";

fn start() -> Client {
    start_with(json!({}))
}

fn start_with(options: Value) -> Client {
    let mut all = capabilities();
    all["textDocument"] = json!({
        "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
        "codeAction": { "disabledSupport": true },
        "completion": { "completionItem": { "snippetSupport": true } },
    });
    all["workspace"]["applyEdit"] = json!(true);
    all["experimental"]["wedm"]["codeLens"] = json!(true);
    Client::start_with(all, options)
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

/// A text with LSP edits made in it, the last one first; characters are bytes here.
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

/// R10, correction 0.1 mm, from its centre and back.
const HOLE: &str = "b9900b0b9900gxl1 ; in\nB9900B0B39600GYNR1\nB9900 B0 B9900 GX L3\ndd\n";

#[test]
fn formatting_follows_the_layout_that_is_set_and_else_the_text() {
    let aligned = "B   9900 B      0 B   9900 GX L1  ; in\nB   9900 B      0 B  39600 GY NR1\nB   9900 B      0 B   9900 GX L3\nDD\n";
    for (options, expected) in [
        (
            json!({}),
            "B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
        ),
        (json!({ "program": { "layout": "aligned" } }), aligned),
    ] {
        let mut client = start_with(options);
        client.open_text(URI, "3b", HOLE);
        let mut params = document();
        params["options"] = json!({ "tabSize": 4, "insertSpaces": true });
        let edits = client
            .request("textDocument/formatting", params.clone())
            .unwrap();
        assert_eq!(applied(HOLE, &edits), expected);
        params["range"] = lines(0, 1);
        let edits = client
            .request("textDocument/rangeFormatting", params.clone())
            .unwrap();
        let (first, rest) = (
            expected.lines().next().unwrap(),
            HOLE.split_once('\n').unwrap().1,
        );
        assert_eq!(applied(HOLE, &edits), format!("{first}\n{rest}"));
        let mut typed = at(3, 0);
        typed["ch"] = json!("\n");
        typed["options"] = params["options"].clone();
        let edits = client
            .request("textDocument/onTypeFormatting", typed)
            .unwrap();
        let third = expected.lines().nth(2).unwrap();
        assert_eq!(
            applied(HOLE, &edits).lines().collect::<Vec<_>>(),
            [
                HOLE.lines().next().unwrap(),
                "B9900B0B39600GYNR1",
                third,
                "dd"
            ]
        );
        client.shut_down();
    }
}

#[test]
fn a_drawing_is_not_formatted() {
    let mut client = start();
    client.open_text("file:///a.dxf", "dxf", "0\nEOF\n");
    let params = json!({ "textDocument": { "uri": "file:///a.dxf" }, "options": { "tabSize": 4, "insertSpaces": true } });
    assert_eq!(
        client.request("textDocument/formatting", params).unwrap(),
        Value::Null
    );
    client.shut_down();
}

/// Lead-in, circle, lead-out.
const NUMBERED: &str =
    "; a hole\n; R10\nN1 B9900B0B9900GXL1\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3\nD\nDD\n";

#[test]
fn each_question_has_its_answer() {
    let mut client = start();
    client.open_text(URI, "3b", NUMBERED);
    let hover = client.request("textDocument/hover", at(3, 4)).unwrap();
    let said = hover["contents"]["value"].as_str().unwrap();
    assert!(
        said.contains("**X** of an arc") && said.contains("R 9.900 mm, 360°"),
        "{said}"
    );
    assert_eq!(
        hover["range"],
        json!({ "start": { "line": 3, "character": 4 }, "end": { "line": 3, "character": 8 } })
    );
    let mut params = document();
    params["range"] = lines(2, 4);
    let hints = client
        .request("textDocument/inlayHint", params.clone())
        .unwrap();
    let labels: Vec<_> = hints
        .as_array()
        .unwrap()
        .iter()
        .map(|hint| hint["label"].as_str().unwrap())
        .collect();
    assert_eq!(labels, ["→ 9.900, 0.000", "R 9.900, 360° → 9.900, 0.000"]);
    let symbols = client
        .request("textDocument/documentSymbol", document())
        .unwrap();
    assert_eq!(symbols[0]["name"], "contour 1");
    let names: Vec<_> = symbols[0]["children"]
        .as_array()
        .unwrap()
        .iter()
        .map(|child| child["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["lead-in", "N2", "lead-out"]);
    let folds = client
        .request("textDocument/foldingRange", document())
        .unwrap();
    assert_eq!(
        (&folds[0]["kind"], &folds[1]["endLine"]),
        (&json!("comment"), &json!(4)),
        "{folds}"
    );
    let full = client
        .request("textDocument/semanticTokens/full", document())
        .unwrap();
    let first_block: Vec<_> = full["data"].as_array().unwrap()[10..15]
        .iter()
        .map(|number| number.as_u64().unwrap())
        .collect();
    assert_eq!(first_block, [1, 0, 2, 2, 0]);
    let range = client
        .request("textDocument/semanticTokens/range", params)
        .unwrap();
    assert_eq!(range["data"].as_array().unwrap().len(), 2 * 9 * 5);
    let end = client.request("textDocument/definition", at(5, 0)).unwrap();
    assert_eq!(end[0]["range"]["start"]["line"], 6);
    let both = client
        .request("textDocument/documentHighlight", at(2, 5))
        .unwrap();
    assert_eq!(
        (
            &both[0]["range"]["start"]["line"],
            &both[1]["range"]["start"]["line"]
        ),
        (&json!(2), &json!(4))
    );
    let mut references = at(5, 0);
    references["context"] = json!({ "includeDeclaration": true });
    assert_eq!(
        client
            .request("textDocument/references", references)
            .unwrap()
            .as_array()
            .unwrap()
            .len(),
        2
    );
    let mut places = document();
    places["positions"] = json!([{ "line": 2, "character": 5 }]);
    let selection = client
        .request("textDocument/selectionRange", places)
        .unwrap();
    assert_eq!(selection[0]["range"]["start"]["character"], 4);
    assert_eq!(selection[0]["parent"]["range"]["end"]["character"], 19);
    client.shut_down();
}

#[test]
fn a_block_gets_another_number() {
    let mut client = start();
    client.open_text(URI, "3b", NUMBERED);
    assert_eq!(
        client
            .request("textDocument/prepareRename", at(3, 1))
            .unwrap()["placeholder"],
        "2"
    );
    assert_eq!(
        client
            .request("textDocument/prepareRename", at(3, 6))
            .unwrap(),
        Value::Null
    );
    let mut params = at(3, 1);
    params["newName"] = json!("N20");
    let edit = client
        .request("textDocument/rename", params.clone())
        .unwrap();
    let change = &edit["documentChanges"][0];
    assert_eq!(
        (
            &change["textDocument"]["version"],
            &change["edits"][0]["newText"]
        ),
        (&json!(1), &json!("20"))
    );
    params["newName"] = json!("3");
    let error = client.request("textDocument/rename", params).unwrap_err();
    assert_eq!(error["message"], "N3 is the block in line 5");
    client.shut_down();
}

#[test]
fn odd_programs_are_answered_too() {
    for text in [
        "",
        "\n",
        "DD",
        "D\nD\n",
        "B1B2",
        "\u{feff}B5B0B5GXL1\r\nDD",
        "B0B0B5GXNR1\nB5B0B0GXL1\n",
        "N1\nN2\n;\n;\n",
    ] {
        let mut client = start();
        client.open_text(URI, "3b", text);
        for line in [0, 1, 99] {
            let mut range = document();
            range["range"] = lines(0, 9);
            range["options"] = json!({ "tabSize": 4, "insertSpaces": true });
            let mut places = document();
            places["positions"] = json!([{ "line": line, "character": 1 }]);
            for (method, params) in [
                ("hover", at(line, 1)),
                ("definition", at(line, 1)),
                ("documentHighlight", at(line, 0)),
                ("prepareRename", at(line, 0)),
                ("documentSymbol", document()),
                ("foldingRange", document()),
                ("selectionRange", places),
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

/// The refactorings at a line, by title; those that cannot be done with their reason.
fn refactorings(client: &mut Client, line: u64) -> Vec<(String, Value)> {
    let mut params = document();
    params["range"] = lines(line, line);
    params["context"] = json!({ "diagnostics": [], "only": ["refactor"] });
    let actions = client.request("textDocument/codeAction", params).unwrap();
    let of = |action: &Value| {
        (
            action["kind"]
                .as_str()
                .unwrap()
                .trim_start_matches("refactor.rewrite.")
                .to_owned(),
            action.clone(),
        )
    };
    actions.as_array().unwrap().iter().map(of).collect()
}

#[test]
fn refactorings_are_offered_as_versioned_edits_or_with_their_reason() {
    let mut client = start();
    client.open_text(URI, "3b", NUMBERED);
    let all = refactorings(&mut client, 3);
    let named = |kind: &str| {
        &all.iter()
            .find(|(name, _)| name == kind)
            .unwrap_or_else(|| panic!("{kind} in {all:?}"))
            .1
    };
    let change = &named("reverse")["edit"]["documentChanges"][0];
    assert_eq!(change["textDocument"]["version"], 1);
    assert!(
        applied(NUMBERED, &change["edits"]).contains("N2 B9900B0B39600GYSR4\n"),
        "{change}"
    );
    let rotated = applied(
        NUMBERED,
        &named("rotate.left")["edit"]["documentChanges"][0]["edits"],
    );
    assert!(
        rotated.contains("N1 B0B9900B9900GYL2\nN2 B0B9900B39600GXNR2\nN3 B0B9900B9900GYL4\n"),
        "{rotated}"
    );
    assert!(
        named("correct.punch")["disabled"]["reason"]
            .as_str()
            .is_some_and(|reason| reason.contains("lead")),
        "{all:?}"
    );
    assert_eq!(
        named("layout.checking")["title"],
        "Convert to the checking layout, with numbers and end points"
    );
    // The light bulb asks at every move of the cursor.
    let mut params = document();
    params["range"] = lines(3, 3);
    params["context"] = json!({ "diagnostics": [], "triggerKind": 2 });
    assert_eq!(
        client.request("textDocument/codeAction", params).unwrap(),
        json!([])
    );
    client.shut_down();
}

#[test]
fn a_program_is_scaled_by_a_command() {
    let mut client = start();
    client.open_text(URI, "3b", NUMBERED);
    let command = |argument: Value| json!({ "command": "wedm.scale", "arguments": [argument] });
    let id = client.ask(
        "workspace/executeCommand",
        command(json!({ "uri": URI, "factor": 2 })),
    );
    let asked = client.asked("workspace/applyEdit");
    let text = applied(
        NUMBERED,
        &asked.params["edit"]["documentChanges"][0]["edits"],
    );
    assert!(text.contains("N2 B19800B0B79200GYNR1\n"), "{text}");
    client.respond(&asked, json!({ "applied": true }));
    assert_eq!(client.answer(id).unwrap(), json!({ "applied": true }));
    for (argument, code) in [
        (json!({ "uri": URI, "factor": 0 }), -32803),
        (json!({ "uri": URI, "factor": "two" }), -32602),
        (json!({ "uri": "file:///other.3b", "factor": 2 }), -32602),
    ] {
        assert_eq!(
            client.code("workspace/executeCommand", command(argument.clone())),
            code,
            "{argument}"
        );
    }
    client.shut_down();
}

#[test]
fn lenses_completions_and_the_form_of_a_block() {
    let mut client = start();
    client.open_text(URI, "3b", &format!("{NUMBERED}B9900B0B"));
    let lenses = client.request("textDocument/codeLens", document()).unwrap();
    let commands: Vec<_> = lenses
        .as_array()
        .unwrap()
        .iter()
        .map(|lens| lens["command"]["command"].as_str().unwrap())
        .collect();
    assert_eq!(
        commands[..3],
        ["wedm.simulate", "wedm.openPicture", "wedm.convertToDxf"]
    );
    assert_eq!(lenses[0]["command"]["arguments"], json!([URI]));
    assert_eq!(
        lenses[3]["command"]["title"],
        "contour 1: closed, 1 block, 62.204 mm, counter-clockwise"
    );
    let items = client.request("textDocument/completion", at(7, 8)).unwrap();
    let first = &items[0];
    assert_eq!(
        (&first["textEdit"]["newText"], &first["detail"]),
        (&json!("9900GXL1"), &json!("line to (9.900, 0.000)"))
    );
    let help = client
        .request("textDocument/signatureHelp", at(7, 8))
        .unwrap();
    assert_eq!(
        (&help["activeParameter"], &help["signatures"][0]["label"]),
        (&json!(2), &json!("B X B Y B J G Z"))
    );
    client.shut_down();
    // Only for clients that have the commands.
    let mut client = Client::start();
    client.open_text(URI, "3b", NUMBERED);
    assert_eq!(
        client.request("textDocument/codeLens", document()).unwrap(),
        Value::Null
    );
    client.shut_down();
}
