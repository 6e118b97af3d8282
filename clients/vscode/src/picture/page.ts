// The page in which the picture is shown. Nothing in it runs but the extension's own script.

import { randomBytes } from "node:crypto";
import * as vscode from "vscode";
import { html } from "./html";

export function page(webview: vscode.Webview, extension: vscode.Uri): string {
  const nonce = randomBytes(16).toString("base64");
  return html({
    language: vscode.env.language,
    policy: `default-src 'none'; style-src ${webview.cspSource}; font-src ${webview.cspSource}; script-src 'nonce-${nonce}'`,
    nonce,
    file: (name) => webview.asWebviewUri(vscode.Uri.joinPath(extension, "dist", name)).toString(),
    words: vscode.l10n.bundle ?? {},
  });
}
