// How an ISO program can be written, and what a machine reads, as lists to choose from. Knows nothing of VS Code.

import { t } from "./words";

export interface Choice {
  label: string;
  description?: string;
  detail?: string;
  /** Missing: whatever the settings say. */
  profile?: string;
}

/** The profiles that every server has. */
const SHIPPED: readonly (readonly [name: string, meant: string])[] = [
  ["generic", "G90, I and J from the start to the centre, mm: what most controls take"],
  ["fast-wire", "Fast-wire controllers that take ISO: G91, whole µm"],
  ["robofil", "Charmilles Robofil: G90 from the thread hole, I and J are the centre"],
];

/** The profile of the settings comes first, then the built-in ones, then the user's own. */
export function choices(set: string | null, own: readonly string[]): Choice[] {
  const others = own.filter((name) => SHIPPED.every(([shipped]) => shipped !== name));
  return [
    { label: t("As the Settings Say"), description: set ?? "", detail: t("wedm.toml beside the drawing or above, else wedm.program.profile, else generic") },
    ...SHIPPED.map(([profile, detail]) => ({ label: profile, detail: t(detail), profile })),
    ...others.map((profile) => ({ label: profile, detail: t("Set in wedm.profiles"), profile })),
  ];
}

/** What `wedm init` knows a machine to read. */
export function machines(): (Choice & { profile: string })[] {
  const blocks = { label: "3B", detail: t("Fast-wire controllers that take 3B"), profile: "3b" };
  return [blocks, ...SHIPPED.map(([profile, detail]) => ({ label: `ISO: ${profile}`, detail: t(detail), profile }))];
}
