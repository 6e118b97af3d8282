//! A small language client: starts the server as a child, frames messages, keeps incoming ones until they are needed.
//!
//! It knows JSON-RPC and nothing of drawings, as a client of another program would.

use super::super::Failure;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// No answer of the demonstration takes this long.
const PATIENCE: Duration = Duration::from_secs(20);
/// A longer message is not one of the demonstration's.
const LONGEST_BODY: u64 = 64 << 20;

/// A server that runs as a child of this process.
pub(crate) struct Client {
    child: Child,
    stdin: Option<ChildStdin>,
    incoming: Receiver<Value>,
    /// Notifications and requests that have not been read yet.
    waiting: VecDeque<Value>,
    last_id: u64,
}

impl Client {
    /// Starts this very program as a server.
    pub(crate) fn start() -> Result<Client, Failure> {
        let program = std::env::current_exe()
            .map_err(|error| Failure(say!(the_program_does_not_find_itself, error)))?;
        let mut child = Command::new(program)
            .args(["serve", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| Failure(say!(the_server_did_not_start, error)))?;
        let stdin = child.stdin.take();
        let stdout = child
            .stdout
            .take()
            .ok_or_else(|| Failure(say!(the_server_has_no_stdout).into()))?;
        let (sender, incoming) = channel();
        std::thread::spawn(move || read_messages(BufReader::new(stdout), &sender));
        Ok(Client {
            child,
            stdin,
            incoming,
            waiting: VecDeque::new(),
            last_id: 0,
        })
    }

    pub(crate) fn notify(&mut self, method: &str, params: Value) -> Result<(), Failure> {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }))
    }

    /// Sends a request, to be answered by `reply`: the server may ask something in between.
    pub(crate) fn ask(&mut self, method: &str, params: Value) -> Result<u64, Failure> {
        self.last_id += 1;
        self.send(
            &json!({ "jsonrpc": "2.0", "id": self.last_id, "method": method, "params": params }),
        )?;
        Ok(self.last_id)
    }

    /// The result of the request `id`. An error reply is a failure with the server's message.
    pub(crate) fn reply(&mut self, id: u64) -> Result<Value, Failure> {
        self.reply_or_error(id)?.map_err(|error| {
            Failure(say!(
                the_server_refuses,
                error["message"].as_str().unwrap_or(say!(no_reason_given))
            ))
        })
    }

    /// The result of the request `id`, or the error that it was answered with.
    pub(crate) fn reply_or_error(&mut self, id: u64) -> Result<Result<Value, Value>, Failure> {
        let mut message = self.wait_for(say!(an_answer), |message| {
            message["id"] == id && message.get("method").is_none()
        })?;
        Ok(match message.get_mut("error") {
            Some(error) => Err(error.take()),
            None => Ok(message["result"].take()),
        })
    }

    pub(crate) fn request(&mut self, method: &str, params: Value) -> Result<Value, Failure> {
        let id = self.ask(method, params)?;
        self.reply(id)
    }

    /// The diagnostics of `version` of a document, once they arrive. Those of older versions are skipped.
    pub(crate) fn diagnostics(&mut self, uri: &str, version: i64) -> Result<Vec<Value>, Failure> {
        let mut message = self.wait_for("diagnostics", |message| {
            let params = &message["params"];
            message["method"] == "textDocument/publishDiagnostics"
                && params["uri"] == uri
                && params["version"] == version
        })?;
        match message["params"]["diagnostics"].take() {
            Value::Array(diagnostics) => Ok(diagnostics),
            _ => Err(Failure(
                say!(the_server_sent_diagnostics_that_are_no_list).into(),
            )),
        }
    }

    /// The server's own request `method`: its id and params.
    pub(crate) fn asked(&mut self, method: &str) -> Result<(Value, Value), Failure> {
        let mut message = self.wait_for(say!(a_request_of_the_server), |message| {
            message["method"] == method && message.get("id").is_some()
        })?;
        Ok((message["id"].take(), message["params"].take()))
    }

    pub(crate) fn answer(&mut self, id: &Value, result: Value) -> Result<(), Failure> {
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "result": result }))
    }

    /// Ends the session as the protocol prescribes, and reports whether the server ended properly.
    pub(crate) fn end(mut self) -> Result<(), Failure> {
        self.request("shutdown", Value::Null)?;
        self.send(&json!({ "jsonrpc": "2.0", "method": "exit" }))?;
        self.stdin = None;
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            match self.child.try_wait() {
                Ok(Some(status)) if status.success() => return Ok(()),
                Ok(Some(status)) => {
                    return Err(Failure(say!(
                        the_server_ended_with_expected_success,
                        status
                    )));
                }
                Ok(None) => std::thread::sleep(Duration::from_millis(2)),
                Err(error) => {
                    return Err(Failure(say!(the_server_cannot_be_waited_for, error)));
                }
            }
        }
        Err(Failure(say!(the_server_did_not_end_after_exit).into()))
    }

    fn wait_for(&mut self, what: &str, wanted: impl Fn(&Value) -> bool) -> Result<Value, Failure> {
        if let Some(index) = self.waiting.iter().position(&wanted)
            && let Some(message) = self.waiting.remove(index)
        {
            return Ok(message);
        }
        let deadline = Instant::now() + PATIENCE;
        loop {
            match self
                .incoming
                .recv_timeout(deadline.saturating_duration_since(Instant::now()))
            {
                Ok(message) if wanted(&message) => return Ok(message),
                Ok(message) => self.keep(message)?,
                Err(RecvTimeoutError::Timeout) => {
                    return Err(Failure(say!(
                        did_not_arrive_within,
                        what,
                        PATIENCE.as_secs()
                    )));
                }
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Failure(say!(the_server_ended_before_arrived, what)));
                }
            }
        }
    }

    /// Keeps a message for later; answers at once where a client must.
    fn keep(&mut self, message: Value) -> Result<(), Failure> {
        match message["method"].as_str() {
            Some("window/workDoneProgress/create" | "client/registerCapability") => {
                self.answer(&message["id"], Value::Null)
            }
            _ => {
                self.waiting.push_back(message);
                Ok(())
            }
        }
    }

    fn send(&mut self, message: &Value) -> Result<(), Failure> {
        let body = message.to_string();
        let Some(stdin) = &mut self.stdin else {
            return Err(Failure(say!(the_server_stdin_is_closed).into()));
        };
        let sent = write!(stdin, "Content-Length: {}\r\n\r\n{body}", body.len())
            .and_then(|()| stdin.flush());
        sent.map_err(|error| Failure(say!(the_server_does_not_read, error)))
    }
}

impl Drop for Client {
    /// Leaves no server behind, however the demonstration ends.
    fn drop(&mut self) {
        self.stdin = None;
        if let Ok(None) = self.child.try_wait() {
            let _ = self.child.kill();
        }
        let _ = self.child.wait();
    }
}

/// Reads frames until the stream ends or holds something else.
fn read_messages(mut stream: impl BufRead, sender: &Sender<Value>) {
    while let Some(message) = read_message(&mut stream) {
        if sender.send(message).is_err() {
            return;
        }
    }
}

fn read_message(stream: &mut impl BufRead) -> Option<Value> {
    let mut length: Option<u64> = None;
    loop {
        let mut line = String::new();
        if stream.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim_end().split_once(':') {
            Some((name, value)) if name.eq_ignore_ascii_case("content-length") => {
                length = value.trim().parse().ok()
            }
            Some(_) => {}
            None if line.trim_end().is_empty() => break,
            None => return None,
        }
    }
    let length = length.filter(|&length| length <= LONGEST_BODY)?;
    let mut body = Vec::new();
    let read = stream.take(length).read_to_end(&mut body).ok()?;
    if read as u64 != length {
        return None;
    }
    serde_json::from_slice(&body).ok()
}
