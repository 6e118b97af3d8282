// Every sentence of the extension and of its page in the language of VS Code: English is in the code, the others in `l10n/`.

/** The sentence with `{0}`, `{1}` filled in. */
type Translate = (sentence: string, ...what: (string | number)[]) => string;

function filled(sentence: string, what: readonly (string | number)[]): string {
  return sentence.replace(/\{(\d+)\}/g, (placeholder, index) => String(what[Number(index)] ?? placeholder));
}

let translate: Translate = (sentence, ...what) => filled(sentence, what);

/** A sentence in the language of VS Code. */
export function t(sentence: string, ...what: (string | number)[]): string {
  return translate(sentence, ...what);
}

/** Sets the translations, by the English sentence; a sentence without one stays English. */
export function speak(sentences: Readonly<Record<string, string>>): void {
  translate = (sentence, ...what) => filled(sentences[sentence] ?? sentence, what);
}
