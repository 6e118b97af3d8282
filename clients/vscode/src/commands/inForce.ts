// What is set in VS Code, as options of the command line, which knows nothing of it. Knows nothing of VS Code itself.

import type { SettingsInForce } from "../../../picture/protocol";

/** On the command line an option overrides every `wedm.toml`: so only what none of them sets is handed on, the side where there is none. */
export function asOptions(inForce: Pick<SettingsInForce, "correctionFrom" | "corrections" | "side" | "file">): string[] {
  const { correctionFrom, corrections, side, file } = inForce;
  const [first, ...further] = corrections;
  const passes = further.length > 0 ? ["--passes", corrections.join(",")] : ["--correction", String(first)];
  return [
    ...(correctionFrom === "client" && first !== undefined ? passes : []),
    ...(file === undefined && side !== "both" ? ["--side", side] : []),
  ];
}
