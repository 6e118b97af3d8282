// The page of the picture: what the extension sends is shown, what is pointed at is sent back.

import type { Shown, ToPage } from "../src/picture/messages";
import { t } from "../src/words";
import { forgetColours } from "./canvas";
import { Cards } from "./card";
import { Faults } from "./faults";
import { element, host } from "./page";
import { Player } from "./player";
import { type Picked, Sheet } from "./sheet";
import { Stage } from "./stage";

let shownUri = "";
let shown: Shown | null = null;
const stage = new Stage(pick);
const player = new Player();
const faults = new Faults((index) => {
  lookAt(index, true);
});
const cards = new Cards(
  (repair) => {
    stage.sheet?.ghost(repair?.segments ?? null);
  },
  (asking) => {
    document.body.classList.toggle("asking", asking !== null);
    trouble(asking === null ? "" : asking.key === "thread" ? t("Click where the wire is to be threaded. Esc: as it was.") : t("Click the point of the contour where the cut is to begin. Esc: as it was."), false);
  },
);

function pick(picked: Picked | null, twice: boolean, event?: MouseEvent): void {
  const sheet = stage.sheet;
  if (sheet !== null && cards.asking !== null && event !== undefined) {
    answer(sheet, event);
    return;
  }
  if (sheet === null || picked === null) {
    if (!twice) {
      cards.close();
    }
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
    showCardOf(picked.handle, picked.segment ?? null);
  }
}

/** The point that a contour's thread hole or entry is asked for. */
function answer(sheet: Sheet, event: MouseEvent): void {
  const asking = cards.asking;
  const at = sheet.inDrawing(event.clientX, event.clientY);
  if (asking === null || at === null) {
    return;
  }
  const { key, contour } = asking;
  const round = (number: number): number => Number(number.toFixed(3));
  const point = key === "entry" ? sheet.nearest(contour.handles, at) : ([round(at[0]), round(at[1])] as [number, number]);
  if (point !== null) {
    host.postMessage({ type: "say", handles: contour.handles, said: { [key]: point } });
  }
  cards.showContour(contour, true);
}

function pickSegment(sheet: Sheet, handle: string, segment: number | null, close: boolean): void {
  const elements = sheet.ofSegment(handle, segment);
  sheet.select(elements);
  host.postMessage({ type: "segment", handle, segment });
  if (close) {
    stage.approach(sheet.boxOf(elements));
  }
}

/** For a segment its finding is shown, where it has one, else its contour. */
function showCardOf(handle: string, segment: number | null): void {
  if (shown?.isEditor !== true) {
    return;
  }
  const of = shown.faults.findIndex((fault) => fault.handle === handle && fault.segment === segment && ["error", "warning"].includes(fault.severity));
  const contour = shown.contours.find(({ handles }) => handles.includes(handle));
  if (of >= 0 && segment !== null) {
    host.postMessage({ type: "fault", fault: of });
  } else if (contour !== undefined) {
    stage.sheet?.select(contour.handles.flatMap((each) => stage.sheet?.ofSegment(each, null) ?? []));
    cards.showContour(contour, shown.keeps);
  } else {
    cards.close();
  }
}

function lookAt(index: number, close: boolean): void {
  const fault = shown?.faults[index];
  if (fault === undefined) {
    return;
  }
  const sheet = stage.sheet;
  if (fault.handle === undefined) {
    pick({ line: fault.line ?? 0 }, close);
  } else if (sheet !== null) {
    pickSegment(sheet, fault.handle, fault.segment ?? 0, close && fault.at === undefined);
    if (fault.at !== undefined) {
      const place = sheet.about(fault.at, fault.reach ?? 0);
      sheet.select(sheet.markAt(place));
      stage.approach(place);
    }
  }
  if (shown?.isEditor === true) {
    host.postMessage({ type: "fault", fault: index });
  }
}

function show(message: Shown): void {
  const same = message.uri === shownUri;
  const sheet = new Sheet(message.svg);
  const broken = message.faults.find(({ rule, severity }) => rule === "syntax" && severity === "error");
  const before = shown;
  shownUri = message.uri;
  host.setState({ uri: message.uri });
  faults.put(message.faults, message.contours);
  // The last good picture stays while the text is broken.
  if (same && (stage.sheet?.drawing ?? null) !== null && (sheet.drawing === null || broken !== undefined)) {
    trouble(broken?.message ?? sheet.reason);
    shown = before === null ? message : { ...before, faults: message.faults };
    return;
  }
  shown = message;
  document.body.dataset["kind"] = message.kind;
  element("text", HTMLElement).hidden = !message.isEditor;
  stage.put(sheet, same);
  player.put(sheet, message.blocks, message.lines, same);
  const { title, note, alert, severity } = sheet.heading();
  element("title", HTMLElement).textContent = title;
  element("note", HTMLElement).textContent = note;
  const place = element("alert", HTMLElement);
  place.textContent = place.title = alert;
  place.className = severity;
  if (cards.asking === null) {
    trouble("");
  }
  cards.refresh(same ? message.contours : [], message.keeps);
  if (cards.open !== null) {
    sheet.select(cards.open.handles.flatMap((each) => sheet.ofSegment(each, null)));
  }
}

function trouble(message: string, stale = true): void {
  const place = element("trouble", HTMLElement);
  place.hidden = message === "";
  place.textContent = message;
  document.body.classList.toggle("stale", message !== "" && stale);
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
    case "busy":
      element("busy", HTMLElement).hidden = !data.busy;
      break;
    case "card": {
      const fault = shown?.faults[data.card.fault];
      if (fault !== undefined) {
        const contour = shown?.contours.find(({ handles }) => fault.handle !== undefined && handles.includes(fault.handle));
        cards.showFault(fault, data.card, contour, shown?.keeps === true);
      }
      break;
    }
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
element("text", HTMLElement).addEventListener("click", () => {
  host.postMessage({ type: "text" });
});
element("export", HTMLElement).addEventListener("click", () => {
  host.postMessage({ type: "export" });
});
new MutationObserver(() => {
  forgetColours();
  stage.redraw();
}).observe(document.body, { attributes: true, attributeFilter: ["data-vscode-theme-id"] });
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") {
    cards.close();
  }
  const inControl = event.target instanceof HTMLElement && ["BUTTON", "SELECT", "INPUT"].includes(event.target.tagName);
  if (event.key === " " && !inControl) {
    event.preventDefault();
    player.toggle();
  }
});

host.postMessage({ type: "ready" });
