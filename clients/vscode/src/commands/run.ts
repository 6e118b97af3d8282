// Runs a command of the server's program to its end.

import { spawn } from "node:child_process";
import type * as vscode from "vscode";

export interface Outcome {
  /** null when it was ended by a signal. */
  code: number | null;
  output: string;
  errors: string;
}

/** The most output that is read: nobody reads a longer list. */
const LONGEST = 256 * 1024 * 1024;

/** Rejects when the program cannot be started, or writes without end. */
export function run(program: string, options: readonly string[], token?: vscode.CancellationToken): Promise<Outcome> {
  return new Promise((resolve, reject) => {
    const child = spawn(program, options, { stdio: ["ignore", "pipe", "pipe"], windowsHide: true, env: { ...process.env, NO_COLOR: "1" } });
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
