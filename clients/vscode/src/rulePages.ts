// The pages of the rules, which the server holds: a click on a finding's rule opens one, and its links the next.

import * as vscode from "vscode";
import type { Server } from "./server/server";

/** The scheme of their addresses: `wedm-rule:/small-radius.md`. */
const SCHEME = "wedm-rule";

export function rulePage(rule: string): vscode.Uri {
  return vscode.Uri.from({ scheme: SCHEME, path: `/${rule}.md` });
}

export function rulePages(server: Server): vscode.Disposable {
  return vscode.workspace.registerTextDocumentContentProvider(SCHEME, {
    provideTextDocumentContent: async (uri) => {
      const rule = uri.path.replace(/^\//, "").replace(/\.md$/, "");
      return (await server.request("wedm/rulePage", { rule })).text;
    },
  });
}
