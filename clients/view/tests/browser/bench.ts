// `wedm view` of a folder, and its page in a browser.

import { type ChildProcessWithoutNullStreams, execFile, spawn } from "node:child_process";
import { mkdir, mkdtemp, readFile, rename, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { type Browser, type BrowserContextOptions, chromium, type Locator, type Page } from "playwright-core";
import { ARTIFACTS, CHROMIUM, WEDM } from "./paths";

const FLAGS = ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update"];
/** Longer than anything here takes on a busy machine, ms. */
export const PATIENCE = 40_000;

const run = promisify(execFile);

export class Bench {
  /** What the browser complained of. */
  readonly complaints: string[] = [];

  private constructor(
    readonly folder: string,
    readonly page: Page,
    private readonly server: ChildProcessWithoutNullStreams,
    private readonly browser: Browser,
  ) {}

  /** Starts it with these files, by their names. */
  static async start(files: Record<string, string | Buffer>, options: BrowserContextOptions = {}): Promise<Bench> {
    const folder = await mkdtemp(join(tmpdir(), "view-"));
    await Promise.all(Object.entries(files).map(([name, content]) => writeFile(join(folder, name), content)));
    const server = spawn(WEDM, ["view", folder, "--no-open"], { env: { ...process.env, LC_ALL: "C" } });
    const address = await addressOf(server);
    const browser = await chromium.launch({ executablePath: CHROMIUM, args: FLAGS });
    const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options })).newPage();
    page.setDefaultTimeout(PATIENCE);
    const bench = new Bench(folder, page, server, browser);
    page.on("pageerror", (error) => bench.complaints.push(error.message));
    page.on("console", (message) => {
      if (message.type() === "error") {
        bench.complaints.push(message.text());
      }
    });
    await page.goto(address);
    return bench;
  }

  async stop(): Promise<void> {
    await this.browser.close();
    this.server.kill();
    await rm(this.folder, { recursive: true, force: true });
  }

  /** Ends the program, as somebody does who closes its window. */
  end(): void {
    this.server.kill();
  }

  path(name: string): string {
    return join(this.folder, name);
  }

  read(name: string): Promise<Buffer> {
    return readFile(this.path(name));
  }

  /** As most CAD programs save: over what is there. */
  writeOver(name: string, content: string | Buffer): Promise<void> {
    return writeFile(this.path(name), content);
  }

  /** As others do: beside it, then in its place. */
  async renameOver(name: string, content: string | Buffer): Promise<void> {
    await writeFile(this.path(`${name}.new`), content);
    await rename(this.path(`${name}.new`), this.path(name));
  }

  /** What the command line writes into a file of the folder; it may find errors. */
  async wedm(...words: string[]): Promise<void> {
    await run(WEDM, words, { cwd: this.folder }).catch((error: { code?: number }) => {
      if (error.code !== 1) {
        throw error;
      }
    });
  }

  file(name: string): Locator {
    return this.page.locator("#left .row", { has: this.page.getByText(name, { exact: true }) });
  }

  async open(name: string): Promise<void> {
    await this.file(name).click();
    await this.page.locator("#document", { hasText: name }).waitFor();
    await this.page.locator("#busy").waitFor({ state: "hidden" });
  }

  /** The first finding of a rule in the list. */
  finding(rule: string): Locator {
    const heads = this.page.locator("#panel-findings .row.head", { hasText: rule });
    return heads.locator("xpath=following-sibling::*[1]");
  }

  notice(text: string | RegExp): Locator {
    return this.page.locator("#notices .notice", { hasText: text });
  }

  /** Takes away what was said before. */
  async hush(): Promise<void> {
    await this.page.locator("#notices").evaluate((notices) => {
      notices.replaceChildren();
    });
  }

  async turnTo(tab: "findings" | "radii" | "contours" | "text"): Promise<void> {
    await this.page.locator(`#tab-${tab}`).click();
  }

  async program(name: string): Promise<void> {
    await this.page.locator("#programs > button").click();
    await this.page.locator(`#programs [data-name="${name}"]`).click();
  }

  async shot(name: string): Promise<void> {
    await mkdir(ARTIFACTS, { recursive: true });
    await this.page.waitForTimeout(300);
    await this.page.screenshot({ path: join(ARTIFACTS, `${name}.png`) });
  }
}

/** The address that the program prints. */
function addressOf(server: ChildProcessWithoutNullStreams): Promise<string> {
  return new Promise((resolve, reject) => {
    let said = "";
    const hear = (chunk: Buffer): void => {
      said += chunk.toString();
      const address = /http:\/\/\S+\?token=\w+/.exec(said)?.[0];
      if (address !== undefined) {
        resolve(address);
      }
    };
    server.stdout.on("data", hear);
    server.stderr.on("data", hear);
    server.once("exit", (code) => {
      reject(new Error(`wedm view ended with ${code ?? "a signal"}: ${said}`));
    });
  });
}
