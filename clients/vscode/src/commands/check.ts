// Checks files by their path with `wedm check`, whatever their size, and lists what it finds under Problems.

import * as vscode from "vscode";
import type { Server } from "../server/server";
import { type Listed, read } from "./listed";
import { complaint, optionsFor, programOf, runNoticed } from "./run";
import { uriOf } from "./subject";
import { t } from "../../../picture/words";

export const SEVERITIES: Record<Listed["severity"], vscode.DiagnosticSeverity> = {
  error: vscode.DiagnosticSeverity.Error,
  warning: vscode.DiagnosticSeverity.Warning,
  information: vscode.DiagnosticSeverity.Information,
  hint: vscode.DiagnosticSeverity.Hint,
};

export class PathCheck implements vscode.Disposable {
  readonly #findings = vscode.languages.createDiagnosticCollection("wedm check");
  readonly #opened: vscode.Disposable;

  constructor(private readonly server: Server) {
    // A document that is open is watched by the server itself.
    this.#opened = vscode.workspace.onDidOpenTextDocument((document) => {
      this.#findings.delete(document.uri);
    });
  }

  async ask(argument: unknown): Promise<void> {
    const target = uriOf(argument) ?? (await choose());
    if (target === undefined) {
      return;
    }
    if (target.scheme !== "file") {
      void vscode.window.showErrorMessage(t("Wire EDM: {0} is not a file on disk.", target.toString()));
      return;
    }
    const program = await programOf(this.server);
    if (program !== undefined) {
      await this.#check(program, target);
    }
  }

  async #check(program: string, target: vscode.Uri): Promise<void> {
    const options = ["check", "--output", "json", ...(await optionsFor(this.server, target)), "--", target.fsPath];
    const outcome = await runNoticed(program, options, t("Checking {0}", vscode.workspace.asRelativePath(target)));
    if (outcome === undefined) {
      return;
    }
    const list = read(outcome.output);
    if (list === null) {
      void vscode.window.showErrorMessage(complaint("check", outcome));
      return;
    }
    this.#show(list);
    await this.#say(target, list, outcome.errors);
  }

  #show(list: Listed[]): void {
    const open = new Set(vscode.workspace.textDocuments.map((document) => document.uri.toString()));
    const byFile = new Map<string, vscode.Diagnostic[]>();
    for (const listed of list) {
      const range = new vscode.Range(listed.line - 1, listed.column - 1, listed.endLine - 1, listed.endColumn - 1);
      const diagnostic = new vscode.Diagnostic(range, listed.message, SEVERITIES[listed.severity]);
      diagnostic.source = "wedm check";
      diagnostic.code = listed.rule;
      const file = byFile.get(listed.path);
      if (file === undefined) {
        byFile.set(listed.path, [diagnostic]);
      } else {
        file.push(diagnostic);
      }
    }
    this.#findings.clear();
    for (const [path, diagnostics] of byFile) {
      const uri = vscode.Uri.file(path);
      if (!open.has(uri.toString())) {
        this.#findings.set(uri, diagnostics);
      }
    }
  }

  async #say(target: vscode.Uri, list: Listed[], errors: string): Promise<void> {
    const count = (severity: Listed["severity"]): number => list.filter((listed) => listed.severity === severity).length;
    const [faults, warnings] = [count("error"), count("warning")];
    const unread = errors.trim() === "" ? "" : ` ${errors.trim().split("\n").pop() ?? ""}`;
    const name = vscode.workspace.asRelativePath(target);
    const problems = t("Show Problems");
    const errorsFound = faults === 1 ? t("1 error") : t("{0} errors", faults);
    const warningsFound = warnings === 1 ? t("1 warning") : t("{0} warnings", warnings);
    const message = t("{0}: {1}, {2}.", name, errorsFound, warningsFound) + unread;
    const chosen = await (faults > 0
      ? vscode.window.showErrorMessage(message, problems)
      : vscode.window.showInformationMessage(message, ...(list.length > 0 ? [problems] : [])));
    if (chosen === problems) {
      await vscode.commands.executeCommand("workbench.actions.view.problems");
    }
  }

  dispose(): void {
    this.#findings.dispose();
    this.#opened.dispose();
  }
}

async function choose(): Promise<vscode.Uri | undefined> {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri;
  const chosen = await vscode.window.showOpenDialog({
    title: t("Check a File or Folder"),
    openLabel: t("Check"),
    canSelectFiles: true,
    canSelectFolders: true,
    ...(folder === undefined ? {} : { defaultUri: folder }),
  });
  return chosen?.[0];
}
