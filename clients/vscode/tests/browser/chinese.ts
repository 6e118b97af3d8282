// The window in Chinese, as a language pack makes it: what the extension says, and what VS Code says of it.

import { execFile } from "node:child_process";
import { mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { actUntil, type WindowChecks, expectEqual, expectSoon } from "./checks";
import { Host } from "./host";
import { EXTENSION, PROJECT, WEDM } from "./paths";
import { Window } from "./window";

const SMALL = await readFile(join(PROJECT, "docs/pictures/small-radius.dxf"), "utf8");
/** Words of VS Code itself, so that it is seen that the pack is in force. */
const WORDS = { "vs/workbench/contrib/files/browser/explorerViewlet": { explore: "资源管理器" } };

/** A language pack as VS Code takes it, with a few words: Microsoft's is in no registry of packages. `CHINESE_PACK` names another. */
async function languagePack(folder: string): Promise<string> {
  const given = process.env["CHINESE_PACK"];
  if (given !== undefined) {
    return given;
  }
  const translations = [{ id: "vscode", path: "./main.i18n.json" }];
  const localizations = [{ languageId: "zh-cn", languageName: "Chinese Simplified", localizedLanguageName: "中文(简体)", translations }];
  const named = { name: "chinese", publisher: "wedm-test", version: "1.0.0", license: "MIT", engines: { vscode: "^1.91.0" } };
  const manifest = { ...named, categories: ["Language Packs"], contributes: { localizations } };
  await mkdir(folder, { recursive: true });
  await writeFile(join(folder, "package.json"), JSON.stringify(manifest));
  await writeFile(join(folder, "README.md"), "Chinese words for a test.\n");
  await writeFile(join(folder, "main.i18n.json"), JSON.stringify({ "": [], version: "1.0.0", contents: WORDS }));
  const pack = join(folder, "chinese.vsix");
  const vsce = join(EXTENSION, "node_modules/@vscode/vsce/vsce");
  const quietly = ["--no-dependencies", "--skip-license", "--allow-missing-repository"];
  await promisify(execFile)(process.execPath, [vsce, "package", ...quietly, "-o", pack], { cwd: folder });
  return pack;
}

export async function chinese(checks: WindowChecks): Promise<void> {
  const folder = await mkdtemp(join(tmpdir(), "chinese-"));
  const language = { locale: "zh-cn", extensions: [await languagePack(join(folder, "pack"))] };
  const settings = { "wedm.server.path": WEDM, "wedm.correction": 0.1, "workbench.editorAssociations": {} };
  const host = await Host.start(settings, { "small-radius.dxf": SMALL }, language);
  const window = new Window(host.page);
  checks.page = host.page;
  try {
    await checks.check("VS Code is Chinese", async () => {
      await host.page.locator('.activitybar [aria-label*="资源管理器"]').first().waitFor();
      await host.page.locator('.activitybar [aria-label*="线切割"]').first().waitFor();
    });
    await window.open("small-radius.dxf");
    const page = await window.pictureOf("small-radius.dxf");
    await checks.check("so are the picture, its toolbar and what is found", async () => {
      await expectSoon("four faults", async () => (await page.locator("svg .drawing .fault").count()) === 4);
      for (const [part, words] of Object.entries({ "#text": "文本", "#fix-all": "全部修复", "#fit": "全图", "#alert": "4 " })) {
        expectEqual(part, (await page.locator(part).innerText()).includes(words), true);
      }
      expectEqual("English in it", await english(page.locator("body").innerText()), []);
      await checks.shot("chinese-picture");
    });
    await checks.check("so is the card of a finding", async () => {
      await actUntil("the card", () => page.locator("#chips .chip").first().click(), () => page.locator("#card .primary").isVisible());
      expectEqual("English in it", await english(page.locator("#card").innerText()), []);
      await checks.shot("chinese-card");
    });
    await checks.check("so are the list, the problems and the status bar", async () => {
      await host.page.locator('.activitybar [aria-label*="线切割"]').first().click();
      const row = host.page.locator(".sidebar .monaco-list-row", { hasText: "轮廓 1" });
      await row.waitFor();
      await host.page.locator(".sidebar .monaco-list-row", { hasText: "直线 2.820" }).waitFor();
      await host.page.keyboard.press("Control+Shift+m");
      const problem = host.page.locator(".markers-panel .monaco-list-row", { hasText: "R 0.040" });
      await problem.waitFor();
      expectEqual("a problem", (await problem.innerText()).includes("补偿量"), true);
      expectEqual("the status bar", /双侧|两侧|mm/.test(await window.status.innerText()), true);
      await checks.shot("chinese-lists");
      await host.page.keyboard.press("Control+Shift+m");
    });
    await checks.check("so are the commands and the settings", async () => {
      await window.ask("F1", ">线切割 3B");
      await host.page.locator(".quick-input-widget .monaco-list-row", { hasText: "生成 3B 程序" }).first().waitFor();
      await checks.shot("chinese-commands");
      await host.page.keyboard.press("Escape");
      await host.page.keyboard.press("Control+,");
      await host.page.locator(".settings-editor .suggest-input-container .monaco-editor").first().click();
      await host.page.keyboard.type("@ext:wedm.wedm");
      const side = host.page.locator('.settings-editor [data-key="wedm.side"]');
      await side.waitFor();
      await expectSoon("not set", async () => (await side.locator("select").evaluate((select: HTMLSelectElement) => select.selectedOptions[0]?.text ?? "")).startsWith("未设置"));
      await checks.shot("chinese-settings");
    });
  } finally {
    await host.stop();
    await rm(folder, { recursive: true, force: true });
  }
}

/** Words of English in a text: of more than three letters, and no name of a file, a rule, or a value of a setting. */
async function english(text: Promise<string>): Promise<string[]> {
  const words = (await text).match(/[A-Za-z][\w.-]{3,}/g) ?? [];
  return [...new Set(words)].filter((word) => !/^(small-radius|auto|opening|punch|.*\.dxf|wedm\.toml)$/.test(word));
}
