//! A small blocking client over the real server's pipes.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Longer than anything here takes, even on a busy machine.
pub const PATIENCE: Duration = Duration::from_secs(120);

pub struct Client {
    pub child: Child,
    stdin: Option<ChildStdin>,
    /// Unread, while the client plays dead.
    stdout: Option<ChildStdout>,
    inbox: Option<Receiver<Value>>,
    /// Arrived and not asked for yet.
    pub seen: Vec<Value>,
    next_id: i64,
    /// Of a result only its length is handed on: for whoever measures how long the server takes for a large one.
    pub skips_results: Arc<AtomicBool>,
    /// When the last message had been read whole, and was not parsed yet.
    pub read_at: Arc<Mutex<Instant>>,
}

/// A request of the server's, to be answered.
pub struct Asked {
    pub id: Value,
    pub params: Value,
}

pub fn capabilities() -> Value {
    json!({
        "general": { "positionEncodings": ["utf-16"] },
        "workspace": { "workspaceEdit": { "documentChanges": true } },
        "experimental": { "wedm": { "applyDrawingEdit": true, "resendDrawing": true } },
    })
}

impl Client {
    /// A server that has not been spoken to, and a client that does not read yet.
    pub fn silent() -> Client {
        let mut child = Command::new(env!("CARGO_BIN_EXE_wedm"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the server starts");
        let (stdin, stdout) = (child.stdin.take(), child.stdout.take());
        Client {
            child,
            stdin,
            stdout,
            inbox: None,
            seen: Vec::new(),
            next_id: 0,
            skips_results: Arc::default(),
            read_at: Arc::new(Mutex::new(Instant::now())),
        }
    }

    /// A server before its handshake.
    pub fn raw() -> Client {
        let mut client = Client::silent();
        client.read_on();
        client
    }

    pub fn start() -> Client {
        Client::start_with(capabilities(), json!({}))
    }

    pub fn start_with(capabilities: Value, options: Value) -> Client {
        let mut client = Client::raw();
        client.shake_hands(
            json!({ "processId": std::process::id(), "rootUri": null, "capabilities": capabilities, "initializationOptions": options }),
        );
        client
    }

    pub fn shake_hands(&mut self, params: Value) -> Value {
        let result = self
            .request("initialize", params)
            .expect("initialize succeeds");
        self.notify("initialized", json!({}));
        result
    }

    /// Begins to read what the server writes.
    pub fn read_on(&mut self) {
        let stdout = self.stdout.take().expect("nobody reads yet");
        let (sender, receiver) = channel();
        let (skips_results, read_at) = (self.skips_results.clone(), self.read_at.clone());
        std::thread::spawn(move || {
            let mut stdout = BufReader::new(stdout);
            while let Some(message) = read_frame(&mut stdout, &skips_results, &read_at) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        self.inbox = Some(receiver);
    }

    pub fn send_bytes(&mut self, bytes: &[u8]) {
        let stdin = self.stdin.as_mut().expect("stdin is open");
        stdin
            .write_all(bytes)
            .and_then(|()| stdin.flush())
            .expect("the server reads");
    }

    pub fn send(&mut self, message: &Value) {
        self.send_bytes(&frame(&message.to_string()));
    }

    pub fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request and returns its id.
    pub fn ask(&mut self, method: &str, params: Value) -> i64 {
        self.next_id += 1;
        self.send(
            &json!({ "jsonrpc": "2.0", "id": self.next_id, "method": method, "params": params }),
        );
        self.next_id
    }

    pub fn request(&mut self, method: &str, params: Value) -> Result<Value, Value> {
        let id = self.ask(method, params);
        self.answer(id)
    }

    pub fn answer(&mut self, id: i64) -> Result<Value, Value> {
        let message = self.wait_for(&format!("the answer to {id}"), |message| {
            message["id"] == id && message.get("method").is_none()
        });
        match message.get("error") {
            Some(error) => Err(error.clone()),
            None => Ok(message["result"].clone()),
        }
    }

    /// Code of the error that a request is answered with.
    pub fn code(&mut self, method: &str, params: Value) -> i64 {
        self.request(method, params).expect_err(method)["code"]
            .as_i64()
            .expect("a code")
    }

    /// The next request of the server with this method.
    pub fn asked(&mut self, method: &str) -> Asked {
        let message = self.wait_for(method, |message| {
            message["method"] == method && message.get("id").is_some()
        });
        Asked {
            id: message["id"].clone(),
            params: message["params"].clone(),
        }
    }

    pub fn respond(&mut self, asked: &Asked, result: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "id": asked.id, "result": result }));
    }

    /// The next notification with this method.
    pub fn told(&mut self, method: &str) -> Value {
        self.wait_for(method, |message| {
            message["method"] == method && message.get("id").is_none()
        })["params"]
            .take()
    }

    /// The next line of the log that holds `text`.
    pub fn logged(&mut self, text: &str) -> String {
        let is_it = |message: &Value| {
            message["method"] == "window/logMessage"
                && message["params"]["message"]
                    .as_str()
                    .is_some_and(|line| line.contains(text))
        };
        self.wait_for(&format!("a log line with \"{text}\""), is_it)["params"]["message"]
            .as_str()
            .unwrap_or_default()
            .into()
    }

    /// The next publish for a document, whatever its version.
    pub fn published(&mut self, uri: &str) -> Value {
        let is_it = |message: &Value| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
        };
        self.wait_for(&format!("diagnostics of {uri}"), is_it)["params"].take()
    }

    /// The diagnostics of one version of a document; older ones are passed over.
    pub fn diagnostics(&mut self, uri: &str, version: i64) -> Vec<Value> {
        loop {
            let mut publish = self.published(uri);
            if publish["version"] == version {
                return publish["diagnostics"]
                    .as_array_mut()
                    .map(std::mem::take)
                    .expect("a list");
            }
        }
    }

    /// The first message that fits, which is taken out of those seen.
    pub fn wait_for(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        if let Some(index) = self.seen.iter().position(&fits) {
            return self.seen.remove(index);
        }
        let deadline = Instant::now() + PATIENCE;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            match self
                .inbox
                .as_ref()
                .expect("somebody reads")
                .recv_timeout(left)
            {
                Ok(message) if fits(&message) => return message,
                Ok(message) => self.seen.push(message),
                Err(RecvTimeoutError::Timeout) => {
                    panic!("{what} did not come; came: {:?}", self.seen)
                }
                Err(RecvTimeoutError::Disconnected) => {
                    panic!("the server ended before {what} came; came: {:?}", self.seen)
                }
            }
        }
    }

    /// Throws away what has come, as a client does that reads on.
    #[allow(dead_code)]
    pub fn pass_over(&mut self) {
        self.seen.clear();
        let inbox = self.inbox.as_ref().expect("somebody reads");
        inbox.try_iter().for_each(drop);
    }

    /// Everything that has come by the time the server has answered one more request.
    pub fn settle(&mut self) -> &[Value] {
        let _ = self.request("wedm/settled", json!({}));
        // The state thread publishes after a request that it has answered.
        let _ = self.request("wedm/inspect", json!({ "uri": "none:" }));
        let _ = self.request("wedm/inspect", json!({ "uri": "none:" }));
        &self.seen
    }

    /// The pipe itself, for whoever writes from another thread.
    pub fn take_stdin(&mut self) -> ChildStdin {
        self.stdin.take().expect("stdin is open")
    }

    pub fn close_stdin(&mut self) {
        self.stdin = None;
    }

    /// Waits for the end of the process: its exit code, and how long it took.
    pub fn end(&mut self) -> (Option<i32>, Duration) {
        let began = Instant::now();
        while began.elapsed() < PATIENCE {
            if let Some(status) = self.child.try_wait().expect("a child") {
                return (status.code(), began.elapsed());
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("the server did not end");
    }

    pub fn shut_down(mut self) {
        self.request("shutdown", Value::Null)
            .expect("shutdown is answered");
        self.notify("exit", Value::Null);
        assert_eq!(self.end().0, Some(0));
    }

    /// Opens a text and returns its first diagnostics.
    pub fn open_text(&mut self, uri: &str, language: &str, text: &str) -> Vec<Value> {
        self.notify("textDocument/didOpen", json!({ "textDocument": { "uri": uri, "languageId": language, "version": 1, "text": text } }));
        self.diagnostics(uri, 1)
    }

    /// Opens a drawing and returns its first diagnostics.
    pub fn open_drawing(&mut self, uri: &str, entities: Value) -> Vec<Value> {
        self.notify(
            "wedm/didOpenDrawing",
            json!({ "drawing": { "uri": uri, "version": 1, "units": "mm", "entities": entities } }),
        );
        self.diagnostics(uri, 1)
    }

    pub fn change_drawing(&mut self, uri: &str, version: i64, changes: Value) {
        self.notify(
            "wedm/didChangeDrawing",
            json!({ "drawing": { "uri": uri, "version": version }, "changes": changes }),
        );
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn frame(body: &str) -> Vec<u8> {
    format!("Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes()
}

fn read_frame(
    stdout: &mut impl BufRead,
    skips_results: &AtomicBool,
    read_at: &Mutex<Instant>,
) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if stdout.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim_end().split_once(": ") {
            Some(("Content-Length", digits)) => length = digits.parse().ok()?,
            Some(_) => {}
            None => break,
        }
    }
    let mut body = vec![0; length];
    stdout.read_exact(&mut body).ok()?;
    *read_at.lock().ok()? = Instant::now();
    if skips_results.load(Ordering::Acquire)
        && let Some(id) = id_of_result(&body)
    {
        return Some(json!({ "id": id, "result": length }));
    }
    serde_json::from_slice(&body).ok()
}

/// The id of an answer that holds a result, as the server writes one.
fn id_of_result(body: &[u8]) -> Option<i64> {
    let head = String::from_utf8_lossy(&body[..body.len().min(80)]);
    let rest = head.strip_prefix(r#"{"jsonrpc":"2.0","id":"#)?;
    rest.split_once(r#","result":"#)?.0.parse().ok()
}

/// A plate of 10 mm, a half circle below and round at the top, whose top right corner has R 0.05: one fault, segment 2.
pub fn tight_plate(handle: &str) -> Value {
    json!({ "handle": handle, "type": "polyline", "closed": true, "vertices": TIGHT })
}

/// The same plate 20 mm beside it, with R 0.5: no fault.
pub fn wide_plate(handle: &str) -> Value {
    json!({ "handle": handle, "type": "polyline", "closed": true,
        "vertices": [[20, 5, 1], [30, 5], [30, 9.5, 0.41421356237309503], [29.5, 10], [25, 10, 0.41421356237309503]] })
}

/// DXF text of closed polylines, each with its handle.
pub fn dxf_of(polylines: &[(&str, &[[f64; 3]])]) -> String {
    let mut text = String::from(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
    );
    for (handle, vertices) in polylines {
        text += &format!(
            "0\nLWPOLYLINE\n5\n{handle}\n8\n0\n90\n{}\n70\n1\n",
            vertices.len()
        );
        for [x, y, bulge] in *vertices {
            text += &format!("10\n{x:?}\n20\n{y:?}\n");
            if *bulge != 0.0 {
                text += &format!("42\n{bulge:?}\n");
            }
        }
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

/// Its vertices: all corners but the tight one are tangent and wide.
pub const TIGHT: [[f64; 3]; 5] = [
    [0.0, 5.0, 1.0],
    [10.0, 5.0, 0.0],
    [10.0, 9.95, 0.41421356237309503],
    [9.95, 10.0, 0.0],
    [5.0, 10.0, 0.41421356237309503],
];

/// Rules of diagnostics, in order.
pub fn codes(diagnostics: &[Value]) -> Vec<&str> {
    diagnostics
        .iter()
        .map(|diagnostic| diagnostic["code"].as_str().unwrap_or_default())
        .collect()
}

/// How many of the diagnostics are of `small-radius`.
pub fn small(diagnostics: &[Value]) -> usize {
    codes(diagnostics)
        .iter()
        .filter(|code| **code == "small-radius")
        .count()
}
