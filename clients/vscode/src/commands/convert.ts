// Turns a program back into a drawing, with `wedm convert`.

import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, extname, join } from "node:path";
import * as vscode from "vscode";
import type { Front } from "../front";
import { isProgram } from "../languages";
import type { Server } from "../server/server";
import { write } from "./output";
import { run } from "./run";
import { subject } from "./subject";
import { t } from "../words";

const EXTENSIONS: Record<string, string> = { "3b": ".3b", "wire-iso": ".iso" };

export async function convertToDxf(server: Server, front: Front, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isProgram);
  const found = await server.find();
  if (document === undefined) {
    return;
  }
  if (found.program === null) {
    void vscode.window.showErrorMessage(`Wire EDM: ${found.reason}.`);
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
  const drawing = await converted(found.program, document);
  if (typeof drawing !== "string") {
    void vscode.window.showErrorMessage(`Wire EDM: ${drawing.reason}`);
    return;
  }
  await write(target, drawing);
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
  await vscode.window.showTextDocument(target, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.Active, preview: false });
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
      return { reason: outcome.errors.trim() || t("{0} ended with code {1}", "wedm convert", outcome.code ?? "–") };
    }
    return await readFile(drawing, "utf8");
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}
