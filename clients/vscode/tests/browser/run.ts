// Runs the scenarios named on the command line, or all, and counts.

import { WindowChecks } from "./checks";
import { badDays } from "./badDays";
import { chinese } from "./chinese";
import { deliver } from "./deliver";
import { drawing } from "./drawing";
import { job } from "./job";
import { large } from "./large";
import { picture } from "./picture";
import { program } from "./program";
import { readme } from "./readme";
import { states } from "./states";
import { text } from "./text";
import { themes } from "./themes";
import { views } from "./views";
import { withServer } from "./withServer";

/** Made when it is asked for by name: it changes a picture that is committed. */
const ONLY_BY_NAME = "readme";
type Scenario = (checks: WindowChecks) => Promise<void>;
const pages = { states, large, themes, chinese };
const jobs = { program, job, deliver };
const sights = { picture, drawing, views };
const scenarios: Record<string, Scenario> = { text, ...sights, ...jobs, ...pages, badDays, withServer, [ONLY_BY_NAME]: readme };
const checks = new WindowChecks();
const named = process.argv.slice(2);

const isWanted = (name: string): boolean => (named.length === 0 ? name !== ONLY_BY_NAME : named.includes(name));

for (const [name, scenario] of Object.entries(scenarios).filter(([name]) => isWanted(name))) {
  console.log(`${name}:`);
  await scenario(checks).catch((error: unknown) => checks.fail(`${name} starts and ends`, error));
}
console.log(`${checks.passed} passed, ${checks.failed} failed`);
process.exitCode = checks.failed === 0 ? 0 : 1;
