// The item in the status bar: against what the document in front is checked, or what is wrong with the server.

import * as vscode from "vscode";
import type { Front } from "./front";
import { inShort } from "./inShort";
import type { SettingsInForce } from "../../picture/protocol";
import type { Server, State } from "./server/server";
import { t } from "../../picture/words";

/** The wait, in ms, since edits come in bursts. */
const CALM = 150;

export class Status implements vscode.Disposable {
  readonly #item: vscode.StatusBarItem;
  readonly #subscriptions: vscode.Disposable[];
  #timer: NodeJS.Timeout | undefined;

  constructor(
    private readonly server: Server,
    private readonly front: Front,
  ) {
    this.#item = vscode.window.createStatusBarItem("wedm.correction", vscode.StatusBarAlignment.Right, 110);
    this.#item.name = t("Wire EDM: Correction");
    this.#subscriptions = [
      this.#item,
      server.onDidChangeState(() => void this.#refresh()),
      server.onDidDiagnose(() => {
        this.#soon();
      }),
      front.onDidChange(() => void this.#refresh()),
      vscode.workspace.onDidChangeConfiguration((event) => {
        if (event.affectsConfiguration("wedm")) {
          this.#soon();
        }
      }),
    ];
    void this.#refresh();
  }

  #soon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#refresh(), CALM);
  }

  async #refresh(): Promise<void> {
    const document = this.front.document;
    if (document === undefined) {
      this.#item.hide();
      return;
    }
    if (this.server.state.kind !== "running") {
      this.#trouble(this.server.state);
      return;
    }
    try {
      this.#show(await this.server.request("wedm/settings", { uri: document.uri.toString() }));
    } catch {
      // That a server has just died is shown by its state.
      this.#item.text = "wedm";
      this.#item.tooltip = t("Wire EDM: the correction in force is not known");
    }
  }

  #show(settings: SettingsInForce): void {
    this.#item.text = `$(record-small) ${inShort(settings)}`;
    this.#item.backgroundColor = undefined;
    this.#item.command = "wedm.changeCorrection";
    const checked = t("Checked against: {0}", settings.said);
    this.#item.tooltip = new vscode.MarkdownString(`${checked}\n\n${t("Inner arcs with a smaller radius cannot be cut. Click to change.")}`);
    this.#item.accessibilityInformation = { label: `Wire EDM: ${checked}` };
    this.#item.show();
  }

  #trouble(state: State): void {
    const failed = state.kind === "failed";
    this.#item.text = failed ? "$(error) wedm" : "$(sync~spin) wedm";
    this.#item.backgroundColor = failed ? new vscode.ThemeColor("statusBarItem.errorBackground") : undefined;
    this.#item.tooltip = state.kind === "failed" || state.kind === "waiting" ? `Wire EDM: ${state.reason}` : `Wire EDM: ${state.kind}`;
    this.#item.command = failed ? "wedm.restartServer" : "wedm.showLog";
    this.#item.show();
  }

  dispose(): void {
    clearTimeout(this.#timer);
    vscode.Disposable.from(...this.#subscriptions).dispose();
  }
}
