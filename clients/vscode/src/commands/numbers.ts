// Numbers as people type them. Knows nothing of VS Code.

/** With a decimal point or a decimal comma; NaN where it is no number, or nothing. */
export function numberOf(text: string): number {
  return text.trim() === "" ? Number.NaN : Number(text.replace(",", "."));
}

export function isAboveZero(text: string): boolean {
  const number = numberOf(text);
  return number > 0 && Number.isFinite(number);
}
