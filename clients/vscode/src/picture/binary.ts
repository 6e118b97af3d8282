// Binary DXF and DXB: no texts, so they open as pictures that are looked at only. The program reads them from the disk.

import { open } from "node:fs/promises";
import * as vscode from "vscode";
import { SEVERITIES } from "../commands/check";
import { chooseTarget, sayIsSaved } from "../commands/exportPicture";
import { type Listed, read } from "../commands/listed";
import { complaint, optionsFor, programOf, run } from "../commands/run";
import type { Front } from "../front";
import type { Server } from "../server/server";
import { fromPage, type ToPage } from "../../../picture/messages";
import type { Contours } from "../../../picture/protocol";
import { contoursOf, faultOf } from "../../../picture/shown";
import { page } from "./page";

/** The type of the editor in the manifest. */
const BINARY = "wedm.binary";
/** What a binary DXF begins with. */
const SENTINEL = "AutoCAD Binary DXF";
/** A CAD program writes a file in several pieces. */
const CALM = 200;

export class BinaryPictures implements vscode.CustomReadonlyEditorProvider, vscode.Disposable {
  /** What is found in the files that are open, for the list of problems. */
  readonly #findings = vscode.languages.createDiagnosticCollection("wedm");
  readonly #subscriptions: vscode.Disposable;

  constructor(
    private readonly server: Server,
    private readonly front: Front,
    private readonly extension: vscode.Uri,
  ) {
    const options = { webviewOptions: { retainContextWhenHidden: true }, supportsMultipleEditorsPerDocument: true };
    this.#subscriptions = vscode.Disposable.from(
      this.#findings,
      vscode.window.registerCustomEditorProvider(BINARY, this, options),
      vscode.window.tabGroups.onDidChangeTabs(({ opened, changed }) => {
        turnAll([...opened, ...changed]);
      }),
    );
    turnAll(vscode.window.tabGroups.all.flatMap(({ tabs }) => tabs));
  }

  openCustomDocument(uri: vscode.Uri): vscode.CustomDocument {
    return { uri, dispose: () => undefined };
  }

  resolveCustomEditor({ uri }: vscode.CustomDocument, panel: vscode.WebviewPanel): void {
    new BinaryPicture(panel, uri, this.server, this.extension, this.#findings);
    const leave = (): void => {
      if (panel.active) {
        this.front.leave();
      }
    };
    panel.onDidChangeViewState(leave);
    leave();
  }

  dispose(): void {
    this.#subscriptions.dispose();
  }
}

/** By its name a binary DXF opens as a text or as a picture of one, which VS Code refuses: it is opened again as what it is. */
function turnAll(tabs: readonly vscode.Tab[]): void {
  for (const tab of tabs) {
    const uri = refusedIn(tab);
    if (uri !== undefined) {
      void turn(uri, tab.group.viewColumn);
    }
  }
}

async function turn(uri: vscode.Uri, column: vscode.ViewColumn): Promise<void> {
  if (!(await isBinary(uri))) {
    return;
  }
  await vscode.commands.executeCommand("vscode.openWith", uri, BINARY, column);
  const all = vscode.window.tabGroups.all.flatMap(({ tabs }) => tabs);
  await vscode.window.tabGroups.close(all.filter((tab) => refusedIn(tab)?.toString() === uri.toString()));
}

/** The DXF that a tab would show as a text. */
function refusedIn({ input }: vscode.Tab): vscode.Uri | undefined {
  const isText = input instanceof vscode.TabInputText || (input instanceof vscode.TabInputCustom && input.viewType !== BINARY);
  return isText && input.uri.scheme === "file" && /\.dxf$/i.test(input.uri.path) ? input.uri : undefined;
}

async function isBinary(uri: vscode.Uri): Promise<boolean> {
  try {
    const file = await open(uri.fsPath);
    try {
      const { buffer } = await file.read(Buffer.alloc(SENTINEL.length), 0, SENTINEL.length, 0);
      return buffer.toString("latin1") === SENTINEL;
    } finally {
      await file.close();
    }
  } catch {
    return false;
  }
}

/** One such file as its picture, made again when the file or the settings change. */
class BinaryPicture {
  readonly #subscriptions: vscode.Disposable;
  #timer: NodeJS.Timeout | undefined;
  #ready = false;
  /** What was asked before is no longer wanted. */
  #asked = 0;

  constructor(
    private readonly panel: vscode.WebviewPanel,
    private readonly uri: vscode.Uri,
    private readonly server: Server,
    extension: vscode.Uri,
    private readonly findings: vscode.DiagnosticCollection,
  ) {
    const beside = vscode.Uri.joinPath(uri, "..");
    const watchers = [uri.path.split("/").pop() ?? "", "wedm.toml"].map((name) => vscode.workspace.createFileSystemWatcher(new vscode.RelativePattern(beside, escaped(name))));
    const soon = (): void => {
      this.#soon();
    };
    this.#subscriptions = vscode.Disposable.from(
      ...watchers.flatMap((watcher) => [watcher, watcher.onDidChange(soon), watcher.onDidCreate(soon), watcher.onDidDelete(soon)]),
      panel.webview.onDidReceiveMessage((message: unknown) => void this.#heard(message)),
      server.onDidChangeState(({ kind }) => {
        if (kind === "running") {
          soon();
        }
      }),
      vscode.workspace.onDidChangeConfiguration((event) => {
        if (event.affectsConfiguration("wedm")) {
          soon();
        }
      }),
    );
    panel.onDidDispose(() => {
      this.#asked += 1;
      clearTimeout(this.#timer);
      this.findings.delete(uri);
      this.#subscriptions.dispose();
    });
    panel.webview.options = { enableScripts: true, localResourceRoots: [vscode.Uri.joinPath(extension, "dist")] };
    panel.webview.html = page(panel.webview, extension);
  }

  #soon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#make(), CALM);
  }

  async #heard(message: unknown): Promise<void> {
    const heard = fromPage(message);
    if (heard?.type === "ready") {
      this.#ready = true;
      await this.#make();
    } else if (heard?.type === "export") {
      await this.#export();
    }
  }

  async #make(): Promise<void> {
    if (!this.#ready) {
      return;
    }
    const asked = ++this.#asked;
    await this.#tell({ type: "busy", busy: true });
    const told = await this.#picture().catch((error: unknown): ToPage => ({ type: "trouble", message: error instanceof Error ? error.message : String(error) }));
    if (asked === this.#asked) {
      await this.#tell(told);
      await this.#tell({ type: "busy", busy: false });
    }
  }

  async #picture(): Promise<ToPage> {
    const found = await this.server.find();
    if (found.program === null) {
      return { type: "trouble", message: found.reason };
    }
    const { program } = found;
    const settings = await optionsFor(this.server, this.uri);
    const ask = (...command: string[]): ReturnType<typeof run> => run(program, [...command, ...settings, "--", this.uri.fsPath]);
    const [drawn, checked, listed] = await Promise.all([ask("draw"), ask("check", "--output", "json"), ask("contours", "--output", "json")]);
    if (!drawn.output.includes("<svg")) {
      return { type: "trouble", message: complaint("draw", drawn) };
    }
    const contours = contoursIn(listed.output);
    const own = (read(checked.output) ?? []).filter(({ path }) => path === this.uri.fsPath);
    this.findings.set(this.uri, own.map(problemOf));
    const toMm = contours?.unitsToMm ?? 1;
    const faults = own.map((listed) => faultOf({ ...listed, severity: SEVERITIES[listed.severity], line: undefined }, toMm));
    const name = this.uri.path.split("/").pop() ?? "";
    const nothing = { blocks: [], lines: [], isEditor: false, keeps: false };
    const shown = { svg: drawn.output, faults, contours: contours === null ? [] : contoursOf(contours, {}) };
    return { type: "picture", uri: this.uri.toString(), name, kind: "drawing", ...shown, ...nothing };
  }

  async #export(): Promise<void> {
    const chosen = await chooseTarget(this.uri);
    const program = chosen === undefined ? undefined : await programOf(this.server);
    if (chosen === undefined || program === undefined) {
      return;
    }
    const settings = await optionsFor(this.server, this.uri);
    // That a file may be written over, the dialog has asked.
    const outcome = await run(program, ["draw", ...settings, "--overwrite", "-o", chosen.target.fsPath, "--", this.uri.fsPath]);
    if (outcome.code === 0) {
      sayIsSaved(chosen.target);
    } else {
      void vscode.window.showErrorMessage(complaint("draw", outcome));
    }
  }

  async #tell(message: ToPage): Promise<void> {
    await this.panel.webview.postMessage(message);
  }
}

/** What stands for itself in a pattern of names. */
function escaped(name: string): string {
  return name.replace(/[[\]{}*?]/g, "[$&]");
}

function contoursIn(output: string): Contours | null {
  try {
    return JSON.parse(output) as Contours;
  } catch {
    return null;
  }
}

/** The file has no lines: VS Code lists it at its head. */
function problemOf({ message, severity, rule }: Listed): vscode.Diagnostic {
  const problem = new vscode.Diagnostic(new vscode.Range(0, 0, 0, 0), message, SEVERITIES[severity]);
  problem.source = "wedm";
  problem.code = rule;
  return problem;
}
