// What bad days look like: no server, a server of another version, one that writes what is no message, one that dies in the middle of an
// edit, a file too large for VS Code.

import { execFile } from "node:child_process";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import { actUntil, type WindowChecks, expectEqual, expectSoon, PATIENCE } from "./checks";
import { FILLET, large, lineOf } from "./drawings";
import { Host } from "./host";
import { FAKE_SERVER, WEDM } from "./paths";
import { Window } from "./window";

const BULGE = "0.41421356237309503";

export async function badDays(checks: WindowChecks): Promise<void> {
  await missing(checks);
  await killed(checks);
}

/** No server anywhere, then one of another version, then the right one: each by a change of the setting. */
async function missing(checks: WindowChecks): Promise<void> {
  const host = await Host.start({}, { "plate.dxf": FILLET }, { path: "/usr/bin:/bin" });
  const window = new Window(host.page);
  checks.page = host.page;
  const choose = async (path: string): Promise<void> => {
    await mkdir(join(host.folder, ".vscode"), { recursive: true });
    await writeFile(join(host.folder, ".vscode/settings.json"), JSON.stringify({ "wedm.server.path": path }));
  };
  try {
    await window.openText("plate.dxf");
    await checks.check("a server that is missing is said, with the way to get it", async () => {
      const notice = window.notification("neither beside the extension");
      await notice.waitFor();
      expectEqual("advice", (await notice.innerText()).includes("cargo install --path ."), true);
      await notice.getByRole("button", { name: "How to Get It" }).waitFor();
      await expectSoon("a red item", async () => (await window.status.innerText()).includes("wedm"), () => window.status.innerText());
      await checks.shot("server-missing");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("a setting that leads nowhere is said", async () => {
      await choose("/nowhere/wedm");
      await window.notification('the setting wedm.server.path is "/nowhere/wedm"').waitFor();
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("a server of another protocol is refused with both versions", async () => {
      await choose(FAKE_SERVER);
      const notice = window.notification("speaks protocol 2 of wedm, this extension speaks 1: update the extension");
      await notice.waitFor();
      expectEqual("version", (await notice.innerText()).includes("wedm 9.9.9"), true);
      await checks.shot("other-protocol");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("a server that dies at every start is given up after five more tries, and that is said once", async () => {
      const dies = join(host.folder, "..", "dies");
      await writeFile(dies, `#!/bin/sh\necho >>${dies}.starts\necho the disk is full >&2\nexit 3\n`, { mode: 0o755 });
      await choose(dies);
      await window.notification("the server has ended 6 times in a row (it ended with code 3) and is not started again").waitFor({ timeout: PATIENCE });
      await checks.shot("dies");
      expectEqual("starts", (await readFile(`${dies}.starts`, "utf8")).length, 6);
      expectEqual("notices", await host.page.locator(".notifications-toasts .notification-list-item").count(), 1);
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("the right server is taken at once when the setting names it", async () => {
      await choose(WEDM);
      await window.squiggles.first().waitFor();
      await expectSoon("0.100 mm", async () => (await window.status.innerText()).includes("0.100 mm"), () => window.status.innerText());
    });
    await checks.check("a server that writes what is no message is killed, and another one started", async () => {
      const babbles = join(host.folder, "..", "babbles");
      const starts = async (): Promise<number[]> => (await readFile(`${babbles}.starts`, "utf8")).trim().split("\n").map(Number);
      const first = `[ $(wc -l <${babbles}.starts) = 1 ] && exec ${process.execPath} ${FAKE_SERVER} babbles`;
      await writeFile(babbles, `#!/bin/sh\necho $$ >>${babbles}.starts\n${first}\nexec ${WEDM} serve\n`, { mode: 0o755 });
      await choose(babbles);
      await expectSoon("another start", async () => (await starts()).length > 1, async () => JSON.stringify(await starts()));
      await window.squiggles.first().waitFor();
      const [babbler, ...others] = await starts();
      expectEqual("other starts", others.length, 1);
      expectEqual("the one that babbled still lives", lives(babbler ?? 0), false);
      expectEqual("notices", await host.page.locator(".notifications-toasts .notification-list-item").count(), 0);
    });
  } finally {
    await host.stop();
  }
}

async function killed(checks: WindowChecks): Promise<void> {
  const big = large(51 * 1024 * 1024);
  const host = await Host.start({ "wedm.server.path": WEDM, "workbench.editorLargeFileConfirmation": 1024 }, { "plate.dxf": FILLET, "second.dxf": FILLET, "large.dxf": big });
  const window = new Window(host.page);
  checks.page = host.page;
  const line = lineOf(FILLET, BULGE);
  try {
    // A second text that is open, in a tab behind the first, with an edit that is not saved.
    await window.openText("second.dxf");
    await window.squiggles.first().waitFor();
    await window.goToLine(line - 4, 1);
    await host.page.keyboard.press("Shift+End");
    await host.page.keyboard.type("19.93");
    await window.openText("plate.dxf");
    await window.squiggles.first().waitFor();
    await checks.check("a text that is changed by undo while a repair is on its way stays as it is", async () => {
      const server = await onlyServer(host.folder);
      await window.goToLine(line - 4, 1);
      await host.page.keyboard.press("End");
      await host.page.keyboard.type("1");
      await host.page.locator(".view-lines", { hasText: "19.951" }).waitFor();
      process.kill(server, "SIGSTOP");
      try {
        await window.command("Wire EDM: Fix All That Is Safe to Fix");
        // Asked, and not answered.
        await host.page.locator(".statusbar", { hasText: "looking for repairs" }).waitFor();
        await host.page.keyboard.press("Control+1");
        await host.page.keyboard.press("Control+z");
        await host.page.locator(".view-lines", { hasText: "19.951" }).waitFor({ state: "detached" });
      } finally {
        process.kill(server, "SIGCONT");
      }
      await window.notification("the text has changed in the meantime, nothing was done").waitFor();
      await host.page.keyboard.press("Control+s");
      await expectSoon("the text before", async () => (await readFile(join(host.folder, "plate.dxf"), "utf8")) === FILLET);
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("a server that is killed in the middle of an edit comes back, and knows the text as it is", async () => {
      await window.goToLine(line - 4, 1);
      const before = await onlyServer(host.folder);
      await host.page.keyboard.press("Shift+End");
      for (const [edit, character] of ["1", "9", ".", "9", "4"].entries()) {
        if (edit === 2) {
          process.kill(before, "SIGKILL");
        }
        await host.page.keyboard.type(character);
      }
      const another = async (): Promise<boolean> => {
        const now = await servers(host.folder);
        return now.length === 1 && now[0] !== before;
      };
      await expectSoon("another server", another, async () => JSON.stringify(await servers(host.folder)));
      await says(window, "arc R 0.055 mm is below");
      // The other text too, as it is in the window and in no file.
      await says(window, "arc R 0.061 mm is below");
      await checks.shot("restarted");
    });
    await checks.check("the state is right again: edits after the restart are judged", async () => {
      await window.goToLine(line - 4, 5);
      await host.page.keyboard.press("Delete");
      await host.page.keyboard.type("5");
      await says(window, "arc R 0.050 mm is below");
    });
    await checks.check("a restart that the user asks for leaves everything as it was", async () => {
      const before = await servers(host.folder);
      await window.command("Wire EDM: Restart Server");
      await expectSoon("another server", async () => {
        const now = await servers(host.folder);
        return now.length === 1 && now[0] !== before[0];
      });
      await says(window, "arc R 0.050 mm is below");
      await window.hidePanel();
    });
    await checks.check("a drawing over 50 MB is said to be too large, and is checked by its path", async () => {
      const row = host.page.locator(".explorer-folders-view .monaco-list-row", { hasText: "large.dxf" }).first();
      const notice = window.notification("VS Code hands files over 50 MB to no extension");
      await actUntil("the notice", () => row.dblclick(), () => notice.isVisible());
      await checks.shot("too-large");
      await notice.getByRole("button", { name: "Check It by Path" }).click();
      await window.notification("large.dxf: 1 error").waitFor({ timeout: PATIENCE });
      await expectSoon("the finding under Problems", async () => (await window.problems()).some((row) => row.includes("wedm check")), async () => (await window.problems()).join("\n"));
      await checks.shot("checked-by-path");
    });
  } finally {
    await host.stop();
  }
}

async function says(window: Window, text: string): Promise<void> {
  await expectSoon(text, async () => (await window.problems()).some((row) => row.includes(text)), async () => (await window.problems()).join("\n"));
}

function lives(pid: number): boolean {
  try {
    return process.kill(pid, 0);
  } catch {
    return false;
  }
}

/** The one that serves this window; no other may ever be stopped. */
async function onlyServer(folder: string): Promise<number> {
  const [server, ...others] = await servers(folder);
  if (server === undefined || others.length > 0) {
    throw new Error(`expected one server, seen ${server === undefined ? 0 : 1 + others.length}`);
  }
  return server;
}

/** The processes of our server that serve this window. */
async function servers(folder: string): Promise<number[]> {
  const { stdout } = await promisify(execFile)("ps", ["-eo", "pid,args"]);
  const lines = stdout.split("\n").filter((line) => line.trim().endsWith(`${WEDM} serve`));
  const pids = lines.map((line) => Number(line.trim().split(" ")[0]));
  const owned = await Promise.all(pids.map((pid) => isOf(pid, folder)));
  return pids.filter((_pid, index) => owned[index]);
}

/** Others may run the same program on this machine: ours has our window's home. */
async function isOf(pid: number, folder: string): Promise<boolean> {
  try {
    const { stdout } = await promisify(execFile)("cat", [`/proc/${pid}/environ`]);
    return stdout.includes(join(folder, ".."));
  } catch {
    return false;
  }
}
