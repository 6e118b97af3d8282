// A command of the program reads files, not what stands in editors: it is saved first.

import { setTimeout as pause } from "node:timers/promises";
import * as vscode from "vscode";
import { isOurs } from "../languages";
import { t } from "../../../picture/words";

/** How long a file is given to be saved, ms. */
const PATIENCE = 3000;
/** How long it is left alone between two attempts, ms. */
const PAUSE = 100;

/** Saves what the program will read of these files and folders; false where one could not be saved, which has been said then. */
export async function saved(targets: readonly vscode.Uri[]): Promise<boolean> {
  const changed = vscode.workspace.textDocuments.filter((document) => document.isDirty && isRead(document, targets));
  for (const document of changed) {
    if (!(await isSaved(document))) {
      void vscode.window.showErrorMessage(t("Wire EDM: {0} must be saved first.", vscode.workspace.asRelativePath(document.uri)));
      return false;
    }
  }
  return true;
}

/** VS Code also answers false where it saves the file by itself meanwhile (auto save), and tells later that it is saved. */
async function isSaved(document: vscode.TextDocument): Promise<boolean> {
  const until = Date.now() + PATIENCE;
  while (!(await document.save()) && document.isDirty) {
    if (Date.now() > until) {
      return false;
    }
    await pause(PAUSE);
  }
  return true;
}

/** Drawings and programs among the targets or below them, and every wedm.toml: it holds for what lies below it. */
function isRead(document: vscode.TextDocument, targets: readonly vscode.Uri[]): boolean {
  const { uri } = document;
  if (uri.path.endsWith("/wedm.toml")) {
    return uri.scheme === "file";
  }
  return isOurs(document) && targets.some(({ path }) => uri.path === path || uri.path.startsWith(`${path.replace(/\/$/, "")}/`));
}
