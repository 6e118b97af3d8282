// Files that VS Code hands to no extension, because they are too large: the user is told, and offered a check by path.

import * as vscode from "vscode";
import { t } from "../../picture/words";

/** VS Code's own limit, in bytes: above it a text is not synchronised with extensions. */
const LIMIT = 50 * 1024 * 1024;
const OURS = /\.(dxf|3b|4b|iso|nc)$/i;

export function watchLargeFiles(): vscode.Disposable {
  const said = new Set<string>();
  const look = async (tab: vscode.Tab): Promise<void> => {
    const uri = tab.input instanceof vscode.TabInputText || tab.input instanceof vscode.TabInputCustom ? tab.input.uri : undefined;
    if (uri === undefined || !OURS.test(uri.path) || said.has(uri.toString())) {
      return;
    }
    const size = await sizeOf(uri);
    if (size <= LIMIT || said.has(uri.toString())) {
      return;
    }
    said.add(uri.toString());
    const name = vscode.workspace.asRelativePath(uri);
    const message = t(
      "Wire EDM: {0} is {1} MB large. VS Code hands files over 50 MB to no extension, so it is not checked while you edit. It can be checked by its path.",
      name,
      (size / 1024 / 1024).toFixed(0),
    );
    const check = t("Check It by Path");
    if ((await vscode.window.showWarningMessage(message, check)) === check) {
      await vscode.commands.executeCommand("wedm.checkPath", uri);
    }
  };
  const lookAtAll = (tabs: readonly vscode.Tab[]): void => {
    for (const tab of tabs) {
      void look(tab);
    }
  };
  lookAtAll(vscode.window.tabGroups.all.flatMap((group) => group.tabs));
  return vscode.window.tabGroups.onDidChangeTabs(({ opened, changed, closed }) => {
    lookAtAll([...opened, ...changed]);
    for (const tab of closed) {
      if (tab.input instanceof vscode.TabInputText || tab.input instanceof vscode.TabInputCustom) {
        said.delete(tab.input.uri.toString());
      }
    }
  });
}

async function sizeOf(uri: vscode.Uri): Promise<number> {
  try {
    return (await vscode.workspace.fs.stat(uri)).size;
  } catch {
    return 0;
  }
}
