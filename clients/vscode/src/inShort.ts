// Correction, side and unit as the status bar has room for them. Knows nothing of VS Code itself.

import type { SettingsInForce, SideSetting } from "../../picture/protocol";
import { t } from "../../picture/words";

export function inShort(settings: Pick<SettingsInForce, "correction" | "correctionFrom" | "corrections" | "side" | "unitsToMm">): string {
  const { correction, correctionFrom, corrections, side, unitsToMm } = settings;
  const passes = corrections.length > 1 ? t(" · {0} passes", corrections.length) : "";
  const from = { default: t("default"), client: t("VS Code settings"), file: "wedm.toml" }[correctionFrom];
  const unit = unitsToMm === undefined ? [] : [unitOf(unitsToMm)];
  return [`${correction.toFixed(3)} mm${passes} (${from})`, sideOf(side), ...unit].join(", ");
}

function sideOf(side: SideSetting): string {
  const sides = { both: t("both sides"), auto: t("by nesting"), opening: t("opening"), punch: t("punch"), left: t("wire on the left"), right: t("wire on the right") };
  return sides[side];
}

function unitOf(mm: number): string {
  if (mm === 1) {
    return t("drawn in mm");
  }
  return mm === 25.4 ? t("drawn in inches") : t("drawn in units of {0} mm", mm);
}
