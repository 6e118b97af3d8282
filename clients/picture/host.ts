// What holds the picture, a webview of VS Code or the page of `wedm view`: it hears of what is pointed at. And the elements of the picture.

import type { FromPage } from "./messages";

export interface Host {
  hear(message: FromPage): void;
  /** The document that is shown now, for a host that remembers it. */
  shows?(uri: string): void;
}

/** An element that the page is known to hold. */
export function element<T extends Element>(id: string, type: abstract new (...given: never[]) => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof type)) {
    throw new Error(`the page has no ${id}`);
  }
  return found;
}
