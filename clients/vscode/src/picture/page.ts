// The page in which the picture is shown. Nothing in it runs but the extension's own script.

import { randomBytes } from "node:crypto";
import * as vscode from "vscode";
import { t } from "../words";

export function page(webview: vscode.Webview, extension: vscode.Uri): string {
  const nonce = randomBytes(16).toString("base64");
  const file = (name: string): string => webview.asWebviewUri(vscode.Uri.joinPath(extension, "dist", name)).toString();
  const policy = `default-src 'none'; style-src ${webview.cspSource}; font-src ${webview.cspSource}; script-src 'nonce-${nonce}'`;
  return `<!DOCTYPE html>
<html lang="${escaped(vscode.env.language)}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<link rel="stylesheet" href="${file("picture.css")}">
<title>${text("Picture")}</title>
</head>
<body>
<header>
  <div id="facts"><strong id="title"></strong><span id="note"></span></div>
  <div id="tools" role="toolbar" aria-label="${text("View")}">
    <button id="out" title="${text("Zoom out")} (−)" aria-label="${text("Zoom out")}">−</button>
    <button id="in" title="${text("Zoom in")} (+)" aria-label="${text("Zoom in")}">+</button>
    <button id="fit" title="${text("Show all")} (0)">${text("Fit")}</button>
  </div>
</header>
<main id="stage" tabindex="0" aria-label="${text("Picture of the drawing")}">
  <p id="trouble" hidden></p>
  <div id="scale" aria-hidden="true"><span id="scale-bar"></span><span id="scale-text"></span></div>
  <div id="place" aria-hidden="true"></div>
</main>
<section id="player" hidden aria-label="${text("Playback of the wire")}">
  <button id="play" title="${text("Play (space)")}" aria-label="${text("Play")}"></button>
  <input id="slider" type="range" min="0" max="1000" value="0" step="1" aria-label="${text("Place of the wire")}">
  <select id="speed" title="${text("Speed")}" aria-label="${text("Speed")}">
    <option value="0.25">¼×</option><option value="0.5">½×</option><option value="1" selected>1×</option><option value="2">2×</option><option value="5">5×</option>
  </select>
  <output id="where"></output>
</section>
<footer id="faults" hidden aria-label="${text("Findings")}"></footer>
<script type="application/json" id="words">${words()}</script>
<script nonce="${nonce}" src="${file("picture.js")}"></script>
</body>
</html>`;
}

/** A sentence as it may stand in an attribute. */
function text(sentence: string): string {
  return escaped(t(sentence));
}

function escaped(sentence: string): string {
  return sentence.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
}

/** The sentences of the page, which its script reads. */
function words(): string {
  return JSON.stringify(vscode.l10n.bundle ?? {}).replaceAll("<", "\\u003c");
}
