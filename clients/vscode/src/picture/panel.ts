// The live picture: made anew after each edit, and at one with the cursor in both directions.

import * as vscode from "vscode";
import { LSPErrorCodes, ResponseError } from "vscode-languageclient/node";
import { isDrawing, isOurs } from "../languages";
import { reveal, revealLine, segmentAt } from "../place";
import type { SimulatedBlock } from "../protocol";
import type { Server } from "../server/server";
import { type Fault, fromPage, type FromPage, type ToPage } from "./messages";
import { page } from "./page";
import { t } from "../words";

export const VIEW_TYPE = "wedm.picture";
/** A picture is made at most this often while somebody types, in ms. */
const CALM = 120;
/** The picture of a very large drawing takes long: at least half of the time is left for everything else, up to this wait. */
const LONGEST_CALM = 5_000;
/** More chips than this nobody reads; all of them are under Problems. */
const FAULTS = 200;

export class Picture implements vscode.Disposable {
  readonly #panel: vscode.WebviewPanel;
  readonly #subscriptions: vscode.Disposable[];
  readonly #travelled: vscode.TextEditorDecorationType;
  #uri: vscode.Uri;
  #ready = false;
  #stale = true;
  #making = false;
  #playWhenShown = false;
  #marked: readonly string[] | null = null;
  #calm = CALM;
  #timer: NodeJS.Timeout | undefined;
  #cursorTimer: NodeJS.Timeout | undefined;

  constructor(
    panel: vscode.WebviewPanel,
    uri: vscode.Uri,
    private readonly server: Server,
    extension: vscode.Uri,
    private readonly closed: () => void,
  ) {
    this.#panel = panel;
    this.#uri = uri;
    this.#travelled = vscode.window.createTextEditorDecorationType({
      isWholeLine: true,
      backgroundColor: new vscode.ThemeColor("editor.rangeHighlightBackground"),
      overviewRulerColor: new vscode.ThemeColor("editorInfo.foreground"),
    });
    panel.webview.options = { enableScripts: true, localResourceRoots: [vscode.Uri.joinPath(extension, "dist")] };
    panel.iconPath = vscode.Uri.joinPath(extension, "icons", "dxf.svg");
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
        if (editor !== undefined && isOurs(editor.document)) {
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
      this.#calm = Math.min(Math.max(Date.now() - began, CALM), LONGEST_CALM);
    }
    if (this.#stale || uri.toString() !== this.#uri.toString()) {
      this.#soon();
    }
  }

  async #draw(uri: vscode.Uri): Promise<void> {
    const document = await vscode.workspace.openTextDocument(uri);
    const name = uri.path.split("/").pop() ?? "";
    this.#panel.title = t("Picture of {0}", name);
    const kind = isDrawing(document.languageId) ? "drawing" : "program";
    const { svg } = await this.server.request("wedm/picture", { uri: uri.toString() });
    const blocks = kind === "program" ? await this.#blocks(uri) : [];
    await this.#tell({ type: "picture", uri: uri.toString(), name, kind, svg, faults: faultsOf(uri), blocks });
    const editor = vscode.window.visibleTextEditors.find((editor) => editor.document.uri.toString() === uri.toString());
    if (this.#marked !== null) {
      await this.#tell({ type: "contour", handles: [...this.#marked] });
    } else if (editor !== undefined) {
      await this.#point(editor);
    }
    if (this.#playWhenShown) {
      this.#playWhenShown = false;
      await this.#tell({ type: "play" });
    }
  }

  /** Without them the wire can be played all the same; its figures are missing then. */
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

  /** Shows where the cursor stands. */
  async #point(editor: vscode.TextEditor): Promise<void> {
    const position = editor.selection.active;
    if (!isDrawing(editor.document.languageId)) {
      await this.#tell({ type: "line", line: position.line });
      return;
    }
    const located = await segmentAt(this.server, editor.document.uri, position);
    await this.#tell({ type: "segment", handle: located?.handle ?? null, segment: located?.segment ?? null });
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
        await reveal(this.server, this.#uri, message.handle, message.segment ?? undefined, false);
        break;
      case "line":
        await revealLine(this.#uri, message.line, false);
        break;
      case "playing":
        this.#follow(message.line);
        break;
    }
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
    this.closed();
  }
}

/** Errors and warnings with a place that can be shown. */
function faultsOf(uri: vscode.Uri): Fault[] {
  const found = vscode.languages.getDiagnostics(uri).filter(({ source, severity }) => source === "wedm" && severity <= vscode.DiagnosticSeverity.Warning);
  return found.slice(0, FAULTS).map((diagnostic) => {
    const { handle, segment } = dataOf(diagnostic);
    const code = typeof diagnostic.code === "object" ? diagnostic.code.value : diagnostic.code;
    return {
      severity: diagnostic.severity === vscode.DiagnosticSeverity.Error ? "error" : "warning",
      rule: String(code ?? ""),
      message: diagnostic.message,
      line: diagnostic.range.start.line,
      ...(typeof handle === "string" ? { handle } : {}),
      ...(typeof segment === "number" ? { segment } : {}),
    };
  });
}

/** The client keeps the server's `data` on the diagnostics that it makes. */
function dataOf(diagnostic: vscode.Diagnostic): { handle?: unknown; segment?: unknown } {
  const data: unknown = (diagnostic as { data?: unknown }).data;
  return typeof data === "object" && data !== null ? data : {};
}
