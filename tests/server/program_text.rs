//! What editors ask about the text of programs, over the real process.

use crate::support::{Client, capabilities};
use serde_json::{Value, json};

/// A program that is open in an editor which can do everything.
struct Editor {
    client: Client,
    uri: &'static str,
    text: String,
}

const THREE_B: [&str; 2] = ["file:///plate.3b", "3b"];
const ISO: [&str; 2] = ["file:///hole.iso", "wire-iso"];

impl Editor {
    fn open(language: [&'static str; 2], text: &str) -> Editor {
        Editor::open_under(json!({}), language, text)
    }

    fn open_under(options: Value, [uri, id]: [&'static str; 2], text: &str) -> Editor {
        let mut all = capabilities();
        all["textDocument"] = json!({
            "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
            "codeAction": { "disabledSupport": true },
            "completion": { "completionItem": { "snippetSupport": true } },
        });
        all["workspace"]["applyEdit"] = json!(true);
        all["experimental"]["wedm"]["codeLens"] = json!(true);
        let mut client = Client::start_with(all, options);
        client.open_text(uri, id, text);
        Editor {
            client,
            uri,
            text: text.into(),
        }
    }

    /// What a request of this document is answered, `params` beside its name.
    fn try_ask(&mut self, method: &str, mut params: Value) -> Result<Value, Value> {
        params["textDocument"] = json!({ "uri": self.uri });
        self.client
            .request(&format!("textDocument/{method}"), params)
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.try_ask(method, params)
            .unwrap_or_else(|error| panic!("{method} of {:?}: {error}", self.text))
    }

    /// Asks, and holds parts of the answers against what is expected.
    fn check(&mut self, rows: Vec<(&str, Value, &str, Value)>) {
        for (method, params, path, expected) in rows {
            let answer = self.ask(method, params.clone());
            assert_eq!(
                part(&answer, path),
                expected,
                "{path} of {method} {params}: {answer}"
            );
        }
    }

    /// What a hover says.
    fn check_said(&mut self, line: u64, character: u64, expected: &[&str]) {
        let hover = self.ask("hover", at(line, character));
        let said = hover["contents"]["value"].as_str().unwrap();
        for expected in expected {
            assert!(said.contains(expected), "{said}");
        }
    }

    /// The actions of a kind at some lines.
    fn actions(&mut self, range: Value, found: Value, kind: &str) -> Vec<Value> {
        let context = json!({ "diagnostics": found, "only": [kind] });
        let actions = self.ask("codeAction", json!({ "range": range, "context": context }));
        actions.as_array().unwrap().clone()
    }

    /// The text with LSP edits made in it, the last one first; characters are bytes here.
    fn edited(&self, edits: &Value) -> String {
        let offset = |position: &Value| {
            let line = position["line"].as_u64().unwrap() as usize;
            let start: usize = self
                .text
                .split_inclusive('\n')
                .take(line)
                .map(str::len)
                .sum();
            start + position["character"].as_u64().unwrap() as usize
        };
        let mut result = self.text.clone();
        for edit in edits.as_array().unwrap().iter().rev() {
            result.replace_range(
                offset(&edit["range"]["start"])..offset(&edit["range"]["end"]),
                edit["newText"].as_str().unwrap(),
            );
        }
        result
    }

    /// The text with the edit of an action, of the version that is open, made in it.
    fn with(&self, action: &Value) -> String {
        let change = &action["edit"]["documentChanges"][0];
        assert_eq!(change["textDocument"]["version"], 1, "{action}");
        self.edited(&change["edits"])
    }

    /// The program after the command that scales it by 2.
    fn scaled(&mut self) -> String {
        let id = self.client.ask(
            "workspace/executeCommand",
            scale(json!({ "uri": self.uri, "factor": 2 })),
        );
        let asked = self.client.asked("workspace/applyEdit");
        let text = self.edited(&asked.params["edit"]["documentChanges"][0]["edits"]);
        self.client.respond(&asked, json!({ "applied": true }));
        assert_eq!(self.client.answer(id).unwrap(), json!({ "applied": true }));
        text
    }

    fn close(self) {
        self.client.shut_down();
    }
}

/// A part of an answer: keys and indices, and `*` for all of a list.
fn part(answer: &Value, path: &str) -> Value {
    match path.split_once('*') {
        None => answer.pointer(path).cloned().unwrap_or_default(),
        Some((list, rest)) => {
            let list = answer.pointer(list.trim_end_matches('/'));
            let list = list.and_then(Value::as_array).cloned().unwrap_or_default();
            list.iter().map(|one| part(one, rest)).collect()
        }
    }
}

fn at(line: u64, character: u64) -> Value {
    json!({ "position": { "line": line, "character": character } })
}

fn lines(start: u64, end: u64) -> Value {
    json!({ "start": { "line": start, "character": 0 }, "end": { "line": end, "character": 0 } })
}

fn in_lines(start: u64, end: u64) -> Value {
    json!({ "range": lines(start, end), "options": { "tabSize": 4, "insertSpaces": true } })
}

fn scale(argument: Value) -> Value {
    json!({ "command": "wedm.scale", "arguments": [argument] })
}

/// The action of a refactoring.
fn named<'a>(actions: &'a [Value], kind: &str) -> &'a Value {
    let kind = format!("refactor.rewrite.{kind}");
    let found = actions.iter().find(|action| action["kind"] == *kind);
    found.unwrap_or_else(|| panic!("{kind} in {actions:?}"))
}

/// R 10 with correction 0.1 mm, from its centre and back; as somebody typed it.
const TYPED: &str = "b9900b0b9900gxl1 ; in\nB9900B0B39600GYNR1\nB9900 B0 B9900 GX L3\ndd\n";

/// Lead-in, circle, lead-out.
const NUMBERED: &str =
    "; a hole\n; R10\nN1 B9900B0B9900GXL1\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3\nD\nDD\n";

/// R 5 in two halves from its middle, the wire inside; then a way to a second thread hole.
const HOLE: &str = "%\nN10 G92 X0. Y0.\nN20 G91\nN30 G41 D1\nN40 G01 X5.\nN50 G03 X-10. I-5. J0. (half)\nN60 X10. I5.\nN70 G40\nN80 G01 X-5.\nN90 M00\nN100 G00 X20.\nN110 M02\n%\n";

#[test]
fn formatting_follows_the_layout_that_is_set_and_else_the_text() {
    let aligned = "B   9900 B      0 B   9900 GX L1  ; in\nB   9900 B      0 B  39600 GY NR1\nB   9900 B      0 B   9900 GX L3\nDD\n";
    let compact = "B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n";
    for (options, expected) in [
        (json!({}), compact),
        (json!({ "program": { "layout": "aligned" } }), aligned),
    ] {
        let mut editor = Editor::open_under(options, THREE_B, TYPED);
        let edits = editor.ask("formatting", in_lines(0, 1));
        assert_eq!(editor.edited(&edits), expected);
        let (first, rest) = (
            expected.lines().next().unwrap(),
            TYPED.split_once('\n').unwrap().1,
        );
        let edits = editor.ask("rangeFormatting", in_lines(0, 1));
        assert_eq!(editor.edited(&edits), format!("{first}\n{rest}"));
        let mut typed = in_lines(0, 1);
        typed["position"] = at(3, 0)["position"].clone();
        typed["ch"] = json!("\n");
        let edits = editor.ask("onTypeFormatting", typed);
        let third = expected.lines().nth(2).unwrap();
        assert_eq!(
            editor.edited(&edits).lines().collect::<Vec<_>>(),
            [
                TYPED.lines().next().unwrap(),
                "B9900B0B39600GYNR1",
                third,
                "dd"
            ]
        );
        editor.close();
    }
    let mut editor = Editor::open(ISO, "g01 x1.50y2\nG02  X3.  Y4. i1.\nm02\n");
    let whole = editor.ask("formatting", in_lines(1, 2));
    assert_eq!(
        editor.edited(&whole),
        "G01 X1.50 Y2\nG02 X3. Y4. I1.\nM02\n"
    );
    let part = editor.ask("rangeFormatting", in_lines(1, 2));
    assert_eq!(editor.edited(&part), "g01 x1.50y2\nG02 X3. Y4. I1.\nm02\n");
    editor.close();
}

#[test]
fn a_drawing_is_not_formatted() {
    let mut editor = Editor::open(["file:///a.dxf", "dxf"], "0\nEOF\n");
    assert_eq!(editor.ask("formatting", in_lines(0, 1)), Value::Null);
    editor.close();
}

#[test]
fn each_question_about_3b_has_its_answer() {
    let mut editor = Editor::open(THREE_B, NUMBERED);
    editor.check_said(3, 4, &["**X** of an arc", "R 9.900 mm, 360°"]);
    let range =
        json!({ "start": { "line": 3, "character": 4 }, "end": { "line": 3, "character": 8 } });
    let mut references = at(5, 0);
    references["context"] = json!({ "includeDeclaration": true });
    let places = json!({ "positions": [{ "line": 2, "character": 5 }] });
    editor.check(vec![
        ("hover", at(3, 4), "/range", range),
        (
            "inlayHint",
            in_lines(2, 4),
            "*/label",
            json!(["→ 9.900, 0.000", "R 9.900, 360° → 9.900, 0.000"]),
        ),
        ("documentSymbol", json!({}), "/0/name", json!("contour 1")),
        (
            "documentSymbol",
            json!({}),
            "/0/children/*/name",
            json!(["lead-in", "N2", "lead-out"]),
        ),
        ("foldingRange", json!({}), "/0/kind", json!("comment")),
        ("foldingRange", json!({}), "/1/endLine", json!(4)),
        ("definition", at(5, 0), "*/range/start/line", json!([6])),
        (
            "documentHighlight",
            at(2, 5),
            "*/range/start/line",
            json!([2, 4]),
        ),
        (
            "references",
            references,
            "*/range/start/line",
            json!([5, 6]),
        ),
        (
            "selectionRange",
            places.clone(),
            "/0/range/start/character",
            json!(4),
        ),
        (
            "selectionRange",
            places,
            "/0/parent/range/end/character",
            json!(19),
        ),
    ]);
    let full = editor.ask("semanticTokens/full", json!({}));
    assert_eq!(full["data"].as_array().unwrap()[10..15], [1, 0, 2, 2, 0]);
    let range = editor.ask("semanticTokens/range", in_lines(2, 4));
    assert_eq!(range["data"].as_array().unwrap().len(), 2 * 9 * 5);
    editor.close();
}

#[test]
fn each_question_about_iso_has_its_answer() {
    let mut editor = Editor::open(ISO, HOLE);
    assert_eq!(
        editor.client.open_text(ISO[0], ISO[1], HOLE),
        [] as [Value; 0]
    );
    editor.check_said(
        5,
        4,
        &[
            "**G03** cuts along an arc counter-clockwise",
            "**N50: arc** counter-clockwise about",
        ],
    );
    editor.check_said(
        5,
        16,
        &["-5.000 mm along X from the arc's start to its centre"],
    );
    editor.check_said(3, 9, &["place 1 of the control's table"]);
    let partner = |line, character, expected: u64| {
        let path = "/0/range/start/line";
        ("definition", at(line, character), path, json!(expected))
    };
    editor.check(vec![
        (
            "inlayHint",
            in_lines(4, 7),
            "*/label",
            json!([
                "→ 5.000, 0.000",
                "R 5.000, 180° → -5.000, 0.000",
                "R 5.000, 180° → 5.000, 0.000"
            ]),
        ),
        (
            "documentSymbol",
            json!({}),
            "*/name",
            json!(["contour 1", "N90", "way to (20.000, 0.000)", "N110"]),
        ),
        (
            "documentSymbol",
            json!({}),
            "/0/children/*/name",
            json!(["lead-in", "N50", "N60", "lead-out"]),
        ),
        ("foldingRange", json!({}), "/0/startLine", json!(4)),
        ("foldingRange", json!({}), "/0/endLine", json!(8)),
        partner(3, 5, 7),
        partner(7, 5, 3),
        partner(0, 0, 12),
        partner(4, 9, 8),
        (
            "codeLens",
            json!({}),
            "*/command/title",
            json!([
                "Simulate",
                "Open picture",
                "Convert to DXF",
                "contour 1: closed, 2 blocks, cut 41.416 mm (10.000 mm of it leads), counter-clockwise"
            ]),
        ),
    ]);
    let full = editor.ask("semanticTokens/full", json!({}));
    assert!(full["data"].as_array().unwrap().len() > 5 * 30);
    let places = json!({ "positions": [{ "line": 5, "character": 5 }] });
    let selection = editor.ask("selectionRange", places);
    let around = std::iter::successors(Some(&selection[0]), |around| {
        Some(&around["parent"]).filter(|parent| !parent.is_null())
    });
    let grown: Vec<[&Value; 2]> = around
        .map(|around| ["start", "end"].map(|end| &around["range"][end]["line"]))
        .collect();
    assert_eq!(
        json!(grown),
        json!([[5, 5], [5, 5], [5, 6], [4, 8], [0, 13]])
    );
    editor.close();
}

#[test]
fn blocks_are_completed_and_their_form_is_shown() {
    let mut editor = Editor::open(ISO, "G92 X0. Y0.\nG90\nG01 X10. Y0.\nG03 X15. Y5. \n");
    editor.check(vec![
        (
            "completion",
            at(3, 13),
            "/0/textEdit/newText",
            json!("I0. J5."),
        ),
        (
            "completion",
            at(3, 13),
            "/0/detail",
            json!("R 5.000, 90.0°, leaves the block before without a corner"),
        ),
        ("completion", at(4, 0), "/0/label", json!("G01 X0. Y0.")),
        ("signatureHelp", at(3, 13), "/activeParameter", json!(2)),
        (
            "signatureHelp",
            at(3, 13),
            "/signatures/0/label",
            json!("G03 X Y I J"),
        ),
    ]);
    editor.close();
    let mut editor = Editor::open(THREE_B, &format!("{NUMBERED}B9900B0B"));
    editor.check(vec![
        (
            "completion",
            at(7, 8),
            "/0/textEdit/newText",
            json!("9900GXL1"),
        ),
        (
            "completion",
            at(7, 8),
            "/0/detail",
            json!("line to (9.900, 0.000)"),
        ),
        ("signatureHelp", at(7, 8), "/activeParameter", json!(2)),
        (
            "signatureHelp",
            at(7, 8),
            "/signatures/0/label",
            json!("B X B Y B J G Z"),
        ),
    ]);
    editor.close();
}

#[test]
fn lenses_are_for_clients_that_have_the_commands() {
    let mut editor = Editor::open(THREE_B, &format!("{NUMBERED}B9900B0B"));
    let lenses = editor.ask("codeLens", json!({}));
    assert_eq!(
        part(&lenses, "*/command/command").as_array().unwrap()[..3],
        ["wedm.simulate", "wedm.openPicture", "wedm.convertToDxf"]
    );
    assert_eq!(lenses[0]["command"]["arguments"], json!([THREE_B[0]]));
    assert_eq!(
        lenses[3]["command"]["title"],
        "contour 1: closed, 1 block, cut 82.004 mm (19.800 mm of it leads), counter-clockwise"
    );
    editor.close();
    let mut client = Client::start();
    client.open_text(THREE_B[0], THREE_B[1], NUMBERED);
    let params = json!({ "textDocument": { "uri": THREE_B[0] } });
    assert_eq!(
        client.request("textDocument/codeLens", params).unwrap(),
        Value::Null
    );
    client.shut_down();
}

#[test]
fn a_block_gets_another_number() {
    let calls = "M98 P7\nM02\nN7 G01 X1.\nN8 X0.\nM99\n";
    let renamed = "M98 P70\nM02\nN70 G01 X1.\nN8 X0.\nM99\n";
    for (language, text, line, old, new, expected, taken, refusal) in [
        (
            THREE_B,
            NUMBERED,
            3,
            "2",
            "N20",
            NUMBERED.replace("N2 ", "N20 "),
            "3",
            "N3 is the block in line 5",
        ),
        (
            ISO,
            calls,
            2,
            "7",
            "N70",
            renamed.into(),
            "8",
            "N8 is the block in line 4",
        ),
    ] {
        let mut editor = Editor::open(language, text);
        let named = editor.ask("prepareRename", at(line, 1));
        assert_eq!(named["placeholder"], old);
        let elsewhere = editor.ask("prepareRename", at(line, 6));
        assert_eq!(elsewhere, Value::Null);
        let mut params = at(line, 1);
        params["newName"] = json!(new);
        let edit = editor.ask("rename", params.clone());
        assert_eq!(editor.with(&json!({ "edit": edit })), expected);
        params["newName"] = json!(taken);
        let error = editor.try_ask("rename", params).unwrap_err();
        assert_eq!(error["message"], refusal);
        editor.close();
    }
}

#[test]
fn odd_programs_are_answered_too() {
    let odd = [
        (
            THREE_B,
            &[
                "",
                "\n",
                "DD",
                "D\nD\n",
                "B1B2",
                "\u{feff}B5B0B5GXL1\r\nDD",
                "B0B0B5GXNR1\nB5B0B0GXL1\n",
                "N1\nN2\n;\n;\n",
            ][..],
        ),
        (
            ISO,
            &[
                "",
                "\n",
                "%",
                "G",
                "G03 X5 Y5 I",
                "M98 P1\nM02\nN1 M98 P1\nM99",
                "\u{feff}G01X5\r\nM02",
                "(",
                "G92 X99999999999 Y1e5\nG03 I1 J1\nG41 D",
            ],
        ),
    ];
    let texts = odd
        .iter()
        .flat_map(|(language, texts)| texts.iter().map(|text| (*language, *text)));
    for (language, text) in texts {
        let mut editor = Editor::open(language, text);
        for line in [0, 1, 99] {
            let mut range = in_lines(0, 9);
            range["context"] =
                json!({ "diagnostics": [], "only": ["refactor", "quickfix", "source"] });
            let places = json!({ "positions": [{ "line": line, "character": 1 }] });
            for (method, params) in [
                ("hover", at(line, 1)),
                ("completion", at(line, 99)),
                ("completion", at(line, 1)),
                ("signatureHelp", at(line, 1)),
                ("definition", at(line, 1)),
                ("documentHighlight", at(line, 0)),
                ("prepareRename", at(line, 0)),
                ("documentSymbol", json!({})),
                ("foldingRange", json!({})),
                ("selectionRange", places),
                ("codeLens", json!({})),
                ("codeAction", range.clone()),
                ("inlayHint", range.clone()),
                ("semanticTokens/full", json!({})),
                ("semanticTokens/range", range.clone()),
                ("formatting", range.clone()),
                ("rangeFormatting", range),
            ] {
                editor.ask(method, params);
            }
        }
        editor.close();
    }
}

#[test]
fn refactorings_are_offered_as_versioned_edits_or_with_their_reason() {
    let mut editor = Editor::open(THREE_B, NUMBERED);
    let all = editor.actions(lines(3, 3), json!([]), "refactor");
    let reversed = editor.with(named(&all, "reverse"));
    assert!(reversed.contains("N2 B9900B0B39600GYSR4\n"), "{reversed}");
    let rotated = editor.with(named(&all, "rotate.left"));
    assert!(
        rotated.contains("N1 B0B9900B9900GYL2\nN2 B0B9900B39600GXNR2\nN3 B0B9900B9900GYL4\n"),
        "{rotated}"
    );
    assert!(
        named(&all, "correct.punch")["disabled"]["reason"]
            .as_str()
            .is_some_and(|reason| reason.contains("lead")),
        "{all:?}"
    );
    assert_eq!(
        named(&all, "layout.checking")["title"],
        "Convert to the checking layout, with numbers and end points"
    );
    // The light bulb asks at every move of the cursor.
    let mut params = in_lines(3, 3);
    params["context"] = json!({ "diagnostics": [], "triggerKind": 2 });
    assert_eq!(editor.ask("codeAction", params), json!([]));
    editor.close();
    let mut editor = Editor::open(ISO, HOLE);
    let all = editor.actions(lines(5, 5), json!([]), "refactor");
    for (kind, expected) in [
        (
            "reverse",
            "N30 G42 D1\nN40 G01 X5.\nN50 G02 X-10. I-5. J0. (half)\n",
        ),
        (
            "coordinates.absolute",
            "N20 G90\nN30 G41 D1\nN40 G01 X5.\nN50 G03 X-5. I-5. J0. (half)\nN60 X5. I5. J0.\n",
        ),
        (
            "rotate.left",
            "N50 G03 Y-10. I0. J-5. (half)\nN60 Y10. J5.\n",
        ),
        ("profile", "G92 X0 Y0\nG91\nG41 D0\nG01 X5000 Y0\n"),
    ] {
        let rewritten = editor.with(named(&all, kind));
        assert!(rewritten.contains(expected), "{kind}: {rewritten}");
        assert!(kind != "profile" || rewritten.starts_with(expected));
    }
    editor.close();
}

#[test]
fn faults_of_iso_are_repaired() {
    let text = "G92 X0. Y0.\nG90\nG01 X5. Y0.\nG03 X0. Y5. I-5. J0.\nG03 X-5. Y0. I0. J5.\nM02\n";
    let mut editor = Editor::open(ISO, text);
    let found = json!(editor.client.open_text(ISO[0], ISO[1], text));
    assert_eq!(
        part(&found, "*/code"),
        json!(["arc-off-radius", "not-closed"])
    );
    let actions = editor.actions(lines(4, 5), found, "quickfix");
    let titles: Vec<_> = actions.iter().map(|action| &action["title"]).collect();
    assert_eq!(
        titles[0],
        "Take I and J as other controls do, and write them as this program does (R 5.000 mm)"
    );
    assert!(
        titles[1..]
            .iter()
            .any(|title| *title == "Close the contour with a line of 5.000 mm"),
        "{titles:?}"
    );
    let repaired = editor.with(&actions[0]);
    assert!(repaired.contains("G03 X-5. Y0. I0. J-5.\n"), "{repaired}");
    editor.close();
}

#[test]
fn a_program_is_scaled_by_a_command() {
    for (language, text, expected) in [
        (THREE_B, NUMBERED, "N2 B19800B0B79200GYNR1\n"),
        (
            ISO,
            HOLE,
            "N50 G03 X-20. I-10. J0. (half)\nN60 X20. I10. J0.\n",
        ),
    ] {
        let mut editor = Editor::open(language, text);
        let scaled = editor.scaled();
        assert!(scaled.contains(expected), "{scaled}");
        for (argument, code) in [
            (json!({ "uri": language[0], "factor": 0 }), -32803),
            (json!({ "uri": language[0], "factor": "two" }), -32602),
            (json!({ "uri": "file:///other.3b", "factor": 2 }), -32602),
        ] {
            let command = scale(argument.clone());
            let code_of = editor.client.code("workspace/executeCommand", command);
            assert_eq!(code_of, code, "{argument}");
        }
        editor.close();
    }
}
