// The beginning of the page of a rule. Knows nothing of VS Code.

/** The severity is in the picture already: the card says what the rule finds. */
const SEVERITY = /^(Default severity|默认级别)/;

/** The first paragraph of a page that says something of the rule, as plain text. */
export function whyOf(page: string): string {
  const paragraphs = page.split(/\r?\n\s*\r?\n/).map((paragraph) => paragraph.trim());
  const first = paragraphs.find((paragraph) => paragraph !== "" && !/^[#|>!*`-]/.test(paragraph) && !SEVERITY.test(paragraph)) ?? "";
  return first.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/[`*]/g, "").replace(/\s+/g, " ");
}
