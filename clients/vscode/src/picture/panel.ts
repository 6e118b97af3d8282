// The live picture: made again after each edit, and in step with the cursor in both directions.

import * as vscode from "vscode";
import { LSPErrorCodes, ResponseError } from "vscode-languageclient/node";
import { isDrawing, isOurs } from "../languages";
import { keepContour } from "../../../picture/keep";
import { rewrite, settingsFile } from "../commands/settingsFile";
import { reveal, revealLine, segmentAt } from "../place";
import type { Repair, SimulatedBlock } from "../../../picture/protocol";
import { rulePage } from "../rulePages";
import type { Server } from "../server/server";
import { type Contour, fromPage, type FromPage, type Made, type Said, type ToPage } from "../../../picture/messages";
import { page } from "./page";
import { contoursOf, faultsOfFit } from "../../../picture/shown";
import { faultOf, findings, keyOf } from "../findings";
import { whyOf } from "../../../picture/why";
import { t } from "../../../picture/words";

export const VIEW_TYPE = "wedm.picture";
/** A picture is made at most this often while somebody types, in ms. */
const CALM = 120;
/** The picture of a very large drawing takes long: at least half of the time is left for everything else, up to this wait. */
const LONGEST_CALM = 5_000;

/** The command of each program that the toolbar makes. */
const PROGRAMS: Record<Made, string> = { "3b": "wedm.generate3b", "4b": "wedm.generate4b", iso: "wedm.generateIso" };

export interface Role {
  /** True for the editor of one document; else it is beside the text, and follows whatever is in front. */
  isEditor?: boolean;
  /** It shows whether punch and plate fit, in place of the drawing. */
  isFit?: boolean;
  closed?: () => void;
}

export class Picture implements vscode.Disposable {
  readonly #panel: vscode.WebviewPanel;
  readonly #subscriptions: vscode.Disposable[];
  readonly #travelled: vscode.TextEditorDecorationType;
  #uri: vscode.Uri;
  /** The findings of the picture that is shown, and the repairs of the one that is looked at. */
  #found: vscode.Diagnostic[] = [];
  #repairs: Repair[] = [];
  #ready = false;
  #stale = true;
  #making = false;
  #playWhenShown = false;
  #marked: readonly string[] | null = null;
  /** What is to be framed as soon as the picture is there. */
  #wanted: ToPage | null = null;
  #calm = CALM;
  #timer: NodeJS.Timeout | undefined;
  #cursorTimer: NodeJS.Timeout | undefined;

  constructor(
    panel: vscode.WebviewPanel,
    uri: vscode.Uri,
    private readonly server: Server,
    extension: vscode.Uri,
    private readonly role: Role,
  ) {
    this.#panel = panel;
    this.#uri = uri;
    this.#travelled = vscode.window.createTextEditorDecorationType({
      isWholeLine: true,
      backgroundColor: new vscode.ThemeColor("editor.rangeHighlightBackground"),
      overviewRulerColor: new vscode.ThemeColor("editorInfo.foreground"),
    });
    panel.webview.options = { enableScripts: true, localResourceRoots: [vscode.Uri.joinPath(extension, "dist")] };
    if (role.isEditor !== true) {
      panel.iconPath = vscode.Uri.joinPath(extension, "icons", "dxf.svg");
    }
    this.#subscriptions = [
      this.#travelled,
      panel.webview.onDidReceiveMessage((message: unknown) => void this.#heard(fromPage(message))),
      panel.onDidChangeViewState(() => {
        if (panel.visible && this.#stale) {
          this.#soon();
        }
      }),
      panel.onDidDispose(() => {
        this.dispose();
      }),
      server.onDidDiagnose((changed) => {
        if (changed.toString() === this.#uri.toString()) {
          this.#soon();
        }
      }),
      server.onDidChangeState((state) => {
        if (state.kind === "waiting" || state.kind === "failed") {
          void this.#tell({ type: "trouble", message: state.reason });
        }
      }),
      vscode.window.onDidChangeActiveTextEditor((editor) => {
        const isFor = ({ languageId }: vscode.TextDocument): boolean => role.isFit !== true || isDrawing(languageId);
        if (role.isEditor !== true && editor !== undefined && isOurs(editor.document) && isFor(editor.document)) {
          this.show(editor.document.uri);
        }
      }),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => {
        this.#cursorMoved(textEditor);
      }),
    ];
    panel.webview.html = page(panel.webview, extension);
  }

  get panel(): vscode.WebviewPanel {
    return this.#panel;
  }

  get uri(): vscode.Uri {
    return this.#uri;
  }

  /** Selects and frames a segment, or all of these entities. */
  approach(handles: readonly string[], segment: number | null): void {
    this.#want({ type: "approach", handles: [...handles], segment });
  }

  /** Looks at a finding: it is selected and framed, and where findings are acted upon its card is opened. */
  lookAt(key: string): void {
    const fault = this.#found.findIndex((diagnostic) => keyOf(diagnostic) === key);
    if (fault >= 0) {
      this.#want({ type: "look", fault });
    }
  }

  #want(message: ToPage): void {
    this.#wanted = message;
    this.#panel.reveal(undefined, true);
    if (this.#ready && !this.#stale) {
      this.#tellWanted();
    }
  }

  #tellWanted(): void {
    if (this.#wanted !== null) {
      void this.#tell(this.#wanted);
      this.#wanted = null;
    }
  }

  /** Turns to another document. */
  show(uri: vscode.Uri): void {
    if (uri.toString() !== this.#uri.toString()) {
      this.#uri = uri;
      this.#soon();
    }
  }

  play(): void {
    this.#playWhenShown = true;
    if (this.#ready && !this.#stale) {
      this.#playWhenShown = false;
      void this.#tell({ type: "play" });
    }
  }

  /** Marks entities, in place of what the cursor stands on. */
  mark(handles: readonly string[] | null): void {
    this.#marked = handles;
    if (this.#ready && !this.#stale) {
      void this.#tell({ type: "contour", handles: [...(handles ?? [])] });
    }
  }

  #soon(): void {
    this.#stale = true;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#make(), this.#calm);
  }

  /** One picture at a time; what changes meanwhile is drawn next. */
  async #make(): Promise<void> {
    if (!this.#ready || !this.#panel.visible || this.#making) {
      return;
    }
    this.#making = true;
    const began = Date.now();
    await this.#tell({ type: "busy", busy: true });
    const uri = this.#uri;
    this.#stale = false;
    try {
      await this.#draw(uri);
    } catch (error) {
      const movedOn = error instanceof ResponseError && error.code === LSPErrorCodes.ContentModified;
      this.#stale ||= movedOn;
      if (!movedOn) {
        await this.#tell({ type: "trouble", message: error instanceof Error ? error.message : String(error) });
      }
    } finally {
      this.#making = false;
      await this.#tell({ type: "busy", busy: false });
      this.#calm = Math.min(Math.max(Date.now() - began, CALM), LONGEST_CALM);
    }
    if (this.#stale || uri.toString() !== this.#uri.toString()) {
      this.#soon();
    }
  }

  async #draw(uri: vscode.Uri): Promise<void> {
    const document = await vscode.workspace.openTextDocument(uri);
    const name = uri.path.split("/").pop() ?? "";
    if (this.role.isEditor !== true) {
      this.#panel.title = this.role.isFit === true ? t("Fit of {0}", name) : t("Picture of {0}", name);
    }
    if (this.role.isFit === true) {
      await this.#drawFit(uri, name);
      return;
    }
    const kind = isDrawing(document.languageId) ? "drawing" : "program";
    const drawn = await this.server.request("wedm/picture", { uri: uri.toString(), pieces: true });
    const blocks = kind === "program" ? await this.#blocks(uri) : [];
    const { contours, toMm, keeps } = kind === "drawing" ? await this.#contours(uri) : { contours: [], toMm: 1, keeps: false };
    const lines = kind === "program" ? document.getText().split(/\r?\n/) : [];
    this.#found = findings(uri);
    const faults = this.#found.map((diagnostic) => faultOf(diagnostic, toMm));
    const isEditor = this.role.isEditor === true;
    await this.#tell({ type: "picture", uri: uri.toString(), name, kind, ...drawn, faults, contours, blocks, lines, isEditor, keeps, makes: true });
    const editor = vscode.window.visibleTextEditors.find((editor) => editor.document.uri.toString() === uri.toString());
    if (this.#marked !== null) {
      await this.#tell({ type: "contour", handles: [...this.#marked] });
    } else if (editor !== undefined) {
      await this.#point(editor);
    }
    this.#tellWanted();
    if (this.#playWhenShown) {
      this.#playWhenShown = false;
      await this.#tell({ type: "play" });
    }
  }

  /** One outline in the other, and the places where less is left than there should be, the tightest first. */
  async #drawFit(uri: vscode.Uri, name: string): Promise<void> {
    const fit = await this.server.request("wedm/fit", { uri: uri.toString() });
    this.#found = [];
    const faults = faultsOfFit(fit);
    const nothing = { contours: [], blocks: [], lines: [], isEditor: false, keeps: false };
    await this.#tell({ type: "picture", uri: uri.toString(), name, kind: "fit", svg: fit.svg, faults, ...nothing });
  }

  /** The contours with their settings. */
  async #contours(uri: vscode.Uri): Promise<{ contours: Contour[]; toMm: number; keeps: boolean }> {
    const [listed, settings] = await Promise.all([
      this.server.request("wedm/contours", { uri: uri.toString(), segments: false }),
      this.server.request("wedm/settings", { uri: uri.toString() }),
    ]);
    return { contours: contoursOf(listed, settings), toMm: listed.unitsToMm, keeps: uri.scheme === "file" };
  }

  /** Why a finding is one, and what would repair it. */
  async #lookAt(fault: number): Promise<void> {
    const diagnostic = this.#found[fault];
    if (diagnostic === undefined) {
      return;
    }
    const { handle, segment, rule } = faultOf(diagnostic, 1);
    const asked = { uri: this.#uri.toString(), rule, handle: handle ?? "", ...(segment === undefined ? {} : { segment }) };
    const none = { repairs: [] };
    const [{ text }, { repairs }] = await Promise.all([
      this.server.request("wedm/rulePage", { rule }),
      handle === undefined ? none : this.server.request("wedm/repairs", asked).then((answer) => answer, () => none),
    ]);
    this.#repairs = repairs;
    await this.#tell({ type: "card", card: { fault, why: whyOf(text), repairs } });
  }

  /** Makes a repair by its code action, so that it is undone as any edit is. */
  async #fix(fault: number, repair: number): Promise<void> {
    const [diagnostic, wanted] = [this.#found[fault], this.#repairs[repair]];
    if (diagnostic === undefined || wanted === undefined) {
      return;
    }
    const { QuickFix } = vscode.CodeActionKind;
    const asked = [this.#uri, diagnostic.range, QuickFix.value] as const;
    const actions = await vscode.commands.executeCommand<vscode.CodeAction[]>("vscode.executeCodeActionProvider", ...asked);
    const action = actions.find(({ title, edit }) => title === wanted.title && edit !== undefined);
    if (action?.edit === undefined || !(await vscode.workspace.applyEdit(action.edit))) {
      void vscode.window.showInformationMessage(t("Wire EDM: the drawing has changed in the meantime, and the repair is no longer offered."));
    }
  }

  /** Saves the settings of a contour in wedm.toml, under the name of the drawing. */
  async #say(handles: readonly string[], said: Said): Promise<void> {
    const name = this.#uri.path.split("/").pop() ?? "";
    // To leave a contour uncut, every entity of it must be named.
    const told = said.side === "ignore" ? handles : handles.slice(0, 1);
    const target = await settingsFile(this.server, this.#uri);
    await rewrite(target, (text) => told.reduce((kept, handle) => keepContour(kept, name, handle, said), text));
  }

  /** The blocks of the program. Without them the wire can still be played; only its figures are missing. */
  async #blocks(uri: vscode.Uri): Promise<SimulatedBlock[]> {
    try {
      return (await this.server.request("wedm/simulate", { uri: uri.toString() })).blocks;
    } catch {
      return [];
    }
  }

  #cursorMoved(editor: vscode.TextEditor): void {
    if (editor.document.uri.toString() === this.#uri.toString() && this.#panel.visible) {
      clearTimeout(this.#cursorTimer);
      this.#cursorTimer = setTimeout(() => void this.#point(editor), CALM / 2);
    }
  }

  /** Shows where the cursor stands, unless entities are asked about: these stay marked. */
  async #point(editor: vscode.TextEditor): Promise<void> {
    const position = editor.selection.active;
    if (!isDrawing(editor.document.languageId)) {
      await this.#tell({ type: "line", line: position.line });
      return;
    }
    const located = await segmentAt(this.server, editor.document.uri, position);
    if (this.#marked === null) {
      await this.#tell({ type: "segment", handle: located?.handle ?? null, segment: located?.segment ?? null });
    }
  }

  async #heard(message: FromPage | null): Promise<void> {
    if (message === null) {
      return;
    }
    switch (message.type) {
      case "ready":
        this.#ready = true;
        this.#soon();
        break;
      case "segment":
        // If the text of a drawing is closed, the drawing's editor does not open it.
        if (this.role.isEditor !== true || this.#hasText()) {
          await reveal(this.server, this.#uri, message.handle, message.segment ?? undefined, false);
        }
        break;
      case "fault":
        await this.#lookAt(message.fault);
        break;
      case "fix":
        await this.#fix(message.fault, message.repair);
        break;
      case "explain":
        await vscode.commands.executeCommand("markdown.showPreview", rulePage(message.rule));
        break;
      case "say":
        await this.#say(message.handles, message.said);
        break;
      case "text":
        await vscode.commands.executeCommand("wedm.openText", this.#uri);
        break;
      case "export":
        await vscode.commands.executeCommand("wedm.exportPicture", this.#uri);
        break;
      case "fixAll":
        await vscode.commands.executeCommand("wedm.fixAll", this.#uri);
        break;
      case "program":
        await vscode.commands.executeCommand(PROGRAMS[message.format], this.#uri);
        break;
      case "line":
        await revealLine(this.#uri, message.line, false);
        break;
      case "playing":
        this.#follow(message.line);
        break;
    }
  }

  #hasText(): boolean {
    return vscode.window.visibleTextEditors.some(({ document }) => document.uri.toString() === this.#uri.toString());
  }

  /** The line that is being cut is coloured; the cursor stays where it is. */
  #follow(line: number | null): void {
    for (const editor of vscode.window.visibleTextEditors.filter((editor) => editor.document.uri.toString() === this.#uri.toString())) {
      const ranges = line === null || line >= editor.document.lineCount ? [] : [editor.document.lineAt(line).range];
      editor.setDecorations(this.#travelled, ranges);
      if (ranges[0] !== undefined) {
        editor.revealRange(ranges[0], vscode.TextEditorRevealType.InCenterIfOutsideViewport);
      }
    }
  }

  async #tell(message: ToPage): Promise<void> {
    await this.#panel.webview.postMessage(message);
  }

  dispose(): void {
    clearTimeout(this.#timer);
    clearTimeout(this.#cursorTimer);
    vscode.Disposable.from(...this.#subscriptions).dispose();
    this.role.closed?.();
  }
}
