// Asks the server for programs, and asks again as the user answers what was refused.

import * as vscode from "vscode";
import { LSPErrorCodes, ResponseError } from "vscode-languageclient/node";
import type { Methods } from "../../../picture/protocol";
import type { Pictures } from "../picture/pictures";
import type { Server } from "../server/server";
import type { Sides } from "../../../picture/keep";
import { type Format, TITLES } from "../../../picture/programs";
import { choices } from "../../../picture/profiles";
import { PAIR_IS_NOT_SET, SIDE_IS_NOT_KNOWN } from "../../../picture/refusals";
import { settingsThere } from "./settingsFile";
import { askSides } from "./sides";
import { t } from "../../../picture/words";

interface How {
  options?: { program?: { profile: string } };
  /** The user's answers for contours that no setting covers. */
  sides?: Sides;
  force?: boolean;
}

/** What is asked for, of which drawing. */
interface Asked<M> {
  method: M;
  uri: vscode.Uri;
  format: Format;
}

interface Made<M extends keyof Methods> {
  made: Methods[M]["result"];
  /** What the user said of the wire's sides on the way. */
  sides?: Sides;
}

/** Undefined where the user gives up, or nothing can be done; that has been said then. */
export async function attempt<M extends "wedm/generate" | "wedm/pair">(
  server: Server,
  pictures: Pictures,
  asked: Asked<M>,
): Promise<Made<M> | undefined> {
  const { method, uri, format } = asked;
  let how = format === "iso" ? await chooseProfile(uri) : {};
  while (how !== undefined) {
    const { options, sides, force = false } = how;
    const params = { uri: uri.toString(), format, options: { ...options, ...sides }, ...(force ? { force } : {}) };
    try {
      const made = await vscode.window.withProgress(
        { location: vscode.ProgressLocation.Window, title: t("Wire EDM: generating {0}", TITLES[format]()) },
        (_progress, token) => server.request<M>(method, params, token),
      );
      return { made, ...(sides === undefined ? {} : { sides }) };
    } catch (error) {
      how = await answer(server, pictures, asked, error, how);
    }
  }
  return undefined;
}

async function chooseProfile(uri: vscode.Uri): Promise<How | undefined> {
  const settings = vscode.workspace.getConfiguration("wedm", uri);
  const own = Object.keys(settings.get<object | null>("profiles", null) ?? {});
  const offered = choices(settings.get<string | null>("program.profile", null), own);
  const placeHolder = t("How the ISO program is written");
  const chosen = await vscode.window.showQuickPick(offered, { title: t("Profile"), placeHolder, matchOnDetail: true });
  if (chosen === undefined) {
    return undefined;
  }
  return chosen.profile === undefined ? {} : { options: { program: { profile: chosen.profile } } };
}

async function answer<M>(
  server: Server,
  pictures: Pictures,
  { uri, format }: Asked<M>,
  error: unknown,
  how: How,
): Promise<How | undefined> {
  if (!(error instanceof ResponseError)) {
    void vscode.window.showErrorMessage(`Wire EDM: ${error instanceof Error ? error.message : String(error)}`);
    return undefined;
  }
  if (error.code === LSPErrorCodes.ContentModified) {
    return how;
  }
  const sentence = t("No program: {0}.", error.message);
  if (error.code !== LSPErrorCodes.RequestFailed) {
    void vscode.window.showErrorMessage(sentence);
    return undefined;
  }
  if (how.sides === undefined && SIDE_IS_NOT_KNOWN.test(error.message)) {
    const sides = await askSides(server, pictures, uri, format === "milling");
    return sides === undefined ? undefined : { ...how, sides };
  }
  if (PAIR_IS_NOT_SET.test(error.message)) {
    await offerSettings(server, uri, sentence);
    return undefined;
  }
  const listed = (error.data as { diagnostics?: unknown[] } | undefined)?.diagnostics ?? [];
  const canBeForced = listed.length > 0 && how.force !== true;
  const [problems, force] = [t("Show Problems"), t("Generate All the Same")];
  switch (await vscode.window.showErrorMessage(sentence, ...(canBeForced ? [problems, force] : [problems]))) {
    case problems:
      await vscode.commands.executeCommand("workbench.actions.view.problems");
      return undefined;
    case force:
      return { ...how, force: true };
    case undefined:
    default:
      return undefined;
  }
}

async function offerSettings(server: Server, uri: vscode.Uri, sentence: string): Promise<void> {
  const isThere = (await settingsThere(server, uri)) !== undefined;
  const way = isThere ? t("Open wedm.toml") : t("Create wedm.toml…");
  if ((await vscode.window.showErrorMessage(sentence, way)) === way) {
    await vscode.commands.executeCommand("wedm.createSettings", uri, "pair");
  }
}
