// What the extension's languages are called, and what kind of document each is.

import type { DocumentFilter } from "vscode-languageclient/node";

export const DRAWING = "dxf";
export const PROGRAMS = ["3b", "wire-iso"] as const;

/** Other schemes hold what cannot be edited, as the old side of a comparison. */
const SCHEMES = ["file", "untitled"] as const;

export function isDrawing(language: string): boolean {
  return language === DRAWING;
}

export function isProgram(language: string): boolean {
  return PROGRAMS.some((program) => program === language);
}

export function isOurs(document: { languageId: string; uri: { scheme: string } }): boolean {
  const known = isDrawing(document.languageId) || isProgram(document.languageId);
  return known && SCHEMES.some((scheme) => scheme === document.uri.scheme);
}

/** The documents that the server is told of: texts of the three languages, and the project's file of settings. */
export function selector(): DocumentFilter[] {
  const languages = [DRAWING, ...PROGRAMS];
  const texts = SCHEMES.flatMap((scheme) => languages.map((language) => ({ scheme, language })));
  return [...texts, { scheme: "file", pattern: "**/wedm.toml" }];
}
