// Saves the start holes as a list for the drill, or as a drawing with the holes on a layer of their own.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import type { HoleForm } from "../../../picture/protocol";
import type { Server } from "../server/server";
import { write } from "./output";
import { subject } from "./subject";
import { t } from "../../../picture/words";

const FORMS: readonly HoleForm[] = ["csv", "dxf"];

export async function saveDrillList(server: Server, front: Front, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  if (document === undefined) {
    return;
  }
  const { uri } = document;
  const target = await vscode.window.showSaveDialog({
    title: t("Save the Drill List"),
    defaultUri: uri.with({ scheme: uri.scheme === "untitled" ? "file" : uri.scheme, path: `${uri.path.replace(/\.[^./]*$/, "")}-holes.csv` }),
    filters: { [t("List for the drill")]: ["csv"], [t("Drawing with the holes")]: ["dxf"] },
  });
  if (target === undefined) {
    return;
  }
  const format = FORMS.find((form) => target.path.toLowerCase().endsWith(`.${form}`));
  if (format === undefined) {
    void vscode.window.showErrorMessage(t("Wire EDM: a drill list is saved as .csv or .dxf."));
    return;
  }
  const { data } = await server.request("wedm/holes", { uri: uri.toString(), format });
  await write(target, Buffer.from(data, "base64"));
  await vscode.commands.executeCommand("vscode.open", target, { preview: false });
}
