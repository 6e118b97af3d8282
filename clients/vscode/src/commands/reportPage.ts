// A page of a report, for a view that follows no links to files. Knows nothing of VS Code.

/** The page with a script that tells which page a link leads to; nothing else may run in it, and nothing be loaded. */
export function linked(page: string, nonce: string): string {
  const policy = `default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src 'nonce-${nonce}'`;
  const script = `
const host = acquireVsCodeApi();
addEventListener("click", (event) => {
  const href = event.target.closest("a")?.getAttribute("href") ?? "";
  if (href.endsWith(".html")) {
    event.preventDefault();
    event.stopImmediatePropagation();
    host.postMessage(decodeURIComponent(href));
  }
}, true);
`;
  const head = `<meta http-equiv="Content-Security-Policy" content="${policy}"><script nonce="${nonce}">${script}</script>`;
  return page.replace("<head>", () => `<head>${head}`);
}

/** The name that such a page tells; null where it is none of a page beside it. */
export function pageOf(message: unknown): string | null {
  return typeof message === "string" && /^[^/\\]+\.html$/.test(message) ? message : null;
}
