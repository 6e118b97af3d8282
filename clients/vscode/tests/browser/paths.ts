// Where things are, and which programs are used.

import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

/** The bundle lies in dist/browser. */
export const EXTENSION = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const PROJECT = resolve(EXTENSION, "../..");
export const WEDM = process.env["WEDM"] ?? join(PROJECT, "target/release/wedm");
export const CHROMIUM = process.env["CHROMIUM"] ?? "/usr/bin/chromium";
export const ARTIFACTS = join(PROJECT, "target/artifacts/vscode");
export const CODE_SERVER = join(EXTENSION, "tests/host/node_modules/code-server/out/node/entry.js");
export const FAKE_SERVER = join(EXTENSION, "tests/browser/fake-server.mjs");
