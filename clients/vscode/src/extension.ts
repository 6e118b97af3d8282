// Puts the parts together.

import * as vscode from "vscode";
import { PathCheck } from "./commands/check";
import { convertToDxf } from "./commands/convert";
import { changeCorrection } from "./commands/correction";
import { createSettings } from "./commands/createSettings";
import { saveDrillList } from "./commands/drillList";
import { exportPicture } from "./commands/exportPicture";
import { fixAll } from "./commands/fixAll";
import { generate } from "./commands/generate";
import { generatePair } from "./commands/generatePair";
import { report } from "./commands/report";
import { scaleProgram } from "./commands/scale";
import { completeSettings } from "./completion";
import { detectPrograms } from "./detect";
import { Front } from "./front";
import { numberMarks } from "./marks";
import { watchLargeFiles } from "./large";
import { BinaryPictures } from "./picture/binary";
import { DrawingEditor, EDITOR } from "./picture/editor";
import { Pictures } from "./picture/pictures";
import { Radii } from "./radii/tree";
import { offerToShow, showFinding } from "./showFinding";
import { rulePages } from "./rulePages";
import { sayWhatFails } from "./server/notices";
import { Server } from "./server/server";
import { Status } from "./status";
import { speak } from "../../picture/words";

/** Settings that count from the server's next start. */
const STARTS_ANEW = ["wedm.server.path", "wedm.server.log"];

let running: Server | undefined;

export function activate(context: vscode.ExtensionContext): void {
  speak(vscode.l10n.bundle ?? {});
  const log = vscode.window.createOutputChannel("Wire EDM", { log: true });
  const server = new Server(context, log);
  running = server;
  const front = new Front();
  const editor = new DrawingEditor(server, front, context.extensionUri);
  const pictures = new Pictures(server, front, context.extensionUri, editor);
  const radii = new Radii(server, front, pictures);
  const check = new PathCheck(server);
  const commands: Record<string, (...given: unknown[]) => Promise<void> | void> = {
    "wedm.generate3b": (uri) => generate(server, front, pictures, "3b", uri),
    "wedm.generate4b": (uri) => generate(server, front, pictures, "4b", uri),
    "wedm.generateIso": (uri) => generate(server, front, pictures, "iso", uri),
    "wedm.generateMilling": (uri) => generate(server, front, pictures, "milling", uri),
    "wedm.generatePair": (uri) => generatePair(server, front, pictures, uri),
    "wedm.openPicture": (uri) => pictures.open(uri, false),
    "wedm.openText": (uri) => editor.openAs(uri, "default"),
    "wedm.openDrawing": (uri) => editor.openAs(uri, EDITOR),
    "wedm.showFit": (uri) => pictures.openFit(uri),
    "wedm.saveDrillList": (uri) => saveDrillList(server, front, uri),
    "wedm.exportPicture": (uri) => exportPicture(server, front, uri),
    "wedm.simulate": (uri) => pictures.open(uri, true),
    "wedm.convertToDxf": (uri) => convertToDxf(server, front, uri),
    "wedm.scaleProgram": (uri) => scaleProgram(front, uri),
    "wedm.fixAll": (uri) => fixAll(server, front, uri),
    "wedm.checkPath": (uri) => check.ask(uri),
    "wedm.showRadii": () => radii.show(),
    "wedm.radii.onlyFaults": () => radii.filter(true),
    "wedm.radii.all": () => radii.filter(false),
    "wedm.radii.reveal": (handles, segment) => radii.reveal(handles, segment),
    "wedm.showFinding": (uri, key) => {
      showFinding(pictures, uri, key);
    },
    "wedm.report": (uri, all) => report(server, front, uri, all),
    "wedm.createSettings": (uri, table) => createSettings(server, front, uri, table),
    "wedm.changeCorrection": () => changeCorrection(server, front),
    "wedm.restartServer": () => server.restart(),
    "wedm.showLog": () => {
      log.show();
    },
  };
  context.subscriptions.push(
    log,
    server,
    front,
    pictures,
    editor,
    radii,
    check,
    new Status(server, front),
    sayWhatFails(server, log),
    watchLargeFiles(),
    detectPrograms(),
    new BinaryPictures(server, front, context.extensionUri),
    offerToShow(pictures),
    numberMarks(server),
    rulePages(server),
    completeSettings(context.extension.packageJSON as Parameters<typeof completeSettings>[0]),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (STARTS_ANEW.some((key) => event.affectsConfiguration(key))) {
        void server.restart();
      }
    }),
    ...Object.entries(commands).map(([name, act]) => vscode.commands.registerCommand(name, guarded(act))),
  );
  void server.restart();
}

/** A command that fails says so in a sentence. */
function guarded(act: (...given: unknown[]) => Promise<void> | void): (...given: unknown[]) => Promise<void> {
  return async (...given) => {
    try {
      await act(...given);
    } catch (error) {
      void vscode.window.showErrorMessage(`Wire EDM: ${error instanceof Error ? error.message : String(error)}`);
    }
  };
}

export async function deactivate(): Promise<void> {
  await running?.stop();
}
