// The findings below the picture, each a button that leads to its place.

import type { Fault } from "../src/picture/messages";
import { element } from "./page";
import { t } from "../src/words";

export function showFaults(faults: readonly Fault[], chosen: (fault: Fault) => void): void {
  const strip = element("faults", HTMLElement);
  strip.hidden = faults.length === 0;
  strip.replaceChildren(...faults.map((fault) => chip(fault, chosen)));
}

function chip(fault: Fault, chosen: (fault: Fault) => void): HTMLButtonElement {
  const button = document.createElement("button");
  button.className = `chip ${fault.severity}`;
  button.title = fault.message;
  const name = document.createElement("b");
  name.textContent = placeOf(fault);
  const what = document.createElement("span");
  what.textContent = figuresOf(fault);
  button.append(name, what);
  button.addEventListener("click", () => {
    chosen(fault);
  });
  return button;
}

function placeOf({ handle, segment, line }: Fault): string {
  if (handle !== undefined) {
    return segment === undefined ? handle : `${handle} · ${segment}`;
  }
  return t("line {0}", (line ?? 0) + 1);
}

/** The radius where the sentence begins with one, else the rule. */
function figuresOf({ message, rule }: Fault): string {
  return rule === "small-radius" ? (/R \d+(\.\d+)?( mm)?/.exec(message)?.[0] ?? rule) : rule;
}
