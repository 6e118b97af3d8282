// The radius list: vertex, radius, verdict; a click leads to the picture or to the text, whichever is looked at.

import * as vscode from "vscode";
import { faultOf, findings } from "../findings";
import type { Front } from "../front";
import { isDrawing, isOurs } from "../languages";
import type { Pictures } from "../picture/pictures";
import { segmentAt } from "../place";
import type { Server } from "../server/server";
import { type EntityRow, type Row, rows, summary } from "../../../picture/rows";
import { t } from "../../../picture/words";

/** Edits come in bursts, and a long list is not made for each. */
const CALM = 250;

export class Radii implements vscode.TreeDataProvider<Row>, vscode.Disposable {
  readonly #changed = new vscode.EventEmitter<undefined>();
  readonly onDidChangeTreeData = this.#changed.event;
  readonly #view: vscode.TreeView<Row>;
  readonly #subscriptions: vscode.Disposable[];
  #document: vscode.Uri | undefined;
  #rows: EntityRow[] = [];
  #onlyFaults = false;
  #stale = true;
  #timer: NodeJS.Timeout | undefined;
  /** What was asked before is no longer wanted. */
  #asked = 0;

  constructor(
    private readonly server: Server,
    front: Front,
    private readonly pictures: Pictures,
  ) {
    this.#view = vscode.window.createTreeView("wedm.radii", { treeDataProvider: this, showCollapseAll: true });
    this.#subscriptions = [
      this.#view,
      this.#changed,
      server.onDidDiagnose((uri) => {
        if (uri.toString() === this.#document?.toString()) {
          this.#soon();
        }
      }),
      server.onDidChangeState(() => {
        this.#soon();
      }),
      this.#view.onDidChangeVisibility(({ visible }) => {
        if (visible && this.#stale) {
          void this.#refresh();
        }
      }),
      front.onDidChange(() => {
        this.#follow(front.document);
      }),
      vscode.workspace.onDidCloseTextDocument((document) => {
        if (document.uri.toString() === this.#document?.toString()) {
          this.#document = undefined;
          this.#soon();
        }
      }),
      vscode.window.onDidChangeTextEditorSelection((event) => {
        if (event.kind !== undefined && event.textEditor.document.uri.toString() === this.#document?.toString()) {
          void this.#select(event.textEditor);
        }
      }),
    ];
    this.#follow(front.document);
  }

  async show(): Promise<void> {
    await vscode.commands.executeCommand("wedm.radii.focus");
  }

  async filter(onlyFaults: boolean): Promise<void> {
    this.#onlyFaults = onlyFaults;
    await vscode.commands.executeCommand("setContext", "wedm.radii.filtered", onlyFaults);
    await this.#refresh();
  }

  /** A program or another text in front leaves the list of the last drawing. */
  #follow(document: vscode.TextDocument | undefined): void {
    if (document !== undefined && isOurs(document) && isDrawing(document.languageId)) {
      const isNew = document.uri.toString() !== this.#document?.toString();
      this.#document = document.uri;
      if (isNew) {
        void this.#refresh();
      }
    }
  }

  #soon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#refresh(), CALM);
  }

  async #refresh(): Promise<void> {
    this.#stale = true;
    if (!this.#view.visible) {
      return;
    }
    const asked = ++this.#asked;
    const uri = this.#document;
    try {
      const list = uri === undefined ? [] : await this.#list(uri);
      if (asked !== this.#asked) {
        return;
      }
      this.#rows = list;
      this.#view.description = uri === undefined ? "" : `${uri.path.split("/").pop() ?? ""}: ${summary(list)}`;
      this.#view.message = uri !== undefined && list.length === 0 ? (this.#onlyFaults ? t("Every radius is ok.") : t("There is nothing to cut.")) : "";
    } catch {
      // The text has changed in the meantime, and the next diagnostics bring the list; or the server is gone, which is said elsewhere.
      if (asked !== this.#asked || this.server.state.kind === "running") {
        return;
      }
      this.#rows = [];
      this.#view.message = t("The server is not running.");
    }
    this.#stale = false;
    this.#changed.fire(undefined);
  }

  async #list(uri: vscode.Uri): Promise<EntityRow[]> {
    const asked = { uri: uri.toString() };
    const [inspection, { contours }] = await Promise.all([this.server.request("wedm/inspect", asked), this.server.request("wedm/contours", asked)]);
    const faults = findings(uri).map((diagnostic) => faultOf(diagnostic, 1));
    return rows(inspection, this.#onlyFaults, contours, faults);
  }

  async #select(editor: vscode.TextEditor): Promise<void> {
    // Asked twice: meanwhile the user may turn to another view or text, and revealing would bring the list back over it.
    const isWanted = (): boolean => this.#view.visible && vscode.window.activeTextEditor === editor;
    if (!isWanted()) {
      return;
    }
    const located = await segmentAt(this.server, editor.document.uri, editor.selection.active);
    const entity = this.#rows.find((row) => located !== null && row.handles.includes(located.handle));
    const row = entity?.segments.find((row) => row.handle === located?.handle && row.segment.index === located.segment) ?? entity;
    if (row !== undefined && isWanted()) {
      await this.#view.reveal(row, { select: true, focus: false });
    }
  }

  getTreeItem(row: Row): vscode.TreeItem {
    const item = new vscode.TreeItem(row.label, vscode.TreeItemCollapsibleState.None);
    item.id = row.kind === "entity" ? row.handle : `${row.handle}/${row.segment.index}`;
    item.description = row.description;
    const faulty = row.kind === "entity" ? row.faults > 0 : row.faulty;
    if (row.kind === "entity") {
      const open = faulty || this.#rows.length === 1;
      item.collapsibleState = open ? vscode.TreeItemCollapsibleState.Expanded : vscode.TreeItemCollapsibleState.Collapsed;
    }
    item.iconPath = faulty
      ? new vscode.ThemeIcon("error", new vscode.ThemeColor("charts.red"))
      : new vscode.ThemeIcon("pass", new vscode.ThemeColor("testing.iconPassed"));
    const place = row.kind === "segment" ? [[row.handle], row.segment.index] : [row.handles];
    item.command = { command: "wedm.radii.reveal", title: t("Show in Picture or Text"), arguments: place };
    return item;
  }

  getChildren(row?: Row): Row[] {
    if (row === undefined) {
      return this.#rows;
    }
    return row.kind === "entity" ? row.segments : [];
  }

  getParent(row: Row): Row | undefined {
    return row.kind === "segment" ? this.#rows.find((entity) => entity.handles.includes(row.handle)) : undefined;
  }

  async reveal(handles: unknown, segment: unknown): Promise<void> {
    const named = Array.isArray(handles) ? handles.filter((handle) => typeof handle === "string") : [];
    if (this.#document !== undefined) {
      await this.pictures.reveal(this.#document, named, typeof segment === "number" ? segment : undefined);
    }
  }

  dispose(): void {
    clearTimeout(this.#timer);
    vscode.Disposable.from(...this.#subscriptions).dispose();
  }
}
