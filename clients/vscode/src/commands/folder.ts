// Which folder what a command makes is written to.

import * as vscode from "vscode";
import { t } from "../../../picture/words";

/** The folder of a file; of a text that is no file yet, that of the workspace. */
export function folderOf(uri: vscode.Uri): vscode.Uri | undefined {
  return uri.scheme === "untitled" ? vscode.workspace.workspaceFolders?.[0]?.uri : vscode.Uri.joinPath(uri, "..");
}

interface Way extends vscode.QuickPickItem {
  folder?: vscode.Uri;
}

/** The proposed folder, which need not be there, or one that is chosen; undefined where the user gives up. */
export async function askFolder(title: string, proposed: vscode.Uri | undefined): Promise<vscode.Uri | undefined> {
  if (proposed !== undefined) {
    const ways: Way[] = [
      { label: proposed.path.split("/").pop() ?? "", description: proposed.fsPath, folder: proposed },
      { label: t("Another Folder…") },
    ];
    const way = await vscode.window.showQuickPick(ways, { title, placeHolder: t("The folder that it is written to") });
    if (way === undefined || way.folder !== undefined) {
      return way?.folder;
    }
  }
  const chosen = await vscode.window.showOpenDialog({
    title,
    openLabel: t("Write Here"),
    canSelectFiles: false,
    canSelectFolders: true,
    ...(proposed === undefined ? {} : { defaultUri: vscode.Uri.joinPath(proposed, "..") }),
  });
  return chosen?.[0];
}

export async function isThere(uri: vscode.Uri): Promise<boolean> {
  return vscode.workspace.fs.stat(uri).then(
    () => true,
    () => false,
  );
}
