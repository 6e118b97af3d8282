//! Turns bytes into a session of a client: documents opened, changed and closed in any order, every request about any
//! of them, and noise between the messages.

use serde_json::{Value, json};

/// The bytes that a client sends, and the answers that it expects.
pub struct Sequence {
    pub stream: Vec<u8>,
    /// Requests in the stream; their ids count from 0.
    requests: usize,
}

const DOCUMENTS: [(&str, &str); 6] = [
    ("file:///wedm-test/plate.dxf", "dxf"),
    ("file:///wedm-test/plate.3b", "3b"),
    ("file:///wedm-test/plate.4b", "3b"),
    ("file:///wedm-test/plate.iso", "wire-iso"),
    ("file:///wedm-test/wedm.toml", "toml"),
    ("cad:///1", ""),
];

/// Pieces of texts of every kind.
const PHRASES: [&str; 30] = [
    "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n2A\n90\n4\n70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n42\n0.4142\n10\n10.05\n20\n0.05\n10\n0\n20\n10\n0\nENDSEC\n0\nEOF\n",
    "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n5\n7\n10\n0\n20\n0\n40\n0.05\n0\nENDSEC\n",
    "0\nLINE\n5\n8\n10\n0\n20\n0\n11\n5\n21\n5\n",
    "B5000B0B5000GXL1\nB0B5000B5000GYL2\nB5000B0B5000GXL3\nB0B5000B5000GYL4\nDD\n",
    "N1 : B5000 B0 B5000 GX L1 ; 5.000 , 0.000\nN2 : B0 B5000 B10000 GY NR1 ; 0.000 , 5.000\n",
    "; Start Point = 0 , 0\n",
    "B100B0B200GXSR1\n",
    "DD",
    "D\n",
    "E",
    "%\nO1\nG90 G92 X0 Y0\nG41 D1 G01 X5. Y0\nG02 X5. Y5. I0 J2.5\nG01 X0 Y5.\nX0 Y0\nG40\nM02\n",
    "G01 X1 Y1\n",
    "M98 P1 L3\n",
    "N10 G03 X1.5 Y1.5 R2.\n",
    "G51 T1.0\n",
    "correction = 0.2\n",
    "side = \"punch\"\n",
    "[rules]\nsharp-corner = \"off\"\n",
    "[passes]\ncorrections = [0.2, 0.1]\n",
    "[program]\nlayout = \"checking\"\n",
    "margin = 1e400\n",
    "\n",
    "\r\n",
    "999\n",
    "\u{e4}\u{20ac}\u{1f600}",
    "\u{0}",
    "1e99",
    "-",
    ".",
    "(",
];

/// Noise between messages; a whole message after it is read all the same.
const BROKEN: [&str; 16] = [
    "Content-Length: 5\r\nx\r\n",
    "Content-Length: 2\r\n{}",
    "Content-Length: 2\r\n",
    "Content-Length: 30\r\n\r\n",
    "Content-Length: 1",
    "Content-Length: x\r\n\r\n",
    "Content-Length: 0\r\n\r\n",
    "Content-Length: 1\r\n\r\n[",
    "Content-Length: 8\r\n\r\n[1,2,3]]",
    "Content-Length: 99999999999\r\n\r\n{\"",
    "Content Type: x\r\n",
    "ready",
    "log: ready",
    "\r\n",
    "\0",
    "{\"jsonrpc\":\"2.0\",\"id\":77,\"method\":\"shutdown\"}",
];

const SETTINGS: [&str; 8] = [
    r#"{"correction":0.2}"#,
    r#"{"correction":-1}"#,
    r#"{"side":"punch"}"#,
    r#"{"side":"auto","program":{"direction":"cw","corner":"intersection"}}"#,
    r#"{"rules":{"small-radius":"hint"}}"#,
    r#"{"passes":{"corrections":[0.3,0.2]},"margin":0.01}"#,
    r#"{"program":{"compensation":"controller","profile":"robofil","layout":"aligned"}}"#,
    "null",
];

/// Requests with a document, a range and settings among their params.
const METHODS: [&str; 32] = [
    "textDocument/codeAction",
    "textDocument/codeAction",
    "textDocument/codeAction",
    "textDocument/hover",
    "textDocument/documentSymbol",
    "textDocument/foldingRange",
    "textDocument/formatting",
    "textDocument/rangeFormatting",
    "textDocument/onTypeFormatting",
    "textDocument/completion",
    "textDocument/selectionRange",
    "textDocument/codeLens",
    "textDocument/signatureHelp",
    "textDocument/prepareRename",
    "textDocument/rename",
    "textDocument/inlayHint",
    "textDocument/semanticTokens/range",
    "textDocument/semanticTokens/full",
    "textDocument/semanticTokens/full/delta",
    "textDocument/definition",
    "textDocument/references",
    "textDocument/documentHighlight",
    "workspace/executeCommand",
    "wedm/inspect",
    "wedm/contours",
    "wedm/toolpath",
    "wedm/picture",
    "wedm/generate",
    "wedm/locate",
    "wedm/settings",
    "wedm/simulate",
    "$/nothing",
];

struct Script<'a>(&'a [u8]);

impl<'a> Script<'a> {
    fn byte(&mut self) -> usize {
        let Some((&first, rest)) = self.0.split_first() else {
            return 0;
        };
        self.0 = rest;
        usize::from(first)
    }

    fn of<T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.byte() % list.len()]
    }

    fn position(&mut self) -> Value {
        let (line, character) = (self.byte() % 24, self.byte() % 32);
        json!({ "line": line, "character": character })
    }

    fn range(&mut self) -> Value {
        if self.byte().is_multiple_of(4) {
            return json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 100, "character": 0 } });
        }
        let start = self.position();
        let length = self.byte() % 40;
        let end = json!({ "line": start["line"], "character": start["character"].as_u64().unwrap_or(0) as usize + length });
        json!({ "start": start, "end": end })
    }

    fn text(&mut self) -> String {
        (0..=self.byte() % 3).map(|_| *self.of(&PHRASES)).collect()
    }

    fn vertices(&mut self) -> Value {
        let bulges = [0.0, 1.0, -0.4142, 1e-12, 0.05];
        let vertex = |script: &mut Script| {
            let (x, y) = (script.byte() as f64 / 8.0, script.byte() as f64 / 8.0);
            json!([x, y, bulges[script.byte() % bulges.len()]])
        };
        (0..self.byte() % 6).map(|_| vertex(self)).collect()
    }

    fn entity(&mut self) -> Value {
        let handle = ["1", "2", "3"][self.byte() % 3];
        match self.byte() % 4 {
            0 => {
                json!({ "handle": handle, "type": "circle", "center": [self.byte(), self.byte()], "radius": self.byte() as f64 / 64.0 })
            }
            1 => {
                json!({ "handle": handle, "type": "line", "start": [self.byte(), 0], "end": [0, self.byte()] })
            }
            2 => json!({ "handle": handle, "type": "text", "at": [self.byte(), 0], "text": "O" }),
            _ => {
                json!({ "handle": handle, "type": "polyline", "closed": true, "vertices": self.vertices() })
            }
        }
    }
}

/// The session for `script`. It begins with the handshake, and does not end with `exit`.
pub fn sequence(script: &[u8]) -> Sequence {
    let mut script = Script(script);
    let mut sequence = Sequence {
        stream: Vec::new(),
        requests: 0,
    };
    sequence.ask(
        "initialize",
        json!({ "processId": null, "rootUri": null, "capabilities": capabilities(script.byte()) }),
    );
    sequence.notify("initialized", json!({}));
    let mut version = 0;
    while !script.0.is_empty() {
        version += 1;
        step(&mut sequence, &mut script, version);
    }
    sequence
}

fn capabilities(bits: usize) -> Value {
    let bit = |number: usize| bits >> number & 1 == 1;
    json!({
        "general": { "positionEncodings": if bit(0) { ["utf-8"] } else { ["utf-16"] } },
        "workspace": { "workspaceEdit": { "documentChanges": bit(1) } },
        "textDocument": {
            "publishDiagnostics": { "relatedInformation": bit(2) },
            "codeAction": { "disabledSupport": bit(3) },
            "documentSymbol": { "hierarchicalDocumentSymbolSupport": bit(4) },
            "semanticTokens": { "requests": { "full": { "delta": bit(5) } }, "tokenTypes": [], "tokenModifiers": [], "formats": [] },
        },
        "experimental": { "wedm": { "codeLens": bit(6) } },
    })
}

fn step(sequence: &mut Sequence, script: &mut Script, version: i64) {
    let kind = script.byte() % 16;
    let (uri, language) = *script.of(&DOCUMENTS);
    match kind {
        0..=2 => {
            let document = json!({ "uri": uri, "languageId": language, "version": version, "text": script.text() });
            sequence.notify("textDocument/didOpen", json!({ "textDocument": document }));
        }
        3..=5 => {
            let change = json!({ "range": script.range(), "text": script.text() });
            let document = json!({ "uri": uri, "version": version });
            sequence.notify(
                "textDocument/didChange",
                json!({ "textDocument": document, "contentChanges": [change] }),
            );
        }
        6 => {
            let entities: Vec<Value> = (0..script.byte() % 4).map(|_| script.entity()).collect();
            let drawing = json!({ "uri": "cad:///1", "version": version, "units": "mm", "entities": entities });
            sequence.notify("wedm/didOpenDrawing", json!({ "drawing": drawing }));
        }
        7 => {
            let handle = ["1", "2", "3"][script.byte() % 3];
            let (start, count) = (script.byte() % 4, script.byte() % 3);
            let change = match script.byte() % 3 {
                0 => json!({ "handle": handle, "entity": null }),
                1 => {
                    let entity = script.entity();
                    json!({ "handle": entity["handle"], "entity": entity })
                }
                _ => {
                    json!({ "handle": handle, "vertices": { "start": start, "deleteCount": count, "insert": script.vertices() } })
                }
            };
            let drawing = json!({ "uri": "cad:///1", "version": version });
            sequence.notify(
                "wedm/didChangeDrawing",
                json!({ "drawing": drawing, "changes": [change] }),
            );
        }
        8 if uri.starts_with("cad") => {
            sequence.notify("wedm/didCloseDrawing", json!({ "drawing": { "uri": uri } }))
        }
        8 => sequence.notify(
            "textDocument/didClose",
            json!({ "textDocument": { "uri": uri } }),
        ),
        9 => {
            let settings: Value =
                serde_json::from_str(script.of::<&str>(&SETTINGS)).unwrap_or_default();
            sequence.notify(
                "workspace/didChangeConfiguration",
                json!({ "settings": settings }),
            );
        }
        10 => sequence
            .stream
            .extend_from_slice(script.of(&BROKEN).as_bytes()),
        11 => {
            let id = script.byte() % (sequence.requests + 1);
            match script.byte() % 3 {
                // Cancelled before it is sent: the one that is sent next counts.
                0 => sequence.notify("$/cancelRequest", json!({ "id": id + 1_000_000 })),
                1 => sequence.send(&json!({ "jsonrpc": "2.0", "id": "wedm-1", "result": null })),
                _ => sequence.send(&json!({ "jsonrpc": "2.0", "method": "$/cancelRequest", "params": { "id": id } })),
            }
        }
        _ => {
            let method = *script.of(&METHODS);
            let params = params(script, method, uri);
            sequence.ask(method, params);
        }
    }
}

fn params(script: &mut Script, method: &str, uri: &str) -> Value {
    let position = script.position();
    let handle = ["1", "2A", "#0", "3"][script.byte() % 4];
    let settings: Value = serde_json::from_str(script.of::<&str>(&SETTINGS)).unwrap_or_default();
    if method == "workspace/executeCommand" {
        let command =
            ["wedm.applyDrawingEdit", "wedm.scaleProgram", "wedm.scale"][script.byte() % 3];
        let argument =
            json!({ "uri": uri, "version": script.byte(), "changes": [], "factor": script.byte() });
        return json!({ "command": command, "arguments": [argument] });
    }
    let only = [
        json!(null),
        json!(["quickfix"]),
        json!(["source.fixAll.wedm"]),
        json!(["refactor.rewrite"]),
    ];
    let format = ["3b", "4b", "iso", "gcode"][script.byte() % 4];
    let handles = if script.byte().is_multiple_of(4) {
        json!([handle])
    } else {
        Value::Null
    };
    json!({
        "textDocument": { "uri": uri },
        "uri": uri,
        "range": script.range(),
        "position": position,
        "line": position["line"],
        "character": position["character"],
        "positions": [position],
        "ch": "\n",
        "newName": "N7",
        "handle": handle,
        "handles": handles,
        "layers": if script.byte().is_multiple_of(8) { json!(["0"]) } else { Value::Null },
        "segment": script.byte() % 4,
        "format": format,
        "force": script.byte().is_multiple_of(2),
        "previousResultId": "1",
        "options": if method.starts_with("wedm/") { settings } else { json!({ "tabSize": 4, "insertSpaces": true }) },
        "context": {
            "diagnostics": [],
            "only": only[script.byte() % only.len()],
            "includeDeclaration": true,
        },
    })
}

impl Sequence {
    fn ask(&mut self, method: &str, params: Value) {
        self.send(
            &json!({ "jsonrpc": "2.0", "id": self.requests, "method": method, "params": params }),
        );
        self.requests += 1;
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.stream
            .extend_from_slice(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }
}

/// Checks the server's output against the requests.
///
/// # Panics
/// Where a request is not answered exactly once, or with an internal error, or a message is not
/// JSON-RPC.
pub fn check_answers(sequence: &Sequence, written: &[Vec<u8>]) {
    let mut answers = vec![0_usize; sequence.requests];
    for body in written {
        let message: Value = serde_json::from_slice(body).expect("the server writes JSON");
        assert_eq!(message["jsonrpc"], "2.0", "{message}");
        assert_ne!(message["error"]["code"], -32603, "{message}");
        let is_answer = message.get("method").is_none();
        if let Some(id) = message["id"].as_u64().filter(|_| is_answer) {
            answers[id as usize] += 1;
        }
    }
    assert!(
        answers.iter().all(|&count| count == 1),
        "answers to each request: {answers:?}"
    );
}
