//! `wedm view`: the real process, asked over plain TCP and by a WebSocket.

mod files;
mod guard;
mod many;
mod outside;
mod session;
mod start;

use crate::support::PATIENCE;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use tungstenite::{Message, WebSocket};

/// A process of `wedm view`, and what a browser has of it.
pub struct View {
    pub child: Child,
    pub port: u16,
    pub token: String,
    pub cookie: String,
}

/// An answer, read to its end.
#[derive(Debug)]
pub struct Reply {
    pub status: u16,
    /// Lines of the head, in small letters.
    pub head: String,
    pub body: Vec<u8>,
}

impl Reply {
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn json(&self) -> Value {
        assert_eq!(self.status, 200, "{}", self.text());
        serde_json::from_slice(&self.body).unwrap()
    }

    /// The value of a header.
    pub fn header(&self, name: &str) -> Option<&str> {
        let mut lines = self.head.lines();
        lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(": "))
    }

    pub fn revision(&self) -> String {
        self.header("etag").unwrap().to_owned()
    }
}

impl View {
    pub fn of(folder: &Path) -> View {
        View::with(folder, &["."], &[])
    }

    pub fn with(folder: &Path, arguments: &[&str], variables: &[(&str, &str)]) -> View {
        let mut child = Command::new(env!("CARGO_BIN_EXE_wedm"))
            .args(["view", "--no-open"])
            .args(arguments)
            .envs(variables.iter().copied())
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut address = String::new();
        let mut stdout = BufReader::new(child.stdout.take().unwrap());
        stdout.read_line(&mut address).unwrap();
        let rest = address.strip_prefix("http://127.0.0.1:").unwrap();
        let (port, token) = rest.trim_end().split_once("/?token=").unwrap();
        let mut view = View {
            child,
            port: port.parse().unwrap(),
            token: token.to_owned(),
            cookie: String::new(),
        };
        let welcome = view.ask("GET", &format!("/?token={token}"), &[], b"");
        assert_eq!(welcome.status, 303, "{}", welcome.text());
        let cookie = welcome.header("set-cookie").unwrap();
        view.cookie = cookie.split(';').next().unwrap().to_owned();
        view
    }

    pub fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub fn origin(&self) -> String {
        format!("http://{}", self.host())
    }

    pub fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.host()).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    /// Any request, with what a browser adds by itself: the host, and the cookie where it has one.
    pub fn ask(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &[u8]) -> Reply {
        let mut head = format!(
            "{method} {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n",
            self.host()
        );
        if !self.cookie.is_empty() {
            head += &format!("Cookie: other=1; {}\r\n", self.cookie);
        }
        if !body.is_empty() {
            head += &format!("Content-Length: {}\r\n", body.len());
        }
        for (name, value) in headers {
            head += &format!("{name}: {value}\r\n");
        }
        self.send(&[head.as_bytes(), b"\r\n", body].concat())
    }

    /// Bytes as they are.
    pub fn send(&self, request: &[u8]) -> Reply {
        let mut stream = self.connect();
        stream.write_all(request).unwrap();
        reply(&mut stream)
    }

    pub fn get(&self, path: &str) -> Reply {
        self.ask("GET", path, &[], b"")
    }

    pub fn read(&self, uri: &str) -> Reply {
        self.get(&format!("/api/file?uri={}", encoded(uri)))
    }

    pub fn write(&self, uri: &str, condition: (&str, &str), body: &[u8]) -> Reply {
        let path = format!("/api/file?uri={}", encoded(uri));
        let origin = self.origin();
        self.ask("PUT", &path, &[("Origin", &origin), condition], body)
    }

    /// The files, once they have been counted.
    pub fn files(&self) -> Vec<Value> {
        let deadline = std::time::Instant::now() + PATIENCE;
        loop {
            let mut listed = self.get("/api/files").json();
            if listed["pending"] == false {
                return std::mem::take(listed["files"].as_array_mut().unwrap());
            }
            assert!(std::time::Instant::now() < deadline, "{listed}");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
    }

    pub fn changes(&self) -> Changes {
        let mut stream = self.connect();
        let head = format!(
            "GET /api/changes HTTP/1.1\r\nHost: {}\r\nCookie: {}\r\n\r\n",
            self.host(),
            self.cookie
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut lines = BufReader::new(stream);
        let mut line = String::new();
        // The stream says at once that it is there.
        while !line.starts_with(": wedm") {
            line.clear();
            assert!(lines.read_line(&mut line).unwrap() > 0);
        }
        Changes { lines }
    }

    pub fn try_session(&self, headers: &[(&str, &str)]) -> Result<Session, tungstenite::Error> {
        let address = format!("ws://{}/lsp", self.host());
        let mut request = tungstenite::client::IntoClientRequest::into_client_request(address)?;
        for (name, value) in headers {
            let name: tungstenite::http::HeaderName = name.parse().unwrap();
            request.headers_mut().remove(&name);
            if !value.is_empty() {
                request.headers_mut().insert(name, value.parse().unwrap());
            }
        }
        match tungstenite::client(request, self.connect()) {
            Ok((socket, _)) => Ok(Session {
                socket,
                next_id: 0,
                seen: Vec::new(),
            }),
            Err(tungstenite::HandshakeError::Failure(error)) => Err(error),
            Err(interrupted) => panic!("{interrupted}"),
        }
    }

    pub fn session(&self) -> Session {
        let origin = self.origin();
        self.try_session(&[("Cookie", &self.cookie), ("Origin", &origin)])
            .unwrap()
    }
}

impl Drop for View {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// An answer to its end.
pub fn reply(stream: &mut TcpStream) -> Reply {
    let mut bytes = Vec::new();
    // A server that has refused a body closes before it has read it.
    let _ = stream.read_to_end(&mut bytes);
    let end = bytes.windows(4).position(|part| part == b"\r\n\r\n");
    let end = end.unwrap_or_else(|| panic!("no answer: {}", String::from_utf8_lossy(&bytes)));
    let head = String::from_utf8_lossy(&bytes[..end]).replace("\r\n", "\n");
    let status = head.split(' ').nth(1).unwrap().parse().unwrap();
    let lines = head.lines().map(|line| match line.split_once(": ") {
        Some((name, value)) => format!("{}: {value}\n", name.to_ascii_lowercase()),
        None => format!("{line}\n"),
    });
    Reply {
        status,
        head: lines.collect(),
        body: bytes[end + 4..].to_vec(),
    }
}

/// The stream of changes.
pub struct Changes {
    lines: BufReader<TcpStream>,
}

impl Changes {
    /// The data of the next event of this name.
    pub fn next(&mut self, name: &str) -> Value {
        let mut line = String::new();
        let mut is_it = false;
        loop {
            line.clear();
            assert!(
                self.lines.read_line(&mut line).unwrap() > 0,
                "{name} did not come"
            );
            match line.trim_end().split_once(": ") {
                Some(("event", event)) => is_it = event == name,
                Some(("data", data)) if is_it => return serde_json::from_str(data).unwrap(),
                _ => {}
            }
        }
    }
}

/// A client of the language server over a WebSocket.
pub struct Session {
    pub socket: WebSocket<TcpStream>,
    next_id: i64,
    seen: Vec<Value>,
}

impl Session {
    pub fn send(&mut self, message: &Value) {
        let text = Message::text(message.to_string());
        self.socket.send(text).unwrap();
    }

    pub fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    pub fn wait_for(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        if let Some(index) = self.seen.iter().position(&fits) {
            return self.seen.remove(index);
        }
        loop {
            match self.socket.read() {
                Ok(Message::Text(text)) => {
                    let message: Value = serde_json::from_str(&text).unwrap();
                    if fits(&message) {
                        return message;
                    }
                    self.seen.push(message);
                }
                Ok(_) => {}
                Err(error) => panic!("{what} did not come: {error}; came: {:?}", self.seen),
            }
        }
    }

    pub fn request(&mut self, method: &str, params: Value) -> Value {
        self.next_id += 1;
        let id = self.next_id;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        self.wait_for(method, |message| message["id"] == id)
    }

    pub fn start(&mut self, params: Value) -> Value {
        let result = self.request("initialize", params)["result"].take();
        self.notify("initialized", json!({}));
        result
    }

    pub fn open(&mut self, uri: &str, language: &str, text: &str) {
        self.notify(
            "textDocument/didOpen",
            json!({ "textDocument": { "uri": uri, "languageId": language, "version": 1, "text": text } }),
        );
    }

    pub fn diagnostics(&mut self, uri: &str) -> Value {
        let is_it = |message: &Value| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
        };
        self.wait_for(uri, is_it)["params"].take()
    }
}

/// Percent-encoded, as a page does with a value in an address.
pub fn encoded(text: &str) -> String {
    let is_plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"-_.!~*'()".contains(byte);
    text.bytes()
        .map(|byte| match is_plain(&byte) {
            true => char::from(byte).to_string(),
            false => format!("%{byte:02X}"),
        })
        .collect()
}

pub fn uri_of(path: &Path) -> String {
    format!("file://{}", path.display())
}

/// A folder with a faulty drawing in it, and its real path.
pub fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().canonicalize().unwrap();
    std::fs::write(path.join("tight.dxf"), drawing()).unwrap();
    (folder, path)
}

pub fn drawing() -> String {
    crate::support::dxf_of(&[("2A", &crate::support::TIGHT)])
}
