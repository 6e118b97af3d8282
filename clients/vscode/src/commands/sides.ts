// Asks what the contours of a drawing are where no setting says so, each marked in the picture, and keeps the answer if the user wants.

import * as vscode from "vscode";
import type { Pictures } from "../picture/pictures";
import type { ContoursContour, Role } from "../../../picture/protocol";
import type { Server } from "../server/server";
import { keep, type Sides } from "../../../picture/keep";
import { rewrite, settingsFile } from "./settingsFile";
import { t } from "../../../picture/words";

/** By nesting, one by one, or the answer for the only one. */
interface Way extends vscode.QuickPickItem {
  choice: "nesting" | "each" | Role;
}

interface Answer extends vscode.QuickPickItem {
  role: Role;
}

// Functions, since the language is not chosen yet when this is read.
const opening = (mills: boolean): Answer =>
  mills
    ? { label: t("Opening: Electrode Inside"), detail: t("It mills along the wall of a pocket"), role: "opening" }
    : { label: t("Opening: Wire Inside"), detail: t("What falls out is scrap, as of a die's plate"), role: "opening" };
const punch = (mills: boolean): Answer =>
  mills
    ? { label: t("Punch: Electrode Outside"), detail: t("It mills round what stays"), role: "punch" }
    : { label: t("Punch: Wire Outside"), detail: t("What falls out is the part"), role: "punch" };
const onLine = (): Answer => ({ label: t("On the Line"), detail: t("A slit, a clamp, a mark: the wire's centre runs on it"), role: "line" });
const notCut = (): Answer => ({ label: t("Not Cut"), detail: t("A frame, a construction line"), role: "ignore" });

/** The answers for contours of unknown side, for a wire or an electrode that `mills`; undefined where the user gives up. */
export async function askSides(server: Server, pictures: Pictures, uri: vscode.Uri, mills: boolean): Promise<Sides | undefined> {
  const { contours, unitsToMm } = await server.request("wedm/contours", { uri: uri.toString() });
  const unknown = contours.filter(({ closed, role }) => closed && role === "both");
  await pictures.open(uri, false);
  const several = unknown.length > 1;
  const byNesting: Way = {
    label: t("By Nesting"),
    detail: t("What lies outermost is a punch, a contour within it an opening, and so on") + (several ? t(": {0} contours", unknown.length) : ""),
    choice: "nesting",
  };
  const each: Way = { label: t("Choose for Each Contour…"), detail: t("They are marked in the picture one after another"), choice: "each" };
  const one = [opening(mills), punch(mills)].map((answer): Way => ({ ...answer, choice: answer.role }));
  const ways = several ? [byNesting, each] : [byNesting, ...one];
  try {
    if (!several) {
      pictures.mark(handlesOf(unknown));
    }
    const placeHolder = several ? t("On which side of each contour to cut is not known") : t("The contour that is marked in the picture");
    const title = mills ? t("Which Side Does the Electrode Run On?") : t("Which Side Does the Wire Run On?");
    const way = await vscode.window.showQuickPick(ways, { title, placeHolder, ignoreFocusOut: true });
    if (way === undefined || way.choice === "nesting") {
      return way && { side: "auto" };
    }
    const roles = way.choice === "each" ? await askEach(pictures, unknown, unitsToMm, mills) : [way.choice];
    return roles && { contours: rolesOf(unknown, roles) };
  } finally {
    pictures.mark(null);
  }
}

type Asked = readonly ContoursContour[];

async function askEach(pictures: Pictures, unknown: Asked, unitsToMm: number, mills: boolean): Promise<Role[] | undefined> {
  const roles: Role[] = [];
  for (const [index, contour] of unknown.entries()) {
    pictures.mark(handlesOf([contour]));
    const title = t("Contour {0} of {1}", index + 1, unknown.length);
    const placeHolder = t("The one that is marked in the picture, {0} mm round", (contour.length * unitsToMm).toFixed(3));
    const answers = [opening(mills), punch(mills), ...(mills ? [] : [onLine()]), notCut()];
    const answer = await vscode.window.showQuickPick(answers, { title, placeHolder, ignoreFocusOut: true });
    if (answer === undefined) {
      return undefined;
    }
    roles.push(answer.role);
  }
  return roles;
}

/** A contour takes the role of its first entity that has one. */
function rolesOf(contours: readonly ContoursContour[], roles: readonly Role[]): Record<string, Role> {
  return Object.fromEntries(
    contours.flatMap((contour, index) => {
      const role = roles[index];
      // To leave a contour uncut, every entity of it must be named.
      const handles = role === "ignore" ? handlesOf([contour]) : handlesOf([contour]).slice(0, 1);
      return role === undefined ? [] : handles.map((handle): [string, Role] => [handle, role]);
    }),
  );
}

function handlesOf(contours: readonly ContoursContour[]): string[] {
  return [...new Set(contours.flatMap(({ segments }) => segments.map(({ handle }) => handle)))];
}

/** Offers to write the answer down, in the wedm.toml that holds or in one beside the drawing. */
export async function offerToKeep(server: Server, uri: vscode.Uri, sides: Sides, mills: boolean): Promise<void> {
  const target = await settingsFile(server, uri);
  const general = await forAll(server, uri, target, sides);
  if (general === undefined || uri.scheme !== "file") {
    return;
  }
  const yes = t("Keep in wedm.toml");
  const asked = mills ? t("Keep these sides of the electrode for the next time?") : t("Keep these sides of the wire for the next time?");
  if ((await vscode.window.showInformationMessage(asked, yes)) !== yes) {
    return;
  }
  await rewrite(target, (text) => keep(text, general));
}

/** Handles are those of one drawing. Where the file holds for others too, the answer is kept by layer, if layers can say it. */
async function forAll(server: Server, uri: vscode.Uri, target: vscode.Uri, sides: Sides): Promise<Sides | undefined> {
  if (!("contours" in sides)) {
    return sides;
  }
  const around = new vscode.RelativePattern(vscode.Uri.joinPath(target, ".."), "**/*.{dxf,DXF}");
  if ((await vscode.workspace.findFiles(around, null, 2)).length <= 1) {
    return sides;
  }
  const { entities } = await server.request("wedm/inspect", { uri: uri.toString() });
  const layers: Record<string, Role> = {};
  for (const { handle, layer } of entities) {
    const role = sides.contours[handle];
    if (role !== undefined && (layers[layer] ??= role) !== role) {
      return undefined;
    }
  }
  return { layers };
}
