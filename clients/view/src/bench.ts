// The bench: one document, its picture and its lists, which follow each other and the file on disk.

import type { Host } from "../../picture/host";
import type { Contour, Fault, FromPage, Shown } from "../../picture/messages";
import { Picture } from "../../picture/picture";
import type { Contours, Diagnostic, Picture as Drawn, Repair, SettingsInForce, SimulatedBlock } from "../../picture/protocol";
import { contoursOf, faultOf, faultsOfFit } from "../../picture/shown";
import { t } from "../../picture/words";
import { whyOf } from "../../picture/why";
import { type FileEntry, read } from "./api";
import { complain, say } from "./ask";
import { difference, type Doc, inMemory, isDrawing, languageOfFile, ofFile } from "./doc";
import { nameOf } from "./dom";
import type { Right } from "./right";
import { Refusal } from "./rpc";
import { CONTENT_MODIFIED, type Server } from "./server";

/** What the server answers about a document. */
type Answers = [Drawn, SettingsInForce, Contours | null, SimulatedBlock[]];

/** What the bench hands on. */
export interface Around {
  right: Right;
  /** Another document is in front, or it is known better. */
  turned: (doc: Doc) => void;
  /** What would repair a finding of a program. */
  repairsOf: (doc: Doc, finding: Diagnostic) => Promise<Repair[]>;
  fix: (finding: Diagnostic, title: string) => Promise<void>;
  keep: (handles: readonly string[], said: Extract<FromPage, { type: "say" }>["said"]) => Promise<void>;
  explain: (rule: string) => Promise<void>;
  exportPicture: () => void;
}

export class Bench implements Host {
  readonly #picture: Picture;
  readonly #memory = new Map<string, Doc>();
  #doc: Doc | null = null;
  #version = 0;
  #found: readonly Diagnostic[] | null = null;
  /** What was asked with the text itself; the first picture of it takes it. */
  #answers: Promise<Answers> | null = null;
  #faults: readonly Fault[] = [];
  #listed: Contours | null = null;
  #contours: readonly Contour[] = [];
  #settings: SettingsInForce | null = null;
  #repairs: readonly Repair[] = [];
  /** The findings before the file was saved again; null when nothing is compared. */
  #before: readonly Fault[] | null = null;
  #fresh: ReadonlySet<string> = new Set();
  #isDrawing = false;
  #isStale = false;
  #isFit = false;
  #madeOf: string | undefined;
  /** Counts what is opened: of two that are asked for, the later one is shown. */
  #opening = 0;

  constructor(
    private readonly server: Server,
    private readonly around: Around,
  ) {
    this.#picture = new Picture(this);
  }

  get doc(): Doc | null {
    return this.#doc;
  }

  get picture(): Picture {
    return this.#picture;
  }

  get settings(): SettingsInForce | null {
    return this.#settings;
  }

  get memory(): Doc[] {
    return [...this.#memory.values()];
  }

  get isFit(): boolean {
    return this.#isFit;
  }

  get contours(): readonly Contour[] {
    return this.#contours;
  }

  get faults(): readonly Fault[] {
    return this.#faults;
  }

  /** Opens a file, or what is in memory under that address. `madeOf` is the document whose view stays. */
  async open(uri: string, madeOf?: string): Promise<void> {
    const kept = this.#memory.get(uri);
    if (kept !== undefined) {
      await this.turnTo(kept, madeOf);
      return;
    }
    this.#opening += 1;
    const opening = this.#opening;
    const { bytes, revision } = await read(uri);
    if (opening !== this.#opening) {
      return;
    }
    const language = languageOfFile(nameOf(uri), new TextDecoder().decode(bytes.subarray(0, 65_536))) ?? "dxf";
    await this.turnTo(ofFile(uri, language, bytes, revision), madeOf);
  }

  /** Opens what was dropped or made. */
  async openMemory(name: string, bytes: Uint8Array, saveAs: string | null, madeOf?: string): Promise<void> {
    const language = languageOfFile(name, new TextDecoder().decode(bytes.subarray(0, 65_536)));
    if (language === null) {
      throw new Error(t("{0} is neither a drawing nor a program", name));
    }
    const doc = inMemory(name, language, bytes, saveAs);
    this.#memory.set(doc.uri, doc);
    await this.turnTo(doc, madeOf);
  }

  forget(uri: string): void {
    this.#memory.delete(uri);
    this.server.close(uri);
  }

  async turnTo(doc: Doc, madeOf?: string): Promise<void> {
    const last = this.#doc;
    if (last !== null && last.uri !== doc.uri && !this.#memory.has(last.uri)) {
      this.server.close(last.uri);
    }
    const isSame = last?.uri === doc.uri;
    this.#doc = doc;
    this.#found = null;
    this.#answers = null;
    this.#madeOf = madeOf;
    this.#isFit = false;
    if (!isSame) {
      this.#fresh = new Set();
      this.#before = null;
    }
    document.body.classList.remove("writing");
    this.around.turned(doc);
    if (doc.source.isBinary) {
      this.server.close(doc.uri);
      this.#nothing(doc, t("{0} is a binary file. Save it as DXF in text form (ASCII) in your CAD program.", doc.name));
      return;
    }
    this.#picture.receive({ type: "busy", busy: true });
    const version = await this.server.put(doc.uri, doc.language, doc.source.text);
    if (doc === this.#doc) {
      this.#version = version;
      this.#answers = this.#ask(doc);
      // It is asked again where this fails.
      this.#answers.catch(() => undefined);
    }
  }

  /** The file of the document has been written: its new text takes the place of the old one, and what is new and gone is said. */
  async saved(uri: string): Promise<void> {
    const doc = this.#doc;
    if (doc?.uri !== uri) {
      return;
    }
    const { bytes, revision } = await read(uri);
    const isOther = bytes.length !== doc.source.bytes.length || bytes.some((byte, index) => byte !== doc.source.bytes[index]);
    if (this.#doc !== doc) {
      return;
    }
    document.body.classList.remove("writing");
    if (isOther) {
      this.#before ??= this.#faults;
      await this.turnTo(ofFile(uri, doc.language, bytes, revision));
    } else {
      doc.revision = revision;
    }
  }

  writing(uri: string): void {
    if (this.#doc?.uri === uri) {
      document.body.classList.add("writing");
    }
  }

  /** The files that there are: what is shown may be gone. */
  listed(files: readonly FileEntry[]): void {
    const doc = this.#doc;
    if (document.body.classList.contains("writing") && doc !== null && files.every(({ uri }) => uri !== doc.uri)) {
      document.body.classList.remove("writing");
      say(t("{0} is no longer there.", doc.name), "warning");
    }
  }

  diagnosed(uri: string, version: number | null, found: readonly Diagnostic[]): void {
    if (uri === this.#doc?.uri && version === this.#version) {
      this.#found = found;
      void this.#draw();
    }
  }

  async fit(shown: boolean): Promise<void> {
    this.#isFit = shown;
    await this.#draw();
  }

  /** One picture at a time; what changes meanwhile is drawn next. */
  async #draw(): Promise<void> {
    this.#isStale = true;
    if (this.#isDrawing) {
      return;
    }
    this.#isDrawing = true;
    this.#picture.receive({ type: "busy", busy: true });
    while (this.#isStale) {
      this.#isStale = false;
      const [doc, found] = [this.#doc, this.#found];
      try {
        if (doc !== null && found !== null) {
          await this.#drawOne(doc, found);
        }
      } catch (error) {
        this.#failed(error);
      }
    }
    this.#isDrawing = false;
    this.#picture.receive({ type: "busy", busy: false });
  }

  /** What has changed meanwhile is drawn again when its findings come. */
  #failed(error: unknown): void {
    if (error instanceof Refusal && error.code === CONTENT_MODIFIED) {
      return;
    }
    const reason = error instanceof Error ? error.message : String(error);
    this.#picture.receive({ type: "trouble", message: reason });
    if (this.#isFit) {
      this.#isFit = false;
      say(reason, "error");
      this.#isStale = true;
    }
    if (this.#doc !== null) {
      this.around.turned(this.#doc);
    }
  }

  async #drawOne(doc: Doc, found: readonly Diagnostic[]): Promise<void> {
    const { uri, name } = doc;
    if (this.#isFit) {
      const fit = await this.server.request("wedm/fit", { uri });
      this.#show(doc, { kind: "fit", svg: fit.svg, faults: faultsOfFit(fit), contours: [], blocks: [], lines: [] });
      return;
    }
    const early = this.#answers ?? this.#ask(doc);
    this.#answers = null;
    const [{ svg, pieces }, settings, listed, blocks] = await early.catch(() => this.#ask(doc));
    if (doc !== this.#doc || found !== this.#found) {
      this.#isStale = true;
      return;
    }
    this.#settings = settings;
    this.#listed = listed;
    const contours = listed === null ? [] : contoursOf(listed, settings);
    const faults = found.map(({ severity, code, message, range, data }) =>
      faultOf({ severity: severity - 1, rule: code, message, line: range.start.line, data }, listed?.unitsToMm ?? 1));
    this.#compare(name, faults);
    const isDxf = isDrawing(doc);
    const lines = isDxf ? [] : doc.source.text.split(/\r\n|\n|\r/);
    this.#show(doc, { kind: isDxf ? "drawing" : "program", svg, ...(pieces === undefined ? {} : { pieces }), faults, contours, blocks, lines });
  }

  #ask(doc: Doc): Promise<Answers> {
    const { uri } = doc;
    const isDxf = isDrawing(doc);
    return Promise.all([
      this.server.request("wedm/picture", { uri, pieces: true }),
      this.server.request("wedm/settings", { uri }),
      isDxf ? this.server.request("wedm/contours", { uri, segments: false }) : null,
      // Without its blocks the wire can still be played; only its figures are missing.
      isDxf ? [] : this.server.request("wedm/simulate", { uri }).then((answer) => answer.blocks, () => []),
    ]);
  }

  #show({ uri, name }: Doc, shown: Pick<Shown, "kind" | "svg" | "pieces" | "faults" | "contours" | "blocks" | "lines">): void {
    this.#faults = shown.faults;
    this.#contours = shown.contours;
    const madeOf = this.#madeOf === undefined ? {} : { madeOf: this.#madeOf };
    this.#picture.receive({ type: "picture", uri, name, ...shown, ...madeOf, isEditor: shown.kind !== "fit", keeps: uri.startsWith("file:") });
    this.around.right.put({ isDrawing: shown.kind !== "program", faults: shown.faults, contours: shown.contours, fresh: this.#fresh, lines: shown.lines });
    if (this.#doc !== null) {
      this.around.turned(this.#doc);
    }
  }

  /** Nothing can be drawn: the reason stands in the empty space. */
  #nothing(doc: Doc, reason: string): void {
    const svg = '<svg xmlns="http://www.w3.org/2000/svg"><text class="note"></text></svg>';
    const faults: Fault[] = [{ severity: "error", rule: "syntax", message: reason, line: 0 }];
    this.#show(doc, { kind: "drawing", svg, faults, contours: [], blocks: [], lines: [] });
    this.#picture.receive({ type: "busy", busy: false });
  }

  #compare(name: string, faults: readonly Fault[]): void {
    if (this.#before === null) {
      return;
    }
    const { fresh, added, gone } = difference(this.#before, faults);
    this.#before = null;
    this.#fresh = fresh;
    const what = added + gone === 0 ? t("the findings are the same") : t("{0} new, {1} gone", added, gone);
    say(t("{0} was saved: {1}.", name, what), added > 0 ? "warning" : "information");
  }

  async radii(): ReturnType<ConstructorParameters<typeof Right>[0]["radii"]> {
    const inspection = await this.server.request("wedm/inspect", { uri: this.#doc?.uri ?? "" });
    return { inspection, contours: this.#listed ?? { unitsToMm: inspection.unitsToMm, contours: [] } };
  }

  /** What is pointed at in the picture. */
  hear(message: FromPage): void {
    const { right } = this.around;
    switch (message.type) {
      case "segment":
        right.markSegment(message.handle, message.segment);
        break;
      case "line":
        right.markLine(message.line);
        break;
      case "playing":
        // The line stays marked where the wire has stopped.
        if (message.line !== null) {
          right.markLine(message.line);
        }
        break;
      case "fault":
        right.markFault(message.fault);
        this.#lookAt(message.fault).catch(complain);
        break;
      case "fix": {
        const [finding, repair] = [this.#found?.[message.fault], this.#repairs[message.repair]];
        if (finding !== undefined && repair !== undefined) {
          this.around.fix(finding, repair.title).catch(complain);
        }
        break;
      }
      case "explain":
        this.around.explain(message.rule).catch(complain);
        break;
      case "say":
        this.around.keep(message.handles, message.said).catch(complain);
        break;
      case "export":
        this.around.exportPicture();
        break;
      // The page has a toolbar of its own for all drawings: the picture shows no such buttons here.
      case "fixAll":
      case "program":
      case "ready":
      case "text":
        break;
    }
  }

  /** Why a finding is one, and what would repair it. */
  async #lookAt(fault: number): Promise<void> {
    const [doc, finding] = [this.#doc, this.#faults[fault]];
    if (doc === null || finding === undefined || this.#isFit) {
      return;
    }
    const { handle, segment, rule } = finding;
    const asked = { uri: doc.uri, rule, handle: handle ?? "", ...(segment === undefined ? {} : { segment }) };
    const diagnostic = this.#found?.[fault];
    const [page, repairs] = await Promise.all([
      this.server.request("wedm/rulePage", { rule }).catch(() => ({ text: "" })),
      handle !== undefined ? this.server.request("wedm/repairs", asked).then((answer) => answer.repairs, () => [])
        : diagnostic === undefined ? [] : this.around.repairsOf(doc, diagnostic).catch(() => []),
    ]);
    this.#repairs = repairs;
    this.#picture.receive({ type: "card", card: { fault, why: whyOf(page.text), repairs } });
  }
}
