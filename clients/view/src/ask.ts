// What the page asks and says: questions in a dialog, notices that go by themselves, menus.

import { t } from "../../picture/words";
import { button, make } from "./dom";

export interface Choice {
  name: string;
  text: string;
  kind?: "primary";
}

/** Puts a question; the name of the choice, or null where it is closed. */
export function ask(title: string, choices: Choice[], ...parts: (Node | string)[]): Promise<string | null> {
  return new Promise((resolve) => {
    const dialog = make("dialog", { "aria-label": title });
    const close = (name: string | null): void => {
      dialog.remove();
      resolve(name);
    };
    const buttons = choices.map(({ name, text, kind }) => button(text, () => { close(name); }, { class: kind ?? "", "data-choice": name }));
    dialog.append(make("h2", { text: title }), ...parts, make("p", { class: "choices" }, ...buttons, button(choices.length === 0 ? t("Close") : t("Cancel"), () => { close(null); })));
    dialog.addEventListener("close", () => {
      close(null);
    });
    dialog.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter" && event.target instanceof HTMLInputElement) {
        dialog.querySelector<HTMLElement>(".primary")?.click();
      }
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}

/** How long a notice stands, ms; one that something can be done about stands longer. */
const STANDS = 8_000;

/** Says a sentence; with `acts`, what can be done about it. */
export function say(sentence: string, severity: "information" | "warning" | "error" = "information", acts: Record<string, () => unknown> = {}): void {
  const place = document.getElementById("notices");
  const notice = make("div", { class: `notice ${severity}`, role: severity === "error" ? "alert" : "status" }, make("span", { text: sentence }));
  for (const [text, act] of Object.entries(acts)) {
    notice.append(button(text, () => {
      notice.remove();
      return act();
    }));
  }
  notice.append(button("×", () => { notice.remove(); }, { class: "close", "aria-label": t("Close") }));
  // What is said again is said once; the newest three are read.
  for (const other of [...(place?.children ?? [])]) {
    if (other.firstChild?.textContent === sentence) {
      other.remove();
    }
  }
  while ((place?.childElementCount ?? 0) > 2) {
    place?.firstElementChild?.remove();
  }
  place?.append(notice);
  const stands = STANDS * (severity === "information" && Object.keys(acts).length === 0 ? 1 : 3);
  setTimeout(() => {
    notice.remove();
  }, stands);
}

/** Says what went wrong. */
export function complain(error: unknown): void {
  say(error instanceof Error ? error.message : String(error), "error");
}

export interface Item {
  name: string;
  text: string;
  act: () => unknown;
  isChecked?: boolean;
}

/** A button that opens a list of things to do. */
export function menu(text: string, label: string, items: () => Item[]): HTMLElement {
  const list = make("div", { class: "menu", role: "menu", hidden: true });
  const opener = button(`${text} ▾`, () => { toggle(list.hidden); }, { "aria-haspopup": "menu", "aria-expanded": "false", title: label });
  const holder = make("span", { class: "holder" }, opener, list);
  const toggle = (open: boolean): void => {
    list.hidden = !open;
    opener.setAttribute("aria-expanded", String(open));
    if (open) {
      list.replaceChildren(...items().map(({ name, text, act, isChecked }) =>
        button(text, () => {
          toggle(false);
          opener.focus();
          return act();
        }, { role: isChecked === undefined ? "menuitem" : "menuitemradio", "data-name": name, "aria-checked": isChecked === undefined ? null : String(isChecked) })));
      list.querySelector("button")?.focus();
    }
  };
  holder.addEventListener("keydown", (event) => {
    const all = [...list.querySelectorAll("button")];
    const at = all.indexOf(document.activeElement as HTMLButtonElement);
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Escape" && !list.hidden) {
      event.stopPropagation();
      toggle(false);
      opener.focus();
    } else if (step !== undefined) {
      event.preventDefault();
      if (list.hidden) {
        toggle(true);
      } else {
        all[(at + step + all.length) % all.length]?.focus();
      }
    }
  });
  document.addEventListener("pointerdown", (event) => {
    if (!holder.contains(event.target as Node)) {
      toggle(false);
    }
  });
  return holder;
}
