// The elements of the picture, as text: `picture.ts` finds them by their names, of which there is one each.

import { t } from "./words";

export function markup(): string {
  return `<header>
  <div id="facts"><strong id="title"></strong><span id="note"></span><span id="alert"></span></div>
  <div id="busy" role="status" aria-label="${text("The picture is being made")}" title="${text("The picture is being made")}" hidden></div>
  <div id="tools" role="toolbar" aria-label="${text("View")}">
    <button id="text" title="${text("Open as Text")}" hidden>${text("Text")}</button>
    <button id="fix-all" title="${text("Make every repair that is safe")}" hidden>${text("Fix all")}</button>
    <select id="program" title="${text("Write the program of the drawing")}" aria-label="${text("Program")}" hidden>
      <option value="" selected>${text("Program")}</option><option value="3b">3B…</option><option value="4b">4B…</option><option value="iso">ISO…</option>
    </select>
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
<footer id="faults" hidden aria-label="${text("Findings")}"><div id="rules" role="toolbar" aria-label="${text("Findings by rule")}"></div><div id="chips"></div></footer>`;
}

/** A sentence, escaped for an attribute. */
function text(sentence: string): string {
  return escaped(t(sentence));
}

export function escaped(sentence: string): string {
  return sentence.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
}
