// Writes the program of a drawing to a file of the user's choice.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import { ENDINGS, type Format, TITLES, told } from "../../../picture/programs";
import type { Server } from "../server/server";
import type { Pictures } from "../picture/pictures";
import { attempt } from "./attempt";
import { openMade, write } from "./output";
import { offerToKeep } from "./sides";
import { subject } from "./subject";
import { t } from "../../../picture/words";

export async function generate(server: Server, front: Front, pictures: Pictures, format: Format, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  if (document === undefined) {
    return;
  }
  const attempted = await attempt(server, pictures, { method: "wedm/generate", uri: document.uri, format });
  if (attempted === undefined) {
    return;
  }
  const { made, sides } = attempted;
  const stem = document.uri.path.replace(/\.[^./]*$/, "");
  const target = await vscode.window.showSaveDialog({
    title: t("Save the {0} Program", TITLES[format]()),
    defaultUri: document.uri.with({ scheme: document.uri.scheme === "untitled" ? "file" : document.uri.scheme, path: `${stem}.${ENDINGS[format][0]}` }),
    filters: { [t("{0} program", TITLES[format]())]: [...ENDINGS[format]] },
  });
  if (target === undefined) {
    return;
  }
  await write(target, made.program);
  await openMade(document, target);
  void vscode.window.showInformationMessage(`${TITLES[format]()}: ${told(made, format)}`);
  if (sides !== undefined) {
    await offerToKeep(server, document.uri, sides, format === "milling");
  }
}
