// A drawing opens as its picture; its text is one click away, and both are one document.

import * as vscode from "vscode";
import { uriOf } from "../commands/subject";
import type { Front } from "../front";
import type { Server } from "../server/server";
import { Picture } from "./panel";

/** The type of the editor in the manifest. */
export const EDITOR = "wedm.drawing";

export class DrawingEditor implements vscode.CustomTextEditorProvider, vscode.Disposable {
  readonly #registered: vscode.Disposable;
  readonly #open = new Set<Picture>();

  constructor(
    private readonly server: Server,
    private readonly front: Front,
    private readonly extension: vscode.Uri,
  ) {
    const options = { webviewOptions: { retainContextWhenHidden: true }, supportsMultipleEditorsPerDocument: true };
    this.#registered = vscode.window.registerCustomEditorProvider(EDITOR, this, options);
  }

  resolveCustomTextEditor(document: vscode.TextDocument, panel: vscode.WebviewPanel): void {
    const picture: Picture = new Picture(panel, document.uri, this.server, this.extension, {
      isEditor: true,
      closed: () => {
        this.#open.delete(picture);
      },
    });
    this.#open.add(picture);
    const turn = (): void => {
      if (panel.active) {
        this.front.turnTo(document);
      }
    };
    panel.onDidChangeViewState(turn);
    turn();
  }

  /** The picture as which a drawing is open; the one in front, else one that is seen. */
  pictureOf(uri: vscode.Uri): Picture | undefined {
    const own = [...this.#open].filter((picture) => picture.uri.toString() === uri.toString());
    return own.find(({ panel }) => panel.active) ?? own.find(({ panel }) => panel.visible) ?? own[0];
  }

  /** Opens a drawing as text, or as its picture. */
  async openAs(argument: unknown, kind: "default" | typeof EDITOR): Promise<void> {
    const uri = uriOf(argument) ?? this.front.document?.uri;
    if (uri !== undefined) {
      await vscode.commands.executeCommand("vscode.openWith", uri, kind);
    }
  }

  dispose(): void {
    this.#registered.dispose();
  }
}
