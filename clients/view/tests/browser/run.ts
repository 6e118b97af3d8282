// Runs the scenarios named on the command line, or all, and counts.

import { runScenarios } from "../../../checks";
import { PageChecks } from "./checks";
import { large } from "./large";
import { look } from "./look";
import { readme } from "./readme";
import { strange } from "./strange";
import { work } from "./work";

/** Made when it is asked for by name: it changes a picture that is committed. */
const ONLY_BY_NAME = "readme";
const scenarios: Record<string, (checks: PageChecks) => Promise<void>> = { work, strange, look, large, [ONLY_BY_NAME]: readme };
await runScenarios(scenarios, (name) => new PageChecks(name), ONLY_BY_NAME, 1);
