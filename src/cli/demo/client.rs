//! A small language client: starts the server as a child, and reads its messages one after the other.
//!
//! It knows JSON-RPC and nothing of drawings, as a client of another program would.

use super::super::Failure;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A server that runs as a child of this process. It ends with its stdin, however the demonstration ends.
pub(crate) struct Client {
    child: Child,
    stdin: ChildStdin,
    stdout: BufReader<ChildStdout>,
    last_id: u64,
}

impl Client {
    /// Starts this very program as a server.
    pub(crate) fn start() -> Result<Client, Failure> {
        let failed = |error: std::io::Error| Failure(say!(the_server_did_not_start, error));
        let mut child = Command::new(std::env::current_exe().map_err(failed)?)
            .args(["serve", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        let (Some(stdin), Some(stdout)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(gone());
        };
        Ok(Client {
            child,
            stdin,
            stdout: BufReader::new(stdout),
            last_id: 0,
        })
    }

    pub(crate) fn notify(&mut self, method: &str, params: Value) -> Result<(), Failure> {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }))
    }

    /// Sends a request, to be answered by [`Client::reply`]: the server may ask something in between.
    pub(crate) fn ask(&mut self, method: &str, params: Value) -> Result<u64, Failure> {
        self.last_id += 1;
        let id = self.last_id;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }))?;
        Ok(id)
    }

    pub(crate) fn answer(&mut self, id: &Value) -> Result<(), Failure> {
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "result": { "applied": true } }))
    }

    /// The whole reply to the request `id`: it has a result or an error.
    pub(crate) fn reply(&mut self, id: u64) -> Result<Value, Failure> {
        self.wait_for(|message| message["id"] == id && message.get("method").is_none())
    }

    /// The result of a request that is not refused.
    pub(crate) fn request(&mut self, method: &str, params: Value) -> Result<Value, Failure> {
        let id = self.ask(method, params)?;
        let mut reply = self.reply(id)?;
        match reply.get("error") {
            Some(error) => Err(super::otherwise(error)),
            None => Ok(reply["result"].take()),
        }
    }

    /// The next message of this kind. Those before it are passed over: nobody waits for them any more.
    pub(crate) fn wait_for(&mut self, wanted: impl Fn(&Value) -> bool) -> Result<Value, Failure> {
        loop {
            let message = self.read().ok_or_else(gone)?;
            if wanted(&message) {
                return Ok(message);
            }
        }
    }

    /// Ends the session as the protocol prescribes; true where the server ends properly.
    pub(crate) fn end(&mut self) -> Result<bool, Failure> {
        self.request("shutdown", Value::Null)?;
        self.notify("exit", Value::Null)?;
        let status = self.child.wait();
        Ok(status.is_ok_and(|status| status.success()))
    }

    fn send(&mut self, message: &Value) -> Result<(), Failure> {
        let body = message.to_string();
        let sent = write!(self.stdin, "Content-Length: {}\r\n\r\n{body}", body.len());
        let sent = sent.and_then(|()| self.stdin.flush());
        sent.map_err(|_| gone())
    }

    fn read(&mut self) -> Option<Value> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.stdout.read_line(&mut line).ok()?;
            match line.trim_end().split_once(": ") {
                Some(("Content-Length", value)) => length = value.parse().ok()?,
                Some(_) => {}
                None => break,
            }
        }
        let body = Read::take(&mut self.stdout, length);
        serde_json::from_reader(body).ok()
    }
}

fn gone() -> Failure {
    Failure(say!(the_server_has_gone).into())
}
