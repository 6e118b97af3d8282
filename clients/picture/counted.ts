// Numbers of things, in words. Knows nothing of VS Code.

import { t } from "./words";

export function blocksOf(count: number): string {
  return count === 1 ? t("1 block") : t("{0} blocks", count);
}

/** The findings that stand in a drawing, as a sentence of its own; empty for none. */
export function findingsOf(count: number): string {
  const stand = count === 1 ? t(" The drawing has 1 finding.") : t(" The drawing has {0} findings.", count);
  return count === 0 ? "" : stand;
}
