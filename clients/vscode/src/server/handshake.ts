// Whether the program that answered is a server that this extension can speak with.

import { PROTOCOL } from "../protocol";

/** What of the answer to `initialize` is looked at; whatever answered may have sent anything. */
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
  const name = text(answer?.serverInfo?.name) ?? "unnamed";
  const version = text(answer?.serverInfo?.version) ?? "without a version";
  if (typeof spoken !== "number") {
    return `${program} is not wedm: it says it is ${name} ${version} and names no protocol of wedm`;
  }
  const cure = spoken > PROTOCOL ? "update the extension" : "update the server";
  return `${program} (wedm ${version}) speaks protocol ${spoken} of wedm, this extension speaks ${PROTOCOL}: ${cure}`;
}

function read(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}

function text(value: unknown): string | undefined {
  return typeof value === "string" ? value : undefined;
}
