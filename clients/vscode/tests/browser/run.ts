// Runs the scenarios named on the command line, or all, and counts.

import { runScenarios } from "../../../checks";
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
/** Windows that stand open at a time: mostly they wait for each other's parts, not for the processor. */
const AT_ONCE = 2;
type Scenario = (checks: WindowChecks) => Promise<void>;
const pages = { states, large, themes, chinese };
const jobs = { program, job };
const sights = { picture, drawing, views };
// The longest first, so that it is not the one that is left at the end.
const scenarios: Record<string, Scenario> = { deliver, text, ...sights, ...jobs, ...pages, badDays, withServer, [ONLY_BY_NAME]: readme };
await runScenarios(scenarios, (name) => new WindowChecks(name), ONLY_BY_NAME, AT_ONCE);
