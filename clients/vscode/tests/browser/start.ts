// Starts the browser.

import { statfs } from "node:fs/promises";
import { type Browser, chromium } from "playwright-core";
import { CHROMIUM } from "./paths";

const FLAGS = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];
/** What the pictures of some pages take, bytes. */
const ENOUGH = 256 * 1024 * 1024;

/**
 * Playwright has the browser keep what its processes share, each picture of a page too, in files of /tmp: on a slow disk every frame waits
 * for it. Where the machine has memory for that, it goes there.
 */
export async function startBrowser(): Promise<Browser> {
  const hasMemory = await statfs("/dev/shm").then(({ bavail, bsize }) => bavail * bsize >= ENOUGH, () => false);
  return chromium.launch({ executablePath: CHROMIUM, args: FLAGS, ignoreDefaultArgs: hasMemory ? ["--disable-dev-shm-usage"] : [] });
}
