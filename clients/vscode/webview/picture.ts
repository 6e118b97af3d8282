// The page of the picture: what the extension sends is shown, what is pointed at is sent back.

import type { Fault, ToPage } from "../src/picture/messages";
import { showFaults } from "./faults";
import { element, host } from "./page";
import { Player } from "./player";
import { type Picked, Sheet } from "./sheet";
import { Stage } from "./stage";

let shownUri = "";
const stage = new Stage(pick);
const player = new Player();

function pick(picked: Picked | null, twice: boolean): void {
  const sheet = stage.sheet;
  if (sheet === null || picked === null) {
    return;
  }
  if (picked.line !== undefined) {
    sheet.select(sheet.ofLine(picked.line));
    host.postMessage({ type: "line", line: picked.line });
    if (twice) {
      stage.approach(sheet.boxOf(sheet.ofLine(picked.line)));
    }
  } else if (picked.handle !== undefined) {
    pickSegment(sheet, picked.handle, picked.segment ?? null, twice);
  }
}

function pickSegment(sheet: Sheet, handle: string, segment: number | null, close: boolean): void {
  const elements = sheet.ofSegment(handle, segment);
  sheet.select(elements);
  host.postMessage({ type: "segment", handle, segment });
  if (close) {
    stage.approach(sheet.boxOf(elements));
  }
}

function toFault(fault: Fault): void {
  pick({ ...(fault.handle === undefined ? { line: fault.line ?? 0 } : { handle: fault.handle, segment: fault.segment ?? 0 }) }, true);
}

function show(message: Extract<ToPage, { type: "picture" }>): void {
  const same = message.uri === shownUri;
  const sheet = new Sheet(message.svg);
  shownUri = message.uri;
  host.setState({ uri: message.uri });
  document.body.dataset["kind"] = message.kind;
  stage.put(sheet, same);
  player.put(sheet, message.blocks, same);
  showFaults(message.faults, toFault);
  const { title, note } = sheet.heading();
  element("title", HTMLElement).textContent = title;
  element("note", HTMLElement).textContent = note;
  trouble("");
}

function trouble(message: string): void {
  const place = element("trouble", HTMLElement);
  place.hidden = message === "";
  place.textContent = message;
  document.body.classList.toggle("stale", message !== "");
}

function follow(elements: SVGElement[]): void {
  const sheet = stage.sheet;
  if (sheet !== null) {
    sheet.select(elements);
    stage.bring(sheet.boxOf(elements));
  }
}

window.addEventListener("message", ({ data }: MessageEvent<ToPage>) => {
  const sheet = stage.sheet;
  switch (data.type) {
    case "picture":
      show(data);
      break;
    case "segment":
      follow(data.handle === null ? [] : (sheet?.ofSegment(data.handle, data.segment) ?? []));
      break;
    case "contour":
      follow(data.handles.flatMap((handle) => sheet?.ofSegment(handle, null) ?? []));
      break;
    case "line":
      follow(sheet?.ofLine(data.line) ?? []);
      player.toLine(data.line);
      break;
    case "trouble":
      trouble(data.message);
      break;
    case "play":
      player.play();
      break;
  }
});

element("in", HTMLElement).addEventListener("click", () => {
  stage.zoom(1.5);
});
element("out", HTMLElement).addEventListener("click", () => {
  stage.zoom(1 / 1.5);
});
element("fit", HTMLElement).addEventListener("click", () => {
  stage.fit();
});
document.addEventListener("keydown", (event) => {
  const inControl = event.target instanceof HTMLElement && ["BUTTON", "SELECT"].includes(event.target.tagName);
  if (event.key === " " && !inControl) {
    event.preventDefault();
    player.toggle();
  }
});

host.postMessage({ type: "ready" });
