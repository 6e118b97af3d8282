// Runs a command of the server's program to its end.

import { spawn } from "node:child_process";
import * as vscode from "vscode";
import type { Server } from "../server/server";
import { asOptions } from "./inForce";
import { t } from "../../../picture/words";

export interface Outcome {
  /** null when it was ended by a signal. */
  code: number | null;
  output: string;
  errors: string;
}

/** The most output that is read: nobody reads a longer list. */
const LONGEST = 256 * 1024 * 1024;

/** The program to run; undefined where there is none, which has been said then. */
export async function programOf(server: Server): Promise<string | undefined> {
  const found = await server.find();
  if (found.program === null) {
    void vscode.window.showErrorMessage(`Wire EDM: ${found.reason}.`);
    return undefined;
  }
  return found.program;
}

/** What is set in VS Code for a file or a folder, as options. */
export async function optionsFor(server: Server, target: vscode.Uri): Promise<string[]> {
  try {
    const isFolder = ((await vscode.workspace.fs.stat(target)).type & vscode.FileType.Directory) !== 0;
    const asked = isFolder ? vscode.Uri.joinPath(target, "any.dxf") : target;
    return asOptions(await server.request("wedm/settings", { uri: asked.toString() }));
  } catch {
    // Without the server what the files say holds alone.
    return [];
  }
}

interface Around {
  /** The folder that it runs in. */
  folder?: string;
  token?: vscode.CancellationToken;
}

/** Rejects when the program cannot be started, or writes without end. */
export function run(program: string, options: readonly string[], { folder, token }: Around = {}): Promise<Outcome> {
  return new Promise((resolve, reject) => {
    // It speaks as the server does: the language of VS Code.
    const language = vscode.env.language.startsWith("zh") ? "zh" : "en";
    const environment = { ...process.env, NO_COLOR: "1" };
    const child = spawn(program, ["--lang", language, ...options], {
      stdio: ["ignore", "pipe", "pipe"],
      windowsHide: true,
      env: environment,
      ...(folder === undefined ? {} : { cwd: folder }),
    });
    const output: Buffer[] = [];
    const errors: Buffer[] = [];
    let length = 0;
    const take = (into: Buffer[]) => (chunk: Buffer) => {
      length += chunk.length;
      if (length > LONGEST) {
        child.kill();
        reject(new Error(`${program} wrote more than ${LONGEST} bytes`));
      } else {
        into.push(chunk);
      }
    };
    child.stdout.on("data", take(output));
    child.stderr.on("data", take(errors));
    child.once("error", reject);
    child.once("close", (code) => {
      resolve({ code, output: Buffer.concat(output).toString("utf8"), errors: Buffer.concat(errors).toString("utf8") });
    });
    token?.onCancellationRequested(() => child.kill());
  });
}

/** The same with a notice that it goes on, and a way to end it; undefined where the user ends it. */
export async function runNoticed(
  program: string,
  options: readonly string[],
  title: string,
  around: Around = {},
): Promise<Outcome | undefined> {
  const how = { location: vscode.ProgressLocation.Notification, title, cancellable: true };
  return vscode.window.withProgress(how, async (_progress, token) => {
    const outcome = await run(program, options, { ...around, token });
    return token.isCancellationRequested ? undefined : outcome;
  });
}

/** What a command that failed says of it. */
export function complaint(command: string, { code, errors }: Outcome): string {
  return `Wire EDM: ${errors.trim() || t("{0} ended with code {1}", `wedm ${command}`, code ?? "–")}`;
}
