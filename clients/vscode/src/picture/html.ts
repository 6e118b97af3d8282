// The page in which the picture is shown, as text. Knows nothing of VS Code.

import { escaped, markup } from "../../../picture/markup";
import { t } from "../../../picture/words";

export interface Around {
  language: string;
  /** What may be loaded, and from where. */
  policy: string;
  nonce: string;
  /** The address of a file of the page. */
  file: (name: string) => string;
  /** The translations that its script uses, by the English sentence. */
  words: Readonly<Record<string, string>>;
}

export function html({ language, policy, nonce, file, words }: Around): string {
  return `<!DOCTYPE html>
<html lang="${escaped(language)}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<link rel="stylesheet" href="${file("picture.css")}">
<title>${escaped(t("Picture"))}</title>
</head>
<body>
${markup()}
<script type="application/json" id="words">${JSON.stringify(words).replaceAll("<", "\\u003c")}</script>
<script nonce="${nonce}" src="${file("picture.js")}"></script>
</body>
</html>`;
}
