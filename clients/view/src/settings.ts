// The settings of the folder as a form: wire, gap, passes, machine, side, pair. What the form does not know stays as it is written.

import { keepContour, valueOf, withKey } from "../../picture/keep";
import type { Said } from "../../picture/messages";
import { machines } from "../../picture/profiles";
import type { Diagnostic, SettingsInForce } from "../../picture/protocol";
import { t } from "../../picture/words";
import { readIfThere } from "./api";
import { ask, say } from "./ask";
import type { Doc } from "./doc";
import { beside, make, nameOf } from "./dom";
import { rewrite } from "./save";
import type { Server } from "./server";

/** What a wire and its gap are where nobody says, mm: as docs/settings.md has them. */
const [WIRE, GAP] = ["0.18", "0.01"];
/** What `wedm init` leaves for all skims together where several passes are asked for, mm. */
const STOCK = 0.06;

/** What the form asks: keys of wedm.toml as they are written there; null for "not set". */
interface Answers {
  wire: string;
  gap: string;
  passes: number;
  machine: string;
  side: string;
  thickness: string;
  drawnAs: string;
  clearance: string;
}

/** The corrections that follow, mm: as `wedm init` proposes them. */
export function correctionsOf(wire: number, gap: number, passes: number): number[] {
  const skims = passes - 1;
  const first = wire / 2 + gap + (skims > 0 ? STOCK : 0);
  return [first, ...Array.from({ length: skims }, (_, skim) => wire / 2 + gap / 2 + (STOCK * (skims - skim - 1)) / skims)];
}

export function answersOf(text: string): Answers {
  const word = (table: string | null, key: string): string => (valueOf(text, table, key) ?? "").replaceAll('"', "");
  const listed = valueOf(text, "passes", "corrections")?.split(",").length ?? 1;
  const isIso = word("program", "format") === "iso";
  return {
    wire: word(null, "wire-diameter") || WIRE,
    gap: word(null, "gap") || GAP,
    passes: listed,
    machine: isIso || word("program", "profile") !== "" ? word("program", "profile") || "generic" : "3b",
    side: word(null, "side"),
    thickness: word("job", "thickness"),
    drawnAs: word("pair", "drawn-as"),
    clearance: word("pair", "clearance"),
  };
}

/** The text with these answers, where they are others than it gives. */
export function withAnswers(text: string, answers: Answers): string {
  const before = answersOf(text);
  const quoted = (word: string): string | null => (word === "" ? null : JSON.stringify(word));
  const number = (word: string): string | null => (word === "" ? null : String(Number(word)));
  const list = (lengths: readonly number[]): string => `[${lengths.map((mm) => mm.toFixed(4)).join(", ")}]`;
  const [wire, gap] = [Number(answers.wire), Number(answers.gap)];
  let kept = withKey(withKey(text, null, "wire-diameter", String(wire)), null, "gap", String(gap));
  kept = withKey(kept, null, "side", quoted(answers.side));
  const isOther = answers.passes !== before.passes || Number(before.wire) !== wire || Number(before.gap) !== gap;
  if (isOther && (answers.passes > 1 || before.passes > 1)) {
    const several = answers.passes > 1;
    const gaps = Array.from({ length: answers.passes }, (_, pass) => (pass === 0 ? gap : gap / 2));
    kept = withKey(kept, "passes", "corrections", several ? list(correctionsOf(wire, gap, answers.passes)) : null);
    kept = withKey(kept, "passes", "gaps", several ? list(gaps) : null);
  }
  if (answers.machine !== before.machine || text === "") {
    kept = withKey(kept, "program", "format", answers.machine === "3b" ? (valueOf(kept, "program", "format") === undefined ? null : '"3b"') : '"iso"');
    kept = withKey(kept, "program", "profile", answers.machine === "3b" ? null : quoted(answers.machine));
  }
  kept = withKey(kept, "job", "thickness", number(answers.thickness));
  kept = withKey(kept, "pair", "drawn-as", quoted(answers.drawnAs));
  return withKey(kept, "pair", "clearance", number(answers.clearance));
}

export class SettingsForm {
  constructor(
    private readonly server: Server,
    private readonly shown: () => Doc | null,
    private readonly root: string,
  ) {}

  /** The wedm.toml that holds for a document, or the one that would stand beside it. */
  async #fileOf(doc: Doc | null): Promise<string> {
    if (doc === null) {
      return `${this.root.replace(/\/$/, "")}/wedm.toml`;
    }
    const { file }: Partial<SettingsInForce> = await this.server.request("wedm/settings", { uri: doc.uri });
    const near = doc.revision === null ? doc.saveAs : doc.uri;
    return file ?? (near === null ? `${this.root.replace(/\/$/, "")}/wedm.toml` : beside(near, "wedm.toml"));
  }

  /** Changes the text of the wedm.toml that holds for a document, and tells the server. */
  async change(doc: Doc, change: (text: string) => string): Promise<void> {
    const file = await this.#fileOf(doc);
    await rewrite(file, change);
    this.server.settingsChanged([file]);
  }

  /** What was found in a wedm.toml, of which the server tells without being asked. */
  diagnosed(file: string, found: readonly Diagnostic[]): void {
    for (const { message } of found.filter(({ severity }) => severity === 1).slice(0, 2)) {
      say(`${nameOf(file)}: ${message}`, "error");
    }
  }

  /** Keeps the settings of one contour of the drawing, under its name. */
  async keepContour(handles: readonly string[], said: Said): Promise<void> {
    const doc = this.shown();
    if (doc !== null) {
      // To leave a contour uncut, every entity of it must be named.
      const named = said.side === "ignore" ? handles : handles.slice(0, 1);
      await this.change(doc, (text) => named.reduce((kept, handle) => keepContour(kept, doc.name, handle, said), text));
    }
  }

  /** Asks for wire, gap and machine, and shows the correction that follows. */
  async open(isFirst = false, uri?: string): Promise<void> {
    const file = uri ?? (await this.#fileOf(this.shown()));
    const text = new TextDecoder().decode((await readIfThere(file))?.bytes ?? new Uint8Array());
    const answers = answersOf(text);
    const number = (key: keyof Answers, name: string, unit = "mm"): HTMLElement => {
      const field = make("input", { type: "number", min: 0, step: "any", name: key, value: answers[key], "aria-label": name });
      return make("label", { class: "field" }, make("span", { text: name }), field, unit);
    };
    const choice = (key: keyof Answers, name: string, options: [string, string][]): HTMLElement => {
      const field = make("select", { name: key, "aria-label": name });
      for (const [value, text] of options) {
        field.append(make("option", { value, text, selected: String(answers[key]) === value }));
      }
      return make("label", { class: "field" }, make("span", { text: name }), field);
    };
    const notSet: [string, string] = ["", t("not set")];
    const sides: [string, string][] = [
      notSet, ["auto", t("by nesting")], ["opening", t("Opening")], ["punch", t("Punch")], ["both", t("both sides")],
    ];
    const read = machines().map(({ label, profile }): [string, string] => [profile, label]);
    const known = read.some(([profile]) => profile === answers.machine) ? [] : [[answers.machine, `ISO: ${answers.machine}`] satisfies [string, string]];
    const follows = make("p", { class: "follows", role: "status" });
    const main = [
      number("wire", t("Wire Ø")), number("gap", t("Spark gap")), choice("machine", t("Machine"), [...read, ...known]),
      choice("passes", t("Passes"), Array.from({ length: 9 }, (_, pass) => [String(pass + 1), String(pass + 1)])),
    ];
    const others = [
      choice("side", t("Side"), sides), number("thickness", t("Thickness")),
      choice("drawnAs", t("Pair: drawn is"), [notSet, ["punch", t("the punch")], ["plate", t("the plate")]]), number("clearance", t("Pair: clearance")),
    ];
    const form = make("div", { class: "form" }, ...main, ...others);
    const told = (): void => {
      const { wire, gap, passes, drawnAs } = readForm(form);
      // The parts of a pair have their sides by what they are.
      const side = form.querySelector<HTMLSelectElement>("[name=side]");
      if (side !== null) {
        side.disabled = drawnAs !== "";
        side.value = side.disabled ? "" : side.value;
      }
      const corrections = correctionsOf(Number(wire), Number(gap), passes);
      const isGood = Number(wire) > 0 && Number(gap) > 0;
      follows.textContent = isGood ? t("Correction: {0} mm", corrections.map((mm) => mm.toFixed(4)).join(" / ")) : t("expected a number above 0, in mm");
      const save = document.querySelector<HTMLButtonElement>("dialog [data-choice=save]");
      if (save !== null) {
        save.disabled = !isGood;
      }
    };
    form.addEventListener("input", told);
    told();
    const intro = isFirst ? [make("p", { text: t("There is no wedm.toml here yet. What cuts on your machine?") })] : [];
    const title = isFirst ? t("Wire, gap and machine") : t("Settings");
    const way = make("p", { class: "note", text: nameOf(file) });
    const answer = await ask(title, [{ name: "save", text: t("Keep in wedm.toml"), kind: "primary" }], ...intro, form, follows, way);
    if (answer === "save") {
      const said = readForm(form);
      await rewrite(file, (text) => withAnswers(text, said));
      this.server.settingsChanged([file]);
      say(t("{0} is saved.", nameOf(file)));
    }
  }
}

function readForm(form: HTMLElement): Answers {
  const value = (key: keyof Answers): string => form.querySelector<HTMLInputElement | HTMLSelectElement>(`[name=${key}]`)?.value ?? "";
  return {
    wire: value("wire"), gap: value("gap"), passes: Number(value("passes")), machine: value("machine"),
    side: value("side"), thickness: value("thickness"), drawnAs: value("drawnAs"), clearance: value("clearance"),
  };
}
