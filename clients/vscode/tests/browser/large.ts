// A drawing of 5,000 contours: the page alone in the browser, zoomed frame by frame.

import { spawn } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createMessageConnection, StreamMessageReader, StreamMessageWriter } from "vscode-jsonrpc/node.js";
import type { Picture } from "../../../picture/protocol";
import { openAlone, shown, tell } from "./alone";
import { type WindowChecks, expectEqual, expectSoon } from "./checks";
import { WEDM } from "./paths";
import { startBrowser } from "./start";

const COLUMNS = 100;
const ROWS = 50;
/** Frames in a second that the picture has to keep while it is zoomed. */
const GOAL = 30;

/** Openings of six lines and arcs each, every tenth with a fillet that is too tight. */
function plates(): string {
  const contours = Array.from({ length: COLUMNS * ROWS }, (_, index) => {
    const [x, y] = [(index % COLUMNS) * 12, Math.floor(index / COLUMNS) * 12];
    const r = index % 10 === 0 ? 0.05 : 1;
    const quarter = "0.41421356237309503";
    const vertices = [[x, y], [x + 8 - r, y, quarter], [x + 8, y + r], [x + 8, y + 7, quarter], [x + 7, y + 8], [x, y + 8]];
    const written = vertices.map(([a, b, bulge]) => `10\n${String(a)}\n20\n${String(b)}\n${bulge === undefined ? "" : `42\n${bulge}\n`}`);
    return `0\nLWPOLYLINE\n5\n${(256 + index).toString(16).toUpperCase()}\n8\n0\n90\n${vertices.length}\n70\n1\n${written.join("")}`;
  });
  return `0\nSECTION\n2\nENTITIES\n${contours.join("")}0\nENDSEC\n0\nEOF\n`;
}

/** The picture of a drawing, as a client has it from the server. */
async function drawn(text: string): Promise<Picture> {
  const server = spawn(WEDM);
  const connection = createMessageConnection(new StreamMessageReader(server.stdout), new StreamMessageWriter(server.stdin));
  connection.listen();
  const uri = "file:///plates.dxf";
  await connection.sendRequest("initialize", { processId: null, rootUri: null, capabilities: {}, initializationOptions: { side: "opening" } });
  await connection.sendNotification("initialized", {});
  await connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "dxf", version: 1, text } });
  const picture = await connection.sendRequest<Picture>("wedm/picture", { uri, pieces: true });
  connection.dispose();
  server.kill();
  return picture;
}

export async function large(checks: WindowChecks): Promise<void> {
  const folder = await mkdtemp(join(tmpdir(), "large-"));
  const browser = await startBrowser();
  try {
    const picture = await drawn(plates());
    const page = await openAlone(browser, folder);
    checks.page = page;
    await checks.check("5,000 contours are drawn, with what is too tight as marks with counts", async () => {
      const tight = picture.pieces?.filter((piece) => piece.class === "fault error") ?? [];
      const faults = tight.map(({ handle = "", segment = 0 }) => ({
        severity: "error" as const, rule: "small-radius", message: "too tight", handle, segment, radius: 0.05,
      }));
      expectEqual("faults", faults.length, 500);
      // The slow parts are listed one by one, so that a slow machine shows what it waits for.
      const began = Date.now();
      await tell(page, shown({ ...picture, faults }));
      await page.evaluate(() => document.title);
      console.log(`  the page has taken it in after ${Date.now() - began} ms`);
      await page.locator("#stage > canvas").waitFor({ timeout: 300_000 });
      console.log(`  the canvas is there after ${Date.now() - began} ms`);
      await page.waitForTimeout(800);
      expectEqual("in the tree", (await page.locator("svg .drawing .contour").count()) < 10, true);
      await checks.shot("large");
    });
    await checks.check("zoomed, and every frame is drawn", async () => {
      const rate = async (): Promise<number> =>
        page.evaluate(async () => {
          const stage = document.getElementById("stage");
          const frames: number[] = [];
          const began = performance.now();
          await new Promise<void>((done) => {
            const step = (now: number): void => {
              frames.push(now);
              const share = (now - began) / 4000;
              stage?.dispatchEvent(new WheelEvent("wheel", { deltaY: share < 0.5 ? -24 : 24, clientX: 640, clientY: 400, bubbles: true, cancelable: true }));
              if (share < 1) {
                requestAnimationFrame(step);
              } else {
                done();
              }
            };
            requestAnimationFrame(step);
          });
          return ((frames.length - 1) * 1000) / ((frames.at(-1) ?? 1) - (frames[0] ?? 0));
        });
      const frames = await rate();
      console.log(`  ${frames.toFixed(1)} frames a second; the goal is ${GOAL} on a machine with nothing else to do`);
      expectEqual("frames", frames > 0, true);
      await page.waitForTimeout(400);
      await checks.shot("large-zoomed");
    });
    await checks.check("what is clicked on the canvas is picked", async () => {
      await page.locator("#chips .chip").first().click();
      await expectSoon("selected", async () => (await page.locator("svg .fault.selected").count()) === 1);
      await checks.shot("large-close");
    });
  } finally {
    await browser.close();
    await rm(folder, { recursive: true, force: true });
  }
}
