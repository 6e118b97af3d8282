// Saves the picture of a drawing or a program as SVG, PNG or PDF.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isOurs } from "../languages";
import type { PictureForm } from "../../../picture/protocol";
import type { Server } from "../server/server";
import { write } from "./output";
import { uriOf } from "./subject";
import { t } from "../../../picture/words";

const FORMS: readonly PictureForm[] = ["pdf", "png", "svg"];

export async function exportPicture(server: Server, front: Front, argument: unknown): Promise<void> {
  const uri = uriOf(argument) ?? front.document?.uri;
  if (uri === undefined || !isOurs(await vscode.workspace.openTextDocument(uri))) {
    void vscode.window.showInformationMessage(t("Wire EDM: open a drawing or a program first."));
    return;
  }
  const chosen = await chooseTarget(uri);
  if (chosen === undefined) {
    return;
  }
  const { data } = await server.request("wedm/export", { uri: uri.toString(), format: chosen.format });
  await write(chosen.target, Buffer.from(data, "base64"));
  sayIsSaved(chosen.target);
}

/** Where the picture of a document is to be saved, and as what; undefined where the user gives up, or chose something else. */
export async function chooseTarget(uri: vscode.Uri): Promise<{ target: vscode.Uri; format: PictureForm } | undefined> {
  const target = await vscode.window.showSaveDialog({
    title: t("Save the Picture"),
    defaultUri: uri.with({ scheme: uri.scheme === "untitled" ? "file" : uri.scheme, path: `${uri.path.replace(/\.[^./]*$/, "")}.pdf` }),
    filters: Object.fromEntries(FORMS.map((form) => [form.toUpperCase(), [form]])),
  });
  const format = FORMS.find((form) => target?.path.toLowerCase().endsWith(`.${form}`));
  if (target === undefined) {
    return undefined;
  }
  if (format === undefined) {
    void vscode.window.showErrorMessage(t("Wire EDM: a picture is saved as .svg, .png or .pdf."));
    return undefined;
  }
  return { target, format };
}

export function sayIsSaved(target: vscode.Uri): void {
  void vscode.window.showInformationMessage(t("Wire EDM: the picture is saved: {0}.", vscode.workspace.asRelativePath(target)));
}
