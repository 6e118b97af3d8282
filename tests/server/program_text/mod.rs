//! What editors ask about the text of programs, over the real process.

mod changes;
mod questions;
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

    fn open_under(options: Value, language: [&'static str; 2], text: &str) -> Editor {
        let actions = json!({ "disabledSupport": true });
        Editor::open_with_actions(actions, options, language, text)
    }

    fn open_with_actions(
        actions: Value,
        options: Value,
        [uri, id]: [&'static str; 2],
        text: &str,
    ) -> Editor {
        let mut all = capabilities();
        all["textDocument"] = json!({
            "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
            "codeAction": actions,
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

/// R 10 with correction 0.1 mm, from its centre and back; as somebody typed it.
const TYPED: &str = "b9900b0b9900gxl1 ; in\nB9900B0B39600GYNR1\nB9900 B0 B9900 GX L3\ndd\n";

/// Lead-in, circle, lead-out.
const NUMBERED: &str =
    "; a hole\n; R10\nN1 B9900B0B9900GXL1\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3\nD\nDD\n";

/// R 5 in two halves from its middle, the wire inside; then a way to a second thread hole.
const HOLE: &str = "%\nN10 G92 X0. Y0.\nN20 G91\nN30 G41 D1\nN40 G01 X5.\nN50 G03 X-10. I-5. J0. (half)\nN60 X10. I5.\nN70 G40\nN80 G01 X-5.\nN90 M00\nN100 G00 X20.\nN110 M02\n%\n";
