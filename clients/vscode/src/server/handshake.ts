// Whether the program that answered is a server that this extension can speak with.

import { PROTOCOL } from "../../../picture/protocol";
import { t } from "../../../picture/words";

/** The parts of the answer to `initialize` that are checked; an unknown program may have sent anything. */
export interface Answer {
  serverInfo?: { name?: unknown; version?: unknown } | undefined;
  capabilities?: { experimental?: unknown } | undefined;
}

/** Null when they fit; else a sentence that says what to do. */
export function misfit(answer: Answer | undefined, program: string): string | null {
  const experimental = answer?.capabilities?.experimental;
  const spoken = read(read(experimental, "wedm"), "protocol");
  if (spoken === PROTOCOL) {
    return null;
  }
  const name = text(answer?.serverInfo?.name) ?? t("unnamed");
  const version = text(answer?.serverInfo?.version) ?? t("without a version");
  if (typeof spoken !== "number") {
    return t("{0} is not wedm: it says it is {1} {2} and names no protocol of wedm", program, name, version);
  }
  const cure = spoken > PROTOCOL ? t("update the extension") : t("update the server");
  return t("{0} (wedm {1}) speaks protocol {2} of wedm, this extension speaks {3}: {4}", program, version, spoken, PROTOCOL, cure);
}

function read(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}

function text(value: unknown): string | undefined {
  return typeof value === "string" ? value : undefined;
}
