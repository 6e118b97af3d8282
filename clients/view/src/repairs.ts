// Repairs, one or all that are safe: written as `wedm fix` writes them, into NAME-fixed beside the file, or in its place.

import type { Diagnostic, Repair } from "../../picture/protocol";
import { t } from "../../picture/words";
import { write } from "./api";
import { say } from "./ask";
import type { Bench } from "./bench";
import type { Doc } from "./doc";
import { beside, download } from "./dom";
import { save } from "./save";
import { CONTENT_MODIFIED, REQUEST_FAILED, type Server, type TextEdit } from "./server";
import { Refusal } from "./rpc";

/** Kind of the action that makes every safe repair. */
const FIX_ALL = "source.fixAll.wedm";
const PLACE = "wedm.inPlace";
const FIXED = /-fixed(\.[^.]*)$/;

export function isInPlace(): boolean {
  return localStorage.getItem(PLACE) === "yes";
}

export function setInPlace(inPlace: boolean): void {
  localStorage.setItem(PLACE, inPlace ? "yes" : "no");
}

export class Repairs {
  constructor(
    private readonly server: Server,
    private readonly bench: () => Bench,
  ) {}

  async all(): Promise<void> {
    const { doc } = this.bench();
    if (doc === null || doc.source.isBinary) {
      return;
    }
    const end = { line: doc.source.text.split(/\r\n|\n|\r/).length, character: 0 };
    const actions = await this.#actions(doc, { start: { line: 0, character: 0 }, end }, [], FIX_ALL);
    const action = actions.find(({ kind }) => kind === FIX_ALL);
    const edits = action?.edit?.documentChanges?.flatMap((change) => change.edits);
    if (edits === undefined || edits.length === 0) {
      say(t("There is nothing that can be repaired safely."));
      return;
    }
    await this.#deliver(doc, edits, action?.data?.said);
  }

  async one(finding: Diagnostic, title: string): Promise<void> {
    const { doc } = this.bench();
    if (doc === null) {
      return;
    }
    const actions = await this.#actions(doc, finding.range, [finding], "quickfix");
    const edits = actions.find((action) => action.title === title)?.edit?.documentChanges?.flatMap((change) => change.edits);
    if (edits === undefined) {
      say(t("The text has changed in the meantime, nothing was done."), "warning");
      return;
    }
    await this.#deliver(doc, edits, undefined);
  }

  /** What would repair a finding, by the titles of its actions. */
  async of(doc: Doc, finding: Diagnostic): Promise<Repair[]> {
    const actions = await this.#actions(doc, finding.range, [finding], "quickfix");
    return actions.filter(({ edit }) => edit !== undefined).map(({ title }) => ({ title, segments: [] }));
  }

  async #actions(doc: Doc, range: Diagnostic["range"], diagnostics: Diagnostic[], only: string) {
    try {
      const context = { diagnostics, only: [only] };
      return (await this.server.request("textDocument/codeAction", { textDocument: { uri: doc.uri }, range, context })) ?? [];
    } catch (error) {
      if (error instanceof Refusal && error.code === CONTENT_MODIFIED) {
        throw new Error(t("The text has changed in the meantime, nothing was done."));
      }
      throw error instanceof Refusal && error.code === REQUEST_FAILED ? new Error(error.message) : error;
    }
  }

  async #deliver(doc: Doc, edits: readonly TextEdit[], said: string | undefined): Promise<void> {
    const bytes = doc.source.edited(edits);
    const done = said ?? t("repaired");
    const fixed = doc.name.replace(/(\.[^.]*)?$/, "-fixed$1");
    if (doc.revision === null) {
      await this.bench().openMemory(FIXED.test(doc.name) ? doc.name : fixed, bytes, doc.saveAs, doc.uri);
      say(t("{0}: {1}.", doc.name, done), "information", doc.saveAs === null ? { [t("Download")]: () => { download(fixed, bytes as BlobPart); } } : {});
      return;
    }
    if (isInPlace() || FIXED.test(doc.name)) {
      await this.#inPlace(doc, bytes, done);
      return;
    }
    const target = beside(doc.uri, fixed);
    if (await save(target, bytes)) {
      await this.bench().open(target, doc.uri);
      say(t("{0}: {1}. Written to {2}.", doc.name, done, fixed), "information", { [t("Back to {0}", doc.name)]: () => this.bench().open(doc.uri, target) });
    }
  }

  /** What was there comes back by Undo, unless somebody has written the file meanwhile. */
  async #inPlace(doc: Doc, bytes: Uint8Array, done: string): Promise<void> {
    const revision = await write(doc.uri, bytes, doc.revision);
    await this.bench().open(doc.uri);
    say(t("{0}: {1}.", doc.name, done), "information", {
      [t("Undo")]: async () => {
        await write(doc.uri, doc.source.bytes, revision);
        await this.bench().open(doc.uri);
      },
    });
  }
}
