// The files of the folders, as `wedm view` serves them.

export interface Start {
  version: string;
  language: "en" | "zh";
  roots: { name: string; uri: string }[];
  /** The files that were named by themselves. */
  opened: string[];
  hasSettings: boolean;
}

export interface FileEntry {
  uri: string;
  path: string;
  language: "dxf" | "3b" | "wire-iso" | "toml";
  bytes: number;
  /** null until the file has been looked at. */
  errors: number | null;
  warnings: number | null;
  /** Why it cannot be looked at; else null. */
  trouble: string | null;
}

export interface Files {
  files: FileEntry[];
  pending: boolean;
  left: number;
}

/** A file as it was read: only this revision of it is replaced. */
export interface Read {
  bytes: Uint8Array;
  revision: string;
}

/** The file is another one than was read, or it is there already. */
export class Changed extends Error {}

async function answer(address: string, request: RequestInit = {}): Promise<Response> {
  const response = await fetch(address, { cache: "no-store", ...request });
  if (!response.ok) {
    const sentence = (await response.text()).trim() || response.statusText;
    throw response.status === 412 ? new Changed(sentence) : new Error(sentence);
  }
  return response;
}

const addressOf = (uri: string): string => `/api/file?uri=${encodeURIComponent(uri)}`;

export async function start(): Promise<Start> {
  return (await (await answer("/api/start")).json()) as Start;
}

export async function files(): Promise<Files> {
  return (await (await answer("/api/files")).json()) as Files;
}

export async function read(uri: string): Promise<Read> {
  const response = await answer(addressOf(uri));
  return { bytes: new Uint8Array(await response.arrayBuffer()), revision: response.headers.get("ETag") ?? "" };
}

/** The report of a drawing as it is on disk, as `wedm report` makes it. */
export async function report(uri: string): Promise<Uint8Array> {
  return new Uint8Array(await (await answer(`/api/report?uri=${encodeURIComponent(uri)}`)).arrayBuffer());
}

/** Null where there is no such file. */
export async function readIfThere(uri: string): Promise<Read | null> {
  const response = await fetch(addressOf(uri), { cache: "no-store" });
  return response.status === 404 ? null : read(uri);
}

/** Writes a file: in place of this revision, or of nothing. Answers the new revision. */
export async function write(uri: string, bytes: Uint8Array | string, revision: string | null): Promise<string> {
  const condition: Record<string, string> = revision === null ? { "If-None-Match": "*" } : { "If-Match": revision };
  const response = await answer(addressOf(uri), { method: "PUT", headers: condition, body: bytes as BodyInit });
  return response.headers.get("ETag") ?? "";
}

export interface Changes {
  files: () => void;
  saved: (uri: string) => void;
  writing: (uri: string) => void;
  /** The program answers again, after it did not. */
  back: () => void;
}

/** Tells what changes on disk from now on. */
export function watch(changes: Changes): void {
  const events = new EventSource("/api/changes");
  let lost = false;
  const uriOf = (event: MessageEvent<string>): string => (JSON.parse(event.data) as { uri: string }).uri;
  events.addEventListener("files", changes.files);
  events.addEventListener("saved", (event: MessageEvent<string>) => {
    changes.saved(uriOf(event));
  });
  events.addEventListener("writing", (event: MessageEvent<string>) => {
    changes.writing(uriOf(event));
  });
  events.addEventListener("error", () => {
    lost = true;
  });
  events.addEventListener("open", () => {
    if (lost) {
      lost = false;
      changes.back();
    }
  });
}
