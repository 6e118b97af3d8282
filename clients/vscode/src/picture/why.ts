// What the page of a rule says first. Knows nothing of VS Code.

/** How severe a rule is stands in the picture: the card says what it finds. */
const SEVERITY = /^(Default severity|默认级别)/;

/** The first paragraph of a page that says something of the rule, as plain text. */
export function whyOf(page: string): string {
  const paragraphs = page.split(/\r?\n\s*\r?\n/).map((paragraph) => paragraph.trim());
  const first = paragraphs.find((paragraph) => paragraph !== "" && !/^[#|>!*`-]/.test(paragraph) && !SEVERITY.test(paragraph)) ?? "";
  return first.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/[`*]/g, "").replace(/\s+/g, " ");
}
