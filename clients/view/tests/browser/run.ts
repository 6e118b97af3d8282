// Runs the scenarios named on the command line, or all, and counts.

import { PageChecks } from "./checks";
import { large } from "./large";
import { look } from "./look";
import { readme } from "./readme";
import { strange } from "./strange";
import { work } from "./work";

/** Made when it is asked for by name: it changes a picture that is committed. */
const ONLY_BY_NAME = "readme";
const scenarios: Record<string, (checks: PageChecks) => Promise<void>> = { work, strange, look, large, [ONLY_BY_NAME]: readme };
const checks = new PageChecks();
const named = process.argv.slice(2);

for (const [name, scenario] of Object.entries(scenarios)) {
  if (named.length === 0 ? name !== ONLY_BY_NAME : named.includes(name)) {
    console.log(`${name}:`);
    await scenario(checks).catch((error: unknown) => checks.fail(`${name} starts and ends`, error));
    await checks.bench?.stop();
    checks.bench = undefined;
  }
}
console.log(`${checks.passed} passed, ${checks.failed} failed`);
process.exitCode = checks.failed === 0 ? 0 : 1;
