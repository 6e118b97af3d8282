// Runs the scenarios named on the command line, or all, and counts.

import { Checks } from "./checks";
import { badDays } from "./badDays";
import { picture } from "./picture";
import { program } from "./program";
import { text } from "./text";

const scenarios: Record<string, (checks: Checks) => Promise<void>> = { text, picture, program, badDays };
const checks = new Checks();
const named = process.argv.slice(2);

for (const [name, scenario] of Object.entries(scenarios).filter(([name]) => named.length === 0 || named.includes(name))) {
  console.log(`${name}:`);
  await checks.check(`${name} starts and ends`, () => scenario(checks));
}
console.log(`${checks.passed} passed, ${checks.failed} failed`);
process.exitCode = checks.failed === 0 ? 0 : 1;
