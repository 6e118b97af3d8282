"use strict";
const list = document.getElementById("files");
async function show() {
  const { files } = await (await fetch("/api/files")).json();
  list.replaceChildren(...files.map((file) => {
    const item = document.createElement("li");
    item.textContent = `${file.path}: ${file.errors ?? "…"} / ${file.warnings ?? "…"}`;
    return item;
  }));
}
new WebSocket(`ws://${location.host}/lsp`);
new EventSource("/api/changes").addEventListener("files", show);
show();
