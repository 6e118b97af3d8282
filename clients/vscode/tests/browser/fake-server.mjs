#!/usr/bin/env node
// A server of another version: it shakes hands, names protocol 2, and answers nothing else. With the word `babbles` it names protocol 1,
// and after the handshake it writes a line before a message, as a program does that prints to the wrong place; then it waits for its end.

const babbles = process.argv.includes("babbles");
let waiting = Buffer.alloc(0);

process.stdin.on("data", (chunk) => {
  waiting = Buffer.concat([waiting, chunk]);
  for (;;) {
    const head = waiting.indexOf("\r\n\r\n");
    const length = Number(/Content-Length: (\d+)/i.exec(waiting.subarray(0, Math.max(head, 0)).toString())?.[1]);
    if (head < 0 || waiting.length < head + 4 + length) {
      return;
    }
    const message = JSON.parse(waiting.subarray(head + 4, head + 4 + length).toString());
    waiting = waiting.subarray(head + 4 + length);
    answer(message);
  }
});

function answer({ id, method }) {
  if (id === undefined) {
    if (method === "exit") {
      process.exit(0);
    }
    if (method === "initialized" && babbles) {
      process.stdout.write(`the cutter is warm\n${frame({ jsonrpc: "2.0", method: "window/logMessage", params: { type: 3, message: "ready" } })}`);
    }
    return;
  }
  const result =
    method === "initialize"
      ? { serverInfo: { name: "wedm", version: "9.9.9" }, capabilities: { textDocumentSync: 2, experimental: { wedm: { protocol: babbles ? 1 : 2 } } } }
      : null;
  process.stdout.write(frame({ jsonrpc: "2.0", id, result }));
}

function frame(message) {
  const body = JSON.stringify(message);
  return `Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`;
}
