// The language of a text whose file name does not tell. Knows nothing of VS Code; clients/languages.json keeps it in step with the server.

/** Lines that are looked at: blocks follow soon after the header of a program. */
const LINES = 400;
/** Characters of a line that are looked at. */
const WIDTH = 160;

/** The language of programs in which most lines of a text are; null where it is none. */
export function languageOf(text: string): "3b" | "wire-iso" | null {
  let [blocks, words, others] = [0, 0, 0];
  for (const line of text.replace(/^\ufeff/, "").split(/[\n\r]/, LINES)) {
    const close = line.replace(/[ \t\f\v]/g, "").slice(0, WIDTH).toUpperCase();
    if (close.length <= 2 || /^[;(%*:/]/.test(close)) {
      continue;
    }
    const block = close.replace(/^N\d*:?/, "");
    if (isBlock(block)) {
      blocks += 1;
    } else if (isLineOfWords(block)) {
      words += 1;
    } else {
      others += 1;
    }
  }
  const most = Math.max(blocks, words);
  if (most === 0 || most <= others) {
    return null;
  }
  return blocks >= words ? "3b" : "wire-iso";
}

/** `B9900B0B9900GXL1` */
function isBlock(line: string): boolean {
  return line.startsWith("B") && line.split("B").length > 3 && /G[XY]/.test(line);
}

/** `G01X10.Y-5.`, `X10.`, `M02`: a word that moves or switches the machine first. */
function isLineOfWords(line: string): boolean {
  return /^[GMXYTDHO][\d.+-]/.test(line) && /^[\dA-Z.+,=)-]*$/.test(line.split(/[;(]/, 1)[0] ?? "");
}
