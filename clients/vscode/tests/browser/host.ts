// A real VS Code with the packed extension in it, served to a real browser.

import { type ChildProcess, execFile, spawn } from "node:child_process";
import { rmSync } from "node:fs";
import { mkdir, mkdtemp, readdir, readFile, rm, symlink, writeFile } from "node:fs/promises";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { type Browser, type BrowserContextOptions, type Page } from "playwright-core";
import { PATIENCE } from "./checks";
import { ARTIFACTS, CODE_SERVER, EXTENSION, WEDM } from "./paths";
import { startBrowser } from "./start";

const QUIET = {
  "workbench.startupEditor": "none",
  // Most scenarios are about texts; that of drawings takes it back.
  "workbench.editorAssociations": { "*.dxf": "default" },
  "workbench.colorTheme": "Default Dark Modern",
  "workbench.tips.enabled": false,
  "security.workspace.trust.enabled": false,
  "telemetry.telemetryLevel": "off",
  "update.mode": "none",
  "extensions.autoUpdate": false,
  "extensions.autoCheckUpdates": false,
  "extensions.ignoreRecommendations": true,
  "files.simpleDialog.enable": true,
  "remote.autoForwardPorts": false,
  "window.commandCenter": false,
  "workbench.layoutControl.enabled": false,
  "editor.fontFamily": "'DejaVu Sans Mono', monospace",
};

/** What the machine is like. */
export interface Machine {
  path?: string;
  view?: BrowserContextOptions;
  /** The VSIX with the server in it. */
  withServer?: boolean;
  /** The server is where `cargo install` puts it, and no setting names it. */
  isInstalled?: boolean;
  /** The language of the window, and the packs that it needs. */
  locale?: string;
  extensions?: readonly string[];
}

export class Host {
  private constructor(
    readonly folder: string,
    readonly page: Page,
    private readonly root: string,
    private readonly browser: Browser,
    private readonly server: ChildProcess,
  ) {}

  /** `files` are put into the folder that is opened; `settings` are the user's. */
  static async start(settings: Record<string, unknown>, files: Record<string, string | Buffer>, machine: Machine = {}): Promise<Host> {
    const { path = process.env["PATH"] ?? "", view = {}, withServer = false, isInstalled = false, locale, extensions: others = [] } = machine;
    const root = await mkdtemp(join(tmpdir(), "vscode-test-"));
    const folder = join(root, "work");
    const data = join(root, "data");
    await mkdir(folder, { recursive: true });
    await mkdir(join(data, "User"), { recursive: true });
    await mkdir(ARTIFACTS, { recursive: true });
    // Where the window is not on the machine of the files, a program's path counts only among the machine's own settings.
    await mkdir(join(data, "Machine"), { recursive: true });
    await writeFile(join(data, "Machine", "settings.json"), JSON.stringify(settings));
    await writeFile(join(data, "User", "settings.json"), JSON.stringify({ ...QUIET, ...settings }));
    for (const [name, content] of Object.entries(files)) {
      await writeFile(join(folder, name), content);
    }
    if (isInstalled) {
      await mkdir(join(root, ".cargo/bin"), { recursive: true });
      await symlink(WEDM, join(root, ".cargo/bin/wedm"));
    }
    const own = join(root, "run");
    await mkdir(own, { mode: 0o700 });
    const folders = { HOME: root, TMPDIR: own, XDG_RUNTIME_DIR: own, XDG_DATA_HOME: root, XDG_CONFIG_HOME: root };
    const environment = { ...process.env, ...folders, PATH: path };
    const extensions = await installed([await vsix(withServer), ...others]);
    const places = ["--user-data-dir", data, "--extensions-dir", extensions];
    if (locale !== undefined) {
      await keepLanguagePack(data, extensions, locale);
    }
    const port = await freePort();
    const options = ["--auth", "none", "--bind-addr", `127.0.0.1:${port}`, "--disable-telemetry", "--disable-update-check", "--disable-workspace-trust", ...(locale === undefined ? [] : ["--locale", locale])];
    const server = spawn(process.execPath, [CODE_SERVER, ...places, ...options, folder], { env: environment, stdio: ["ignore", "pipe", "pipe"], detached: true });
    await listening(server);
    const browser = await startBrowser();
    const page = await browser.newPage({ viewport: { width: 1600, height: 960 }, colorScheme: "dark", ...view });
    page.setDefaultTimeout(PATIENCE);
    const host = new Host(folder, page, root, browser, server);
    await page.goto(`http://127.0.0.1:${port}/?folder=${encodeURIComponent(folder)}`);
    await page.locator(".monaco-workbench .explorer-folders-view .monaco-list-row").first().waitFor();
    return host;
  }

  async stop(): Promise<void> {
    await this.browser.close();
    if (this.server.pid !== undefined) {
      // The group holds the extension host and our server.
      process.kill(-this.server.pid, "SIGTERM");
      await new Promise((done) => this.server.once("exit", done));
    }
    await rm(this.root, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  }
}

/** The folders in which extensions are installed, by what is in them: each set is installed once. */
const installations = new Map<string, Promise<string>>();

function installed(extensions: readonly string[]): Promise<string> {
  const key = extensions.join("\n");
  const known = installations.get(key) ?? install(extensions);
  installations.set(key, known);
  return known;
}

async function install(extensions: readonly string[]): Promise<string> {
  const root = await mkdtemp(join(tmpdir(), "vscode-extensions-"));
  process.once("exit", () => {
    rmSync(root, { recursive: true, force: true });
  });
  const [data, folder] = [join(root, "data"), join(root, "extensions")];
  const wanted = extensions.flatMap((extension) => ["--install-extension", extension]);
  const environment = { ...process.env, HOME: root };
  await promisify(execFile)(process.execPath, [CODE_SERVER, "--user-data-dir", data, "--extensions-dir", folder, ...wanted], { env: environment });
  return folder;
}

async function vsix(withServer: boolean): Promise<string> {
  const names = (await readdir(EXTENSION)).filter((name) => name.endsWith(".vsix") && name.endsWith("-with-server.vsix") === withServer);
  if (names[0] === undefined || names.length > 1) {
    throw new Error(`there are ${names.length} VSIX files in ${EXTENSION}, expected one: run ./build-vsix${withServer ? " --with-server PROGRAM" : ""}`);
  }
  return join(EXTENSION, names[0]);
}

function freePort(): Promise<number> {
  return new Promise((resolve, reject) => {
    const probe = createServer();
    probe.once("error", reject);
    probe.listen(0, "127.0.0.1", () => {
      const address = probe.address();
      probe.close(() => {
        resolve(typeof address === "object" && address !== null ? address.port : 0);
      });
    });
  });
}

function listening(server: ChildProcess): Promise<void> {
  return new Promise((resolve, reject) => {
    let said = "";
    const clock = setTimeout(() => {
      reject(new Error(`code-server does not listen: ${said}`));
    }, PATIENCE);
    const hear = (chunk: Buffer): void => {
      said += chunk.toString();
      if (said.includes("HTTP server listening")) {
        clearTimeout(clock);
        resolve();
      }
    };
    server.stdout?.on("data", hear);
    server.stderr?.on("data", hear);
    server.once("exit", (code) => {
      clearTimeout(clock);
      reject(new Error(`code-server ended with ${code ?? "a signal"}: ${said}`));
    });
  });
}

/** Where VS Code looks for its translations; an installation from the command line does not write it down. */
async function keepLanguagePack(data: string, extensions: string, locale: string): Promise<void> {
  for (const name of await readdir(extensions)) {
    const folder = join(extensions, name);
    const text = await readFile(join(folder, "package.json"), "utf8").catch(() => "{}");
    const { publisher = "", name: own = "", version = "", contributes } = JSON.parse(text) as Partial<PackManifest>;
    const pack = contributes?.localizations?.find(({ languageId }) => languageId === locale);
    if (pack !== undefined) {
      const translations = Object.fromEntries(pack.translations.map(({ id, path }) => [id, join(folder, path)]));
      const of = { extensionIdentifier: { id: `${publisher}.${own}`, uuid: "00000000-0000-0000-0000-000000000001" }, version };
      const kept = { [locale]: { hash: `${own}-${version}`, label: pack.localizedLanguageName, extensions: [of], translations } };
      await writeFile(join(data, "languagepacks.json"), JSON.stringify(kept));
    }
  }
}

interface PackManifest {
  publisher: string;
  name: string;
  version: string;
  contributes: {
    localizations?: { languageId: string; localizedLanguageName: string; translations: { id: string; path: string }[] }[];
  };
}
