// The pictures of documents: the one panel beside a text, which follows the document in front, and those as which drawings are open.

import * as vscode from "vscode";
import { subject, uriOf } from "../commands/subject";
import type { Front } from "../front";
import { isDrawing, isOurs } from "../languages";
import type { Server } from "../server/server";
import { reveal } from "../place";
import { type DrawingEditor, EDITOR } from "./editor";
import { Picture, VIEW_TYPE } from "./panel";
import { t } from "../../../picture/words";

/** Not restored after a reload of the window: the user asks for it again. */
const FIT_TYPE = "wedm.fit";

export class Pictures implements vscode.WebviewPanelSerializer, vscode.Disposable {
  #picture: Picture | undefined;
  #fit: Picture | undefined;
  /** The picture in which entities are marked. */
  #marked: Picture | undefined;
  readonly #restored: vscode.Disposable;

  constructor(
    private readonly server: Server,
    private readonly front: Front,
    private readonly extension: vscode.Uri,
    private readonly editor: DrawingEditor,
  ) {
    this.#restored = vscode.window.registerWebviewPanelSerializer(VIEW_TYPE, this);
  }

  /** Shows the picture beside the text, or the one as which a drawing is open; with `play`, the wire starts to move. */
  async open(argument: unknown, play: boolean): Promise<void> {
    const uri = uriOf(argument) ?? this.front.document?.uri;
    if (uri === undefined || !isOurs(await vscode.workspace.openTextDocument(uri))) {
      void vscode.window.showInformationMessage(t("Wire EDM: open a drawing or a program first."));
      return;
    }
    const own = this.editor.pictureOf(uri);
    if (own?.panel.visible === true) {
      this.#marked = own;
      own.panel.reveal(undefined, true);
      if (play) {
        own.play();
      }
      return;
    }
    if (this.#picture === undefined) {
      const place = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      this.#adopt(vscode.window.createWebviewPanel(VIEW_TYPE, t("Picture"), place, { retainContextWhenHidden: true }), uri);
    } else {
      this.#picture.show(uri);
      this.#picture.panel.reveal(undefined, true);
    }
    this.#marked = this.#picture;
    if (play) {
      this.#picture?.play();
    }
  }

  /** The picture of a document, where that is looked at and not its text. */
  inFront(uri: vscode.Uri): Picture | undefined {
    const groups = vscode.window.tabGroups;
    const inputs = [groups.activeTabGroup, ...groups.all].map(({ activeTab }) => activeTab?.input);
    for (const input of inputs) {
      const isOwn = (shown: vscode.Uri | undefined): boolean => shown?.toString() === uri.toString();
      if (input instanceof vscode.TabInputText && isOwn(input.uri)) {
        return undefined;
      }
      if (input instanceof vscode.TabInputCustom && input.viewType === EDITOR && isOwn(input.uri)) {
        return this.editor.pictureOf(uri);
      }
      // VS Code puts a prefix of its own before the type.
      if (input instanceof vscode.TabInputWebview && input.viewType.endsWith(VIEW_TYPE) && isOwn(this.#picture?.uri)) {
        return this.#picture;
      }
    }
    return this.editor.pictureOf(uri);
  }

  /** Selects and frames a segment, or all of an entity's contour: in the picture if that is in front, in the text if that is. */
  async reveal(uri: vscode.Uri, handles: readonly string[], segment: number | undefined): Promise<void> {
    const picture = this.inFront(uri);
    if (picture !== undefined) {
      picture.approach(handles, segment ?? null);
    } else if (handles[0] !== undefined) {
      await reveal(this.server, uri, handles[0], segment, false);
    }
  }

  /** Shows whether punch and plate fit, beside the text. */
  async openFit(argument: unknown): Promise<void> {
    const document = await subject(this.front, argument, isDrawing);
    if (document === undefined) {
      return;
    }
    if (this.#fit !== undefined) {
      this.#fit.show(document.uri);
      this.#fit.panel.reveal(undefined, true);
      return;
    }
    const panel = vscode.window.createWebviewPanel(FIT_TYPE, t("Fit of {0}", document.uri.path.split("/").pop() ?? ""), { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, { retainContextWhenHidden: true });
    this.#fit = new Picture(panel, document.uri, this.server, this.extension, {
      isFit: true,
      closed: () => {
        this.#fit = undefined;
      },
    });
  }

  /** Marks entities that the user is asked about; null when they have answered. */
  mark(handles: readonly string[] | null): void {
    this.#marked?.mark(handles);
  }

  /** After a reload of the window. The document that is in front now takes precedence over the one of the last picture. */
  async deserializeWebviewPanel(panel: vscode.WebviewPanel, state: unknown): Promise<void> {
    const kept = typeof state === "object" && state !== null ? (state as { uri?: unknown }).uri : undefined;
    const uri = this.front.document?.uri ?? (typeof kept === "string" ? uriOf(kept) : undefined);
    if (uri === undefined || this.#picture !== undefined) {
      panel.dispose();
      return;
    }
    try {
      await vscode.workspace.openTextDocument(uri);
      this.#adopt(panel, uri);
    } catch {
      // The file is gone.
      panel.dispose();
    }
  }

  #adopt(panel: vscode.WebviewPanel, uri: vscode.Uri): void {
    this.#picture = new Picture(panel, uri, this.server, this.extension, {
      closed: () => {
        this.#marked = this.#marked === this.#picture ? undefined : this.#marked;
        this.#picture = undefined;
      },
    });
  }

  dispose(): void {
    this.#picture?.panel.dispose();
    this.#fit?.panel.dispose();
    this.#restored.dispose();
  }
}
