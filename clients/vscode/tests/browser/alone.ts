// The picture's page by itself, without a VS Code about it: what is sent to it is chosen here.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { html } from "../../src/picture/html";
import type { Shown, ToPage } from "../../../picture/messages";
import { EXTENSION } from "./paths";

const THEME =
  "<style>:root { --vscode-editor-background: #1f1f1f; --vscode-editor-foreground: #cccccc; --vscode-descriptionForeground: #9d9d9d; --vscode-font-family: sans-serif }</style>";
const HOST = "<script>window.told = []; window.acquireVsCodeApi = () => ({ postMessage: (m) => window.told.push(m), setState: () => {} });</script>";

/** The page, made in `folder`. */
export async function openAlone(browser: Browser, folder: string): Promise<Page> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const file = (name: string): string => `file://${join(EXTENSION, "dist", name)}`;
  const text = html({ language: "en", policy: "", nonce: "", file, words: {} }).replace(/<meta http-equiv[^>]*>/, THEME + HOST);
  await writeFile(join(folder, "page.html"), text);
  await page.goto(`file://${join(folder, "page.html")}`);
  return page;
}

export async function tell(page: Page, message: ToPage): Promise<void> {
  // As text: what drives the browser takes long for many objects.
  await page.evaluate((told) => {
    window.postMessage(JSON.parse(told), "*");
  }, JSON.stringify(message));
}

/** A picture as the extension sends it, but for what is said. */
export function shown(said: Partial<Shown> & { svg: string }): Shown {
  const name = "plates.dxf";
  return { type: "picture", uri: `file:///${name}`, name, kind: "drawing", faults: [], contours: [], blocks: [], lines: [], isEditor: true, keeps: true, ...said };
}
