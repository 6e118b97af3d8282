// Saves where the wire is threaded as the list for the drill.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import type { StartHole } from "../protocol";
import type { Server } from "../server/server";
import { write } from "./output";
import { csvOf } from "./holes";
import { subject } from "./subject";
import { t } from "../words";

export async function saveDrillList(server: Server, front: Front, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  if (document === undefined) {
    return;
  }
  const { uri } = document;
  const { holes = [], unitsToMm } = await server.request("wedm/toolpath", { uri: uri.toString() });
  const listed: readonly StartHole[] = holes;
  const target = await vscode.window.showSaveDialog({
    title: t("Save the Drill List"),
    defaultUri: uri.with({ scheme: uri.scheme === "untitled" ? "file" : uri.scheme, path: `${uri.path.replace(/\.[^./]*$/, "")}-holes.csv` }),
    filters: { CSV: ["csv"] },
  });
  if (target === undefined) {
    return;
  }
  await write(target, csvOf(uri.path.split("/").pop() ?? "", listed, unitsToMm));
  await vscode.window.showTextDocument(target, { preview: false });
}
