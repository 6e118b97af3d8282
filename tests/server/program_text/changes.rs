//! Changes to a program.

use super::*;

/// The action of a refactoring.
fn named<'a>(actions: &'a [Value], kind: &str) -> &'a Value {
    let kind = format!("refactor.rewrite.{kind}");
    let found = actions.iter().find(|action| action["kind"] == *kind);
    found.unwrap_or_else(|| panic!("{kind} in {actions:?}"))
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
    let stated = editor.with(named(&all, "coordinates.insert"));
    assert!(
        stated.contains("N1 B9900B0B9900GXL1  ;      9.900 ,      0.000\n"),
        "{stated}"
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
        ("profile", "G92 X0 Y0\nG91\nG41 D1\nG01 X5000 Y0\n"),
    ] {
        let rewritten = editor.with(named(&all, kind));
        assert!(rewritten.contains(expected), "{kind}: {rewritten}");
        assert!(kind != "profile" || rewritten.starts_with(expected));
    }
    editor.close();
}

#[test]
fn a_client_that_resolves_actions_gets_the_edit_of_the_one_that_is_chosen() {
    for (language, text, line) in [(THREE_B, NUMBERED, 3), (ISO, HOLE, 5)] {
        let mut plain = Editor::open(language, text);
        let whole = plain.actions(lines(line, line), json!([]), "refactor");
        plain.close();
        let able = json!({
            "disabledSupport": true,
            "dataSupport": true,
            "resolveSupport": { "properties": ["edit"] },
        });
        let mut editor = Editor::open_with_actions(able, json!({}), language, text);
        let bare = editor.actions(lines(line, line), json!([]), "refactor");
        assert_eq!(bare.len(), whole.len());
        let mut resolve = |action: &Value| {
            let client = &mut editor.client;
            client.request("codeAction/resolve", action.clone())
        };
        for (bare, whole) in bare.iter().zip(&whole) {
            assert_eq!(bare["edit"], Value::Null, "{bare}");
            assert_eq!(resolve(bare).unwrap()["edit"], whole["edit"], "{bare}");
        }
        let first = bare.iter().find(|action| action["disabled"] == Value::Null);
        let mut old = first.unwrap().clone();
        old["data"]["version"] = json!(0);
        let error = resolve(&old).unwrap_err();
        assert_eq!(error["code"], -32801, "{error}");
        editor.close();
    }
}

/// Trying all refactorings of a long program takes long, for a menu that is open meanwhile.
#[test]
fn in_a_long_program_a_refactoring_is_tried_when_it_is_chosen() {
    let square = "B5000B0B5000GXL1\nB0B5000B5000GYL2\nB5000B0B5000GXL3\nB0B5000B5000GYL4\n";
    let text = square.repeat(1500) + "DD\n";
    let able = json!({
        "disabledSupport": true,
        "dataSupport": true,
        "resolveSupport": { "properties": ["edit"] },
    });
    let mut editor = Editor::open_with_actions(able, json!({}), THREE_B, &text);
    let all = editor.actions(lines(1, 1), json!([]), "refactor");
    let is_open = |action: &Value| action["edit"].is_null() && action["disabled"].is_null();
    assert!(all.iter().all(is_open), "{all:?}");
    let action = |kind| named(&all, kind).clone();
    let client = &mut editor.client;
    let mut resolve = |kind| client.request("codeAction/resolve", action(kind));
    let turned = resolve("rotate.half").unwrap();
    let message = |error: Value| error["message"].clone();
    let unchanged = message(resolve("withoutNumbers").unwrap_err());
    assert_eq!(
        unchanged,
        "it would change nothing: the program is like that already"
    );
    let refused = message(resolve("correct.opening").unwrap_err());
    assert!(!refused.as_str().unwrap().is_empty() && refused != unchanged);
    let turned = editor.with(&turned);
    assert!(turned.starts_with("B5000B0B5000GXL3\nB0B5000B5000GYL4\n"));
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
        "Read I and J as other controls do, and rewrite them as this program does (R 5.000 mm)"
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
