// What a person does in the window: open, type, look, click.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { actUntil, expectSoon } from "./checks";
import type { Frame, Locator, Page } from "playwright-core";

export class Window {
  constructor(readonly page: Page) {}

  async open(name: string): Promise<void> {
    const explorer = this.page.locator(".explorer-folders-view");
    const row = explorer.locator(".monaco-list-row", { hasText: name }).first();
    const doubleClick = async (): Promise<void> => {
      if (!(await explorer.isVisible())) {
        await this.press("Control+Shift+e", explorer);
      }
      await row.dblclick({ timeout: 8_000 }).catch(() => undefined);
    };
    // A list that takes up new files may move under the pointer: then another row gets the second click.
    await actUntil(`${name} in front`, doubleClick, () => this.#front(name).isVisible());
  }

  /** Opens a file as a text. */
  async openText(name: string): Promise<void> {
    await this.open(name);
    await this.page.locator(".editor-group-container.active .view-lines .view-line").first().waitFor();
  }

  /** Opens a file of ours as a text and waits for the extension. */
  async openOurs(name: string): Promise<void> {
    await this.openText(name);
    await this.status.waitFor();
  }

  /** Brings a file to the front of the first group, by its name. */
  async turnTo(name: string): Promise<void> {
    await this.page.keyboard.press("Control+1");
    await this.ask("Control+p", name, name);
    await this.page.keyboard.press("Enter");
    await this.tab(name);
    await this.status.waitFor();
  }

  /** Waits for the tab of a file in front: what a command has written it opens afterwards, over whatever is turned to before. */
  async tab(name: string): Promise<void> {
    await this.#front(name).waitFor();
  }

  #front(name: string): Locator {
    return this.page.locator(`.tabs-container .tab.active[data-resource-name="${name}"]`).first();
  }

  async command(title: string): Promise<void> {
    await this.ask("F1", `>${title}`, title);
    await this.page.keyboard.press("Enter");
  }

  async goToLine(line: number, column = 1): Promise<void> {
    await this.page.keyboard.press("Control+1");
    await this.ask("Control+g", `:${line},${column}`);
    const box = this.page.locator(".quick-input-widget");
    // In the box itself: once that is closed, a second Enter would go into the text.
    const enter = async (): Promise<void> => box.locator("input").press("Enter", { timeout: 2_000 }).catch(() => undefined);
    await actUntil("the box is closed", enter, () => box.isHidden());
  }

  /** Presses keys until something is seen. */
  async press(keys: string, seen: Locator): Promise<void> {
    const pressed = async (): Promise<void> => {
      for (const key of keys.split(" ")) {
        await this.page.keyboard.press(key);
      }
    };
    await actUntil(`what ${keys} shows`, pressed, () => seen.isVisible());
  }

  /** The hover over the word at the cursor says something; then it is closed. */
  async hover(said: string): Promise<void> {
    await this.press("Control+k Control+i", this.page.locator(".monaco-hover", { hasText: said }).first());
    await this.page.keyboard.press("Escape");
  }

  /** Saves what is in front until the file holds what is expected. */
  async save(what: string, holds: () => Promise<boolean>, seen?: () => Promise<string>): Promise<void> {
    await actUntil(what, () => this.page.keyboard.press("Control+s"), holds, seen);
  }

  /** Opens the list of what could be done at the cursor; the first of it. */
  async quickFix(): Promise<Locator> {
    const first = this.page.locator(".action-widget .monaco-list-row.action").first();
    await this.press("Control+.", first);
    return first;
  }

  /** Types into the box that a key opens. A part that takes the focus just then closes it: it is opened again. */
  async ask(key: string, text: string, offered?: string): Promise<void> {
    const box = this.page.locator(".quick-input-widget");
    for (let attempt = 1; ; attempt += 1) {
      // Where the machine is too slow at the first try, the next one waits longer.
      const timeout = attempt * 6_000;
      try {
        await this.page.keyboard.press(key);
        await box.locator("input").fill(text, { timeout });
        if (offered !== undefined) {
          await box.locator(".monaco-list-row.focused", { hasText: offered }).first().waitFor({ timeout });
        }
        return;
      } catch (error) {
        if (attempt === 5) {
          throw error;
        }
        await this.page.keyboard.press("Escape");
      }
    }
  }

  /** Answers the simple dialog for a file. */
  async path(path: string): Promise<void> {
    const input = this.page.locator(".quick-input-widget input");
    await input.waitFor();
    // The dialog puts its own proposal in when it is ready, also over what has been typed before.
    await expectSoon("the dialog's proposal", async () => (await input.inputValue()).startsWith("/"));
    await expectSoon(path, async () => {
      await input.fill(path);
      await this.page.waitForTimeout(500);
      return (await input.inputValue()) === path;
    });
    await this.page.keyboard.press("Enter");
  }

  get squiggles(): Locator {
    return this.page.locator(".squiggly-error");
  }

  async problems(): Promise<string[]> {
    await this.command("Problems: Focus on Problems View");
    await this.page.locator(".markers-panel").waitFor();
    return this.page.locator(".markers-panel .monaco-list-row").allInnerTexts();
  }

  async hidePanel(): Promise<void> {
    await this.command("View: Hide Panel");
    await this.page.locator(".markers-panel").waitFor({ state: "hidden" });
  }

  get status(): Locator {
    return this.page.locator('.statusbar-item[id$="wedm.correction"]');
  }

  notification(text: string): Locator {
    return this.page.locator(".notification-list-item", { hasText: text });
  }

  /** The line of the cursor, from 1. */
  async line(): Promise<number> {
    return Number(await this.page.locator(".monaco-editor .line-numbers.active-line-number").first().innerText());
  }

  /** Closes a tab by its name. */
  async close(name: string): Promise<void> {
    const tab = this.page.locator(".tabs-container .tab", { hasText: name });
    await tab.hover();
    await tab.locator(".codicon-close").click();
    await tab.waitFor({ state: "detached" });
  }

  /** The page of the picture that is seen; once something is drawn in it, or at once. */
  async picture(drawn = true): Promise<Frame> {
    const outer = await (await this.page.locator("iframe.webview.ready:visible").elementHandle())?.contentFrame();
    const inner = await (await outer?.locator("iframe#active-frame").elementHandle())?.contentFrame();
    if (inner === null || inner === undefined) {
      throw new Error("there is no picture");
    }
    if (drawn) {
      await inner.locator("#stage > svg").waitFor();
    }
    return inner;
  }

  /** The page in which the picture of a file is drawn: that of another one may be seen for a moment when files are turned to. */
  async pictureOf(name: string): Promise<Frame> {
    let found: Frame | undefined;
    let title = "none";
    const isThere = async (): Promise<boolean> => {
      found = await this.picture(false);
      title = await found.locator("#title").innerText();
      return title.startsWith(`${name} · `) && (await found.locator("#stage > svg").count()) > 0;
    };
    await expectSoon(`the picture of ${name}`, isThere, () => Promise.resolve(title));
    if (found === undefined) {
      throw new Error(`there is no picture of ${name}`);
    }
    return found;
  }

  /** Clicks the middle of what is drawn, whatever of the same mark lies over it. */
  async clickDrawn(drawn: Locator): Promise<void> {
    const box = await drawn.boundingBox();
    if (box === null) {
      throw new Error("what is to be clicked is not drawn");
    }
    await this.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  }

  /** Clicks what is drawn until something holds. */
  async clickDrawnUntil(drawn: Locator, what: string, holds: () => Promise<boolean>): Promise<void> {
    await actUntil(what, () => this.clickDrawn(drawn), holds);
  }

  /** Clicks a third of the way along a path of the picture: the box of an arc is larger than what is drawn. */
  async clickPath(picture: Frame, selector: string): Promise<void> {
    const point = await picture.locator(selector).first().evaluate((path: SVGPathElement) => {
      const along = path.getPointAtLength(path.getTotalLength() / 3).matrixTransform(path.getScreenCTM() ?? undefined);
      return { x: along.x, y: along.y };
    });
    const frame = await this.page.locator("iframe.webview.ready:visible").boundingBox();
    await this.page.mouse.click((frame?.x ?? 0) + point.x, (frame?.y ?? 0) + point.y);
  }

  /** Whether two things lie over each other on the screen. */
  async overlap(one: Locator, other: Locator): Promise<boolean> {
    const [a, b] = [await one.boundingBox(), await other.boundingBox()];
    if (a === null || b === null) {
      throw new Error("what is to be compared is not seen");
    }
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
  }

  /** Clicks a contour in the editor of a drawing; where a finding lies there, its card leads to that of the contour. */
  async openContour(picture: Frame, handle: string): Promise<void> {
    const card = picture.locator("#card");
    const named = card.locator("h2, .link", { hasText: /^Contour \d/ }).first();
    const click = async (): Promise<void> => {
      if (await card.isVisible()) {
        await card.locator(".close").click();
      }
      await this.clickPath(picture, `svg .contour[data-handle="${handle}"]`);
    };
    await actUntil(`the card of contour ${handle}`, click, () => named.isVisible());
    const lead = card.locator(".link", { hasText: /^Contour \d/ });
    if ((await lead.count()) > 0) {
      await lead.click();
    }
    await card.locator("h2", { hasText: /^Contour \d/ }).waitFor();
  }

  /** Writes the wedm.toml of a folder, and waits until the correction that it says stands in the status bar: then it holds. */
  async hold(folder: string, settings: string, correction: string): Promise<void> {
    await writeFile(join(folder, "wedm.toml"), settings);
    const shown = (): Promise<string> => this.status.innerText();
    await expectSoon(`the correction ${correction} mm in force`, async () => (await shown()).includes(`${correction} mm`), shown);
  }
}
