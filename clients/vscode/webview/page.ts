// The page's own elements, and the way to the extension.

import type { FromPage } from "../src/picture/messages";
import { speak } from "../src/words";

interface Host {
  postMessage(message: FromPage): void;
  setState(state: unknown): void;
}

declare function acquireVsCodeApi(): Host;

export const host: Host = acquireVsCodeApi();

speak(JSON.parse(document.getElementById("words")?.textContent ?? "{}") as Record<string, string>);

/** An element that the page is known to hold. */
export function element<T extends Element>(id: string, type: abstract new (...given: never[]) => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof type)) {
    throw new Error(`the page has no ${id}`);
  }
  return found;
}
