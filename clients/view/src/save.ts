// Files that the page writes: beside the drawing, over what is there only when somebody says so.

import { t } from "../../picture/words";
import { Changed, readIfThere, write } from "./api";
import { ask } from "./ask";
import { nameOf } from "./dom";

/** Writes a file; asks before it takes the place of another. False where that is not wanted. */
export async function save(uri: string, content: Uint8Array | string): Promise<boolean> {
  try {
    await write(uri, content, null);
    return true;
  } catch (error) {
    if (!(error instanceof Changed)) {
      throw error;
    }
  }
  const old = await readIfThere(uri);
  const isSame = old !== null && sameBytes(old.bytes, typeof content === "string" ? new TextEncoder().encode(content) : content);
  if (isSame) {
    return true;
  }
  const question = t("{0} is there already. Overwrite it?", nameOf(uri));
  if ((await ask(question, [{ name: "overwrite", text: t("Overwrite"), kind: "primary" }])) !== "overwrite") {
    return false;
  }
  await write(uri, content, old?.revision ?? null);
  return true;
}

/** Changes the text of a file, which may not be there yet; only what was read is replaced. */
export async function rewrite(uri: string, change: (text: string) => string): Promise<void> {
  const old = await readIfThere(uri);
  await write(uri, change(new TextDecoder().decode(old?.bytes ?? new Uint8Array())), old?.revision ?? null);
}

function sameBytes(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, index) => byte === b[index]);
}
