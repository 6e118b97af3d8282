// Turns a program back into a drawing, with `wedm convert`.

import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, extname, join } from "node:path";
import * as vscode from "vscode";
import type { Front } from "../front";
import { isProgram } from "../languages";
import type { Server } from "../server/server";
import { openMade, write } from "./output";
import { complaint, programOf, run } from "./run";
import { subject } from "./subject";
import { t } from "../../../picture/words";

const EXTENSIONS: Record<string, string> = { "3b": ".3b", "wire-iso": ".iso" };

export async function convertToDxf(server: Server, front: Front, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isProgram);
  const program = document && (await programOf(server));
  if (document === undefined || program === undefined) {
    return;
  }
  const stem = document.uri.path.replace(/\.[^./]*$/, "");
  const target = await vscode.window.showSaveDialog({
    title: t("Save the Drawing"),
    defaultUri: document.uri.with({ scheme: "file", path: `${stem}.dxf` }),
    filters: { [t("DXF drawing")]: ["dxf"] },
  });
  if (target === undefined) {
    return;
  }
  const drawing = await converted(program, document);
  if (typeof drawing !== "string") {
    void vscode.window.showErrorMessage(drawing.reason);
    return;
  }
  await write(target, drawing);
  await openMade(document, target);
}

/** The text as it stands in the editor, saved or not, goes through a folder of its own. */
async function converted(program: string, document: vscode.TextDocument): Promise<string | { reason: string }> {
  const folder = await mkdtemp(join(tmpdir(), "wedm-"));
  try {
    const name = basename(document.uri.path);
    const source = join(folder, extname(name) === "" ? name + (EXTENSIONS[document.languageId] ?? "") : name);
    const drawing = join(folder, "converted.dxf");
    await writeFile(source, document.getText());
    const outcome = await run(program, ["convert", source, "-o", drawing]);
    if (outcome.code !== 0) {
      return { reason: complaint("convert", outcome) };
    }
    return await readFile(drawing, "utf8");
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}
