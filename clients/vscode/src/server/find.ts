// Where the server's program is: by the setting, beside the extension, on the PATH, where cargo installs. Knows nothing of VS Code.

import { delimiter, isAbsolute, join } from "node:path";
import { t } from "../../../picture/words";

export interface Places {
  /** `wedm.server.path`, where it is set. */
  setting: string | null;
  extensionFolder: string;
  /** The variable PATH. */
  path: string;
  /** Extensions of programs: `.exe` on Windows, none elsewhere. */
  suffix: string;
  home: string;
}

export type Found = { program: string; from: "setting" | "extension" | "path" | "cargo" } | { program: null; reason: string };

const NAME = "wedm";

/** A setting that names no program is an error, and nothing else is taken in its place: that might silently be another version. */
export async function findServer(places: Places, isProgram: (path: string) => Promise<boolean>): Promise<Found> {
  const setting = places.setting?.trim() ?? "";
  if (setting !== "") {
    return bySetting(setting, places, isProgram);
  }
  const beside = join(places.extensionFolder, "server", NAME + places.suffix);
  if (await isProgram(beside)) {
    return { program: beside, from: "extension" };
  }
  const onPath = await first(candidates(NAME, places), isProgram);
  if (onPath !== null) {
    return { program: onPath, from: "path" };
  }
  // VS Code's PATH is that of a login shell, which need not contain cargo's folder.
  const cargo = join(places.home, ".cargo", "bin", NAME + places.suffix);
  return (await isProgram(cargo))
    ? { program: cargo, from: "cargo" }
    : { program: null, reason: t("wedm is neither beside the extension ({0}) nor on the PATH, nor is it {1}", beside, cargo) };
}

async function bySetting(setting: string, places: Places, isProgram: (path: string) => Promise<boolean>): Promise<Found> {
  const path = setting.replace(/^~(?=[/\\]|$)/, places.home);
  const fail = (reason: string): Found => ({ program: null, reason: t('the setting wedm.server.path is "{0}": {1}', setting, reason) });
  if (isAbsolute(path)) {
    const program = await first([path, path + places.suffix], isProgram);
    return program === null ? fail(t("there is no program of that name")) : { program, from: "setting" };
  }
  if (/[/\\]/.test(path)) {
    return fail(t("expected an absolute path, or a name on the PATH"));
  }
  const program = await first(candidates(path, places), isProgram);
  return program === null ? fail(t("it is not on the PATH")) : { program, from: "setting" };
}

function candidates(name: string, places: Places): string[] {
  const folders = places.path.split(delimiter).filter((folder) => isAbsolute(folder));
  return folders.flatMap((folder) => [join(folder, name + places.suffix)]);
}

async function first(paths: string[], isProgram: (path: string) => Promise<boolean>): Promise<string | null> {
  for (const path of paths) {
    if (await isProgram(path)) {
      return path;
    }
  }
  return null;
}
