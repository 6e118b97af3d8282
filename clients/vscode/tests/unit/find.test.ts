import assert from "node:assert/strict";
import { delimiter } from "node:path";
import { test } from "node:test";
import { findServer } from "../../src/server/find";

async function check(setting: string | null, programs: string[], expected: object, suffix = ""): Promise<void> {
  const places = { setting, extensionFolder: "/ext", path: ["relative", "", "/a", "/b"].join(delimiter), suffix, home: "/home/me" };
  const found = await findServer(places, (path) => Promise.resolve(programs.includes(path)));
  assert.deepEqual(found.program === null ? { reason: found.reason } : found, expected);
}

test("the setting, then beside the extension, then the PATH", async () => {
  const all = ["/x/wedm", "/ext/server/wedm", "/a/wedm", "/b/wedm"];
  await check("/x/wedm", all, { program: "/x/wedm", from: "setting" });
  await check(null, all, { program: "/ext/server/wedm", from: "extension" });
  await check(" ", ["/b/wedm", "/a/wedm"], { program: "/a/wedm", from: "path" });
  await check("wedm-2", ["/b/wedm-2"], { program: "/b/wedm-2", from: "setting" });
  await check("~/bin/wedm", ["/home/me/bin/wedm"], { program: "/home/me/bin/wedm", from: "setting" });
  await check(null, ["/home/me/.cargo/bin/wedm", "/b/wedm"], { program: "/b/wedm", from: "path" });
  await check(null, ["/home/me/.cargo/bin/wedm"], { program: "/home/me/.cargo/bin/wedm", from: "cargo" });
  await check(null, ["/b/wedm.exe"], { program: "/b/wedm.exe", from: "path" }, ".exe");
});

test("a setting that leads nowhere is said, and nothing is taken in its place", async () => {
  const others = ["/ext/server/wedm", "/a/wedm", "relative/wedm"];
  const said = (reason: string, setting: string) => ({ reason: `the setting wedm.server.path is "${setting}": ${reason}` });
  await check("/x/wedm", others, said("there is no program of that name", "/x/wedm"));
  await check("bin/wedm", ["bin/wedm"], said("expected an absolute path, or a name on the PATH", "bin/wedm"));
  await check("other", others, said("it is not on the PATH", "other"));
  await check(null, ["relative/wedm"], {
    reason: "wedm is neither beside the extension (/ext/server/wedm) nor on the PATH, nor is it /home/me/.cargo/bin/wedm",
  });
});
