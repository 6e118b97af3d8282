// What is made of a drawing: programs, those of a pair, pictures, the drill list.

import { withKey } from "../../picture/keep";
import { partFile, toldOfPart } from "../../picture/parts";
import { choices } from "../../picture/profiles";
import { ENDINGS, type Format, TITLES, told } from "../../picture/programs";
import type { HoleForm, Methods, PictureForm, Settings } from "../../picture/protocol";
import { PAIR_IS_NOT_SET, SIDE_IS_NOT_KNOWN } from "../../picture/refusals";
import { t } from "../../picture/words";
import { report } from "./api";
import { ask, type Item, say } from "./ask";
import type { Bench } from "./bench";
import type { Doc } from "./doc";
import { beside, download, make, stemOf } from "./dom";
import { Refusal } from "./rpc";
import { save } from "./save";
import type { Server } from "./server";
import type { SettingsForm } from "./settings";

type Side = "auto" | "opening" | "punch";

export class Programs {
  constructor(
    private readonly server: Server,
    private readonly bench: () => Bench,
    private readonly form: SettingsForm,
  ) {}

  /** What the menu offers for a drawing. */
  items(): Item[] {
    const profiles = choices(null, []).flatMap(({ profile }) => (profile === undefined ? [] : [profile]));
    const simple = (["3b", "4b", "iso"] as const).map((format): Item => ({ name: format, text: TITLES[format](), act: () => this.generate(format) }));
    const iso = profiles.map((profile): Item => ({ name: `iso-${profile}`, text: `ISO: ${profile}`, act: () => this.generate("iso", profile) }));
    return [...simple, ...iso, { name: "pair", text: t("Programs of the pair (3B)"), act: () => this.pair() }];
  }

  /** Makes the program and shows it; it is saved when its reader says so. */
  async generate(format: Format, profile?: string): Promise<void> {
    const { doc } = this.bench();
    if (doc === null) {
      return;
    }
    const made = await this.#attempt("wedm/generate", doc, format, profile === undefined ? {} : { program: { profile } });
    if (made !== null) {
      await this.#show(doc, `${stemOf(doc.name)}.${ENDINGS[format][0]}`, made.program);
      say(`${TITLES[format]()}: ${told(made, format)}`);
    }
  }

  async pair(): Promise<void> {
    const { doc } = this.bench();
    const made = doc === null ? null : await this.#attempt("wedm/pair", doc, "3b", {});
    if (doc === null || made === null) {
      return;
    }
    for (const { part, program } of made.programs) {
      await this.#show(doc, partFile(stemOf(doc.name), part, "3b"), program);
    }
    say(t("{0}: {1}.", "3B", made.programs.map(toldOfPart).join(t("; "))));
  }

  async #show(doc: Doc, name: string, program: string): Promise<void> {
    const target = doc.revision === null ? null : beside(doc.uri, name);
    await this.bench().openMemory(name, new TextEncoder().encode(program), target);
  }

  /** Saves what was made in memory where it belongs, else hands it to the browser. */
  async keep(doc: Doc): Promise<void> {
    if (doc.saveAs === null) {
      download(doc.name, doc.source.bytes as BlobPart);
    } else if (await save(doc.saveAs, doc.source.bytes)) {
      this.bench().forget(doc.uri);
      await this.bench().open(doc.saveAs, doc.uri);
      say(t("{0} is saved.", doc.name));
    }
  }

  /** Asks again as what was refused is answered; null where nobody wants it. */
  async #attempt<M extends "wedm/generate" | "wedm/pair">(method: M, doc: Doc, format: Format, own: Settings): Promise<Methods[M]["result"] | null> {
    let options = own;
    let force = false;
    for (;;) {
      try {
        const params = { uri: doc.uri, format, options, ...(force ? { force } : {}) };
        return await this.server.request<M>(method, params);
      } catch (error) {
        if (!(error instanceof Refusal)) {
          throw error;
        }
        const listed = (error.data as { diagnostics?: unknown[] } | undefined)?.diagnostics ?? [];
        if (options.side === undefined && SIDE_IS_NOT_KNOWN.test(error.message)) {
          const side = await this.#askSide(doc);
          if (side === null) {
            return null;
          }
          options = { ...options, side };
        } else if (PAIR_IS_NOT_SET.test(error.message)) {
          say(t("No program: {0}.", error.message), "error", { [t("Settings")]: () => this.form.open() });
          return null;
        } else if (listed.length > 0 && !force) {
          force = await this.#askForce(error.message);
          if (!force) {
            return null;
          }
        } else {
          throw new Error(t("No program: {0}.", error.message));
        }
      }
    }
  }

  async #askForce(reason: string): Promise<boolean> {
    const text = make("p", { text: t("No program: {0}.", reason) });
    return (await ask(t("There are errors in the drawing"), [{ name: "force", text: t("Generate All the Same") }], text)) === "force";
  }

  async #askSide(doc: Doc): Promise<Side | null> {
    const keeps = make("input", { type: "checkbox", id: "keep-side" });
    keeps.checked = doc.revision !== null;
    const keep = doc.revision === null ? "" : make("label", {}, keeps, t("Keep in wedm.toml"));
    const sides: [Side, string, string][] = [
      ["auto", t("By Nesting"), t("What lies outermost is a punch, a contour within it an opening, and so on")],
      ["opening", t("Opening: Wire Inside"), t("What falls out is scrap, as of a die's plate")],
      ["punch", t("Punch: Wire Outside"), t("What falls out is the part")],
    ];
    const meant = sides.map(([, name, detail]) => make("p", {}, make("strong", { text: name }), ` ${detail}`));
    const more = make("p", { class: "note", text: t("For each contour by itself: click it in the picture.") });
    const side = (await ask(t("Which Side Does the Wire Run On?"), sides.map(([name, text]) => ({ name, text })), ...meant, more, keep)) as Side | null;
    if (side !== null && doc.revision !== null && keeps.checked) {
      await this.form.change(doc, (text) => withKey(text, null, "side", JSON.stringify(side)));
    }
    return side;
  }

  async picture(form: PictureForm): Promise<void> {
    const { doc } = this.bench();
    if (doc !== null) {
      const { data } = await this.server.request("wedm/export", { uri: doc.uri, format: form });
      await this.#deliver(doc, `${stemOf(doc.name)}.${form}`, bytesOf(data));
    }
  }

  async holes(form: HoleForm): Promise<void> {
    const { doc } = this.bench();
    if (doc !== null) {
      const { data } = await this.server.request("wedm/holes", { uri: doc.uri, format: form });
      await this.#deliver(doc, `${stemOf(doc.name)}-holes.${form}`, bytesOf(data));
    }
  }

  /** Only of a file: it is made of what is on disk. */
  async report(): Promise<void> {
    const { doc } = this.bench();
    if (doc !== null && doc.revision !== null) {
      await this.#deliver(doc, `${stemOf(doc.name)}-report.html`, await report(doc.uri));
    }
  }

  async #deliver(doc: Doc, name: string, bytes: Uint8Array): Promise<void> {
    const near = doc.revision === null ? doc.saveAs : doc.uri;
    if (near === null) {
      download(name, bytes as BlobPart);
    } else if (await save(beside(near, name), bytes)) {
      say(t("{0} is saved.", name), "information", { [t("Download")]: () => { download(name, bytes as BlobPart); } });
    }
  }
}

function bytesOf(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}
