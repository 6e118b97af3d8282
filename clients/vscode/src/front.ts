// The document in front: also while the picture or the radius list has the focus.

import * as vscode from "vscode";
import { isOurs } from "./languages";

export class Front implements vscode.Disposable {
  #uri: vscode.Uri | undefined;
  readonly #changed = new vscode.EventEmitter<undefined>();
  readonly #subscriptions: vscode.Disposable[];

  /** Another document is in front, or none. */
  readonly onDidChange = this.#changed.event;

  constructor() {
    this.#subscriptions = [
      this.#changed,
      vscode.window.onDidChangeActiveTextEditor((editor) => {
        this.#turn(editor);
      }),
      vscode.workspace.onDidCloseTextDocument(({ uri }) => {
        if (uri.toString() === this.#uri?.toString()) {
          this.#set(undefined);
        }
      }),
    ];
    this.#turn(vscode.window.activeTextEditor);
  }

  /** The document of one of our languages that is in front. */
  get document(): vscode.TextDocument | undefined {
    return vscode.workspace.textDocuments.find((document) => document.uri.toString() === this.#uri?.toString());
  }

  /** A document in an editor of its own kind comes to the front: VS Code tells of texts alone. */
  turnTo(document: vscode.TextDocument): void {
    this.#set(isOurs(document) ? document : undefined);
  }

  /** What is in front is none of the documents: commands are not about the one before. */
  leave(): void {
    this.#set(undefined);
  }

  /** Without an active editor, a panel is in front, and belongs to what was there before. */
  #turn(editor: vscode.TextEditor | undefined): void {
    if (editor !== undefined) {
      this.#set(isOurs(editor.document) ? editor.document : undefined);
    }
  }

  #set(document: vscode.TextDocument | undefined): void {
    this.#uri = document?.uri;
    void vscode.commands.executeCommand("setContext", "wedm.front", document?.languageId);
    this.#changed.fire(undefined);
  }

  dispose(): void {
    vscode.Disposable.from(...this.#subscriptions).dispose();
  }
}
