// Where things are, and which programs are used.

import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

/** The bundle lies in dist/browser. */
export const PROJECT = resolve(dirname(fileURLToPath(import.meta.url)), "../../../..");
export const WEDM = process.env["WEDM"] ?? join(PROJECT, "target/debug/wedm");
export const CHROMIUM = process.env["CHROMIUM"] ?? "/usr/bin/chromium";
export const ARTIFACTS = join(PROJECT, "target/artifacts/view");
