// The page in which the picture is shown, as text. Knows nothing of VS Code.

import { t } from "../words";

export interface Around {
  language: string;
  /** What may be loaded, and from where. */
  policy: string;
  nonce: string;
  /** The address of a file of the page. */
  file: (name: string) => string;
  /** The translations that its script uses, by the English sentence. */
  words: Readonly<Record<string, string>>;
}

export function html({ language, policy, nonce, file, words }: Around): string {
  return `<!DOCTYPE html>
<html lang="${escaped(language)}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<link rel="stylesheet" href="${file("picture.css")}">
<title>${text("Picture")}</title>
</head>
<body>
<header>
  <div id="facts"><strong id="title"></strong><span id="note"></span><span id="alert"></span></div>
  <div id="busy" role="status" aria-label="${text("The picture is being made")}" title="${text("The picture is being made")}" hidden></div>
  <div id="tools" role="toolbar" aria-label="${text("View")}">
    <button id="text" title="${text("Open as Text")}" hidden>${text("Text")}</button>
    <button id="export" title="${text("Save the picture as SVG, PNG or PDF")}">${text("Save…")}</button>
    <button id="out" title="${text("Zoom out")} (−)" aria-label="${text("Zoom out")}">−</button>
    <button id="in" title="${text("Zoom in")} (+)" aria-label="${text("Zoom in")}">+</button>
    <button id="fit" title="${text("Show all")} (0)">${text("Fit")}</button>
  </div>
</header>
<section id="player" hidden aria-label="${text("Playback of the path")}">
  <button id="play" title="${text("Play (space)")}" aria-label="${text("Play")}"></button>
  <input id="slider" type="range" min="0" max="1000" value="0" step="1" aria-label="${text("Place on the path")}">
  <select id="speed" title="${text("Speed")}" aria-label="${text("Speed")}">
    <option value="0.25">¼×</option><option value="0.5">½×</option><option value="1" selected>1×</option><option value="2">2×</option><option value="5">5×</option>
  </select>
  <span id="motion"></span>
  <code id="block"></code>
  <output id="where"></output>
</section>
<main id="stage" tabindex="0" aria-label="${text("Picture of the drawing")}">
  <p id="trouble" hidden></p>
  <aside id="card" hidden aria-live="polite"></aside>
  <div id="scale" aria-hidden="true"><span id="scale-bar"></span><span id="scale-text"></span></div>
  <div id="place" aria-hidden="true"></div>
</main>
<footer id="faults" hidden aria-label="${text("Findings")}"><div id="rules" role="toolbar" aria-label="${text("Findings by rule")}"></div><div id="chips"></div></footer>
<script type="application/json" id="words">${JSON.stringify(words).replaceAll("<", "\\u003c")}</script>
<script nonce="${nonce}" src="${file("picture.js")}"></script>
</body>
</html>`;
}

/** A sentence, escaped for an attribute. */
function text(sentence: string): string {
  return escaped(t(sentence));
}

function escaped(sentence: string): string {
  return sentence.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
}
