// Scales a program by a factor that the user names; the server makes the edit.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isProgram } from "../languages";
import { isAboveZero, numberOf } from "./numbers";
import { subject } from "./subject";
import { t } from "../../../picture/words";

/** The server's command, which the client offers as its own while the server runs. */
const COMMAND = "wedm.scale";

export async function scaleProgram(front: Front, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isProgram);
  if (document === undefined) {
    return;
  }
  const entered = await vscode.window.showInputBox({
    title: t("Scale Program"),
    prompt: t("Factor by which every length of the program is multiplied."),
    validateInput: (text) => (isAboveZero(text) ? null : t("expected a number above 0")),
  });
  if (entered !== undefined) {
    await vscode.commands.executeCommand(COMMAND, { uri: document.uri.toString(), factor: numberOf(entered) });
  }
}
