// Starts the server's program, so that what goes wrong at the start is known before anybody speaks with it.

import { type ChildProcessWithoutNullStreams, spawn } from "node:child_process";
import { access, constants, stat } from "node:fs/promises";

export async function isProgram(path: string): Promise<boolean> {
  try {
    await access(path, constants.X_OK);
    return (await stat(path)).isFile();
  } catch {
    return false;
  }
}

/** Rejects with the system's reason when the program cannot be started. */
export function launch(program: string, log: string): Promise<ChildProcessWithoutNullStreams> {
  return new Promise((resolve, reject) => {
    const child = spawn(program, ["serve"], { stdio: "pipe", windowsHide: true, env: { ...process.env, WEDM_LOG: log } });
    child.once("spawn", () => {
      // A write to a server that is just dying must not throw: its end is handled elsewhere.
      child.stdin.on("error", () => undefined);
      resolve(child);
    });
    child.once("error", reject);
  });
}
