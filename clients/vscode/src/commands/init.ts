// What `wedm init` is asked with. Knows nothing of VS Code.

/** What a wire and its gap are where nobody says, mm: as docs/settings.md has them. */
export const WIRE = 0.18;
export const GAP = 0.01;

export interface Answers {
  wire: number;
  gap: number;
  passes: number;
  /** `3b`, or a profile of ISO programs. */
  machine: string;
}

export function initOptions({ wire, gap, passes, machine }: Answers, folder: string): string[] {
  return ["init", "--wire", String(wire), "--gap", String(gap), "--passes", String(passes), "--machine", machine, "--", folder];
}

export function isPasses(text: string): boolean {
  return /^[1-9]$/.test(text.trim());
}
