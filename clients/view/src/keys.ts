// The keys of the page. The list of them is shown by ?.

import { t } from "../../picture/words";
import { ask } from "./ask";
import { make } from "./dom";

export interface Key {
  key: string;
  does: string;
  act: () => unknown;
}

/** What takes letters itself. */
const WRITES = "input, select, textarea, dialog, [role=menu]";

export function listen(keys: readonly Key[]): void {
  document.addEventListener("keydown", (event) => {
    const writes = event.target instanceof Element && event.target.closest(WRITES) !== null;
    const pressed = event.ctrlKey || event.metaKey || event.altKey || writes ? undefined : keys.find(({ key }) => key === event.key);
    if (pressed !== undefined) {
      event.preventDefault();
      void pressed.act();
    }
  });
}

export async function help(keys: readonly Key[]): Promise<void> {
  const others: [string, string][] = [
    [t("space"), t("Play or pause the wire")],
    ["↑ ↓ ⏎", t("Go through a list; in the picture, move it")],
    ["Esc", t("Close what is open")],
    ["⇥", t("The next part of the page")],
  ];
  const rows = [...keys.map(({ key, does }): [string, string] => [key, does]), ...others];
  const list = make("dl", { class: "keys" }, ...rows.flatMap(([key, does]) => [make("dt", {}, make("kbd", { text: key })), make("dd", { text: does })]));
  await ask(t("Keys"), [], list);
}
