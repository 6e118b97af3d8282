#!/usr/bin/env node
// A server of another version: it shakes hands, names protocol 2, and answers nothing else.

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
    return;
  }
  const result =
    method === "initialize"
      ? { serverInfo: { name: "wedm", version: "9.9.9" }, capabilities: { textDocumentSync: 2, experimental: { wedm: { protocol: 2 } } } }
      : null;
  const body = JSON.stringify({ jsonrpc: "2.0", id, result });
  process.stdout.write(`Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`);
}
