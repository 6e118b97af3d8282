// Completes a wedm.toml: tables, keys and values, with what they mean.

import * as vscode from "vscode";
import { keysOf, offers, type Declared, type Offer } from "./tomlKeys";

const KINDS: Record<Offer["kind"], vscode.CompletionItemKind> = {
  table: vscode.CompletionItemKind.Module,
  key: vscode.CompletionItemKind.Property,
  value: vscode.CompletionItemKind.EnumMember,
};

interface Manifest {
  contributes: { configuration: { properties: Record<string, Declared> } };
}

/** `manifest` is the package.json of the extension, in the language of VS Code. */
export function completeSettings(manifest: Manifest): vscode.Disposable {
  const keys = keysOf(manifest.contributes.configuration.properties);
  return vscode.languages.registerCompletionItemProvider(
    { scheme: "file", pattern: "**/wedm.toml" },
    {
      provideCompletionItems(document, position) {
        const above = Array.from({ length: position.line }, (_, line) => document.lineAt(line).text);
        const before = document.lineAt(position.line).text.slice(0, position.character);
        const word = /[\w.-]*$/.exec(before)?.[0].length ?? 0;
        const range = new vscode.Range(position.translate(0, -word), position);
        return offers(keys, above, before).map((offer) => {
          const item = new vscode.CompletionItem(offer.label, KINDS[offer.kind]);
          item.insertText = offer.text;
          item.range = range;
          item.documentation = new vscode.MarkdownString(offer.detail);
          return item;
        });
      },
    },
    "[",
    "=",
    '"',
    " ",
  );
}
