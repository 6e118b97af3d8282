// The language server at the other end of the socket: connected again when it is lost, and told again then what is open.

import type { Diagnostic, Methods, Range } from "../../picture/protocol";
import { Connection } from "./rpc";

export interface Opened {
  uri: string;
  languageId: string;
  version: number;
  text: string;
}

export interface TextEdit {
  range: Range;
  newText: string;
}

interface CodeAction {
  title: string;
  kind?: string;
  edit?: { documentChanges?: { edits: TextEdit[] }[] };
  data?: { said?: string };
}

interface CodeActionParams {
  textDocument: { uri: string };
  range: Range;
  context: { diagnostics: Diagnostic[]; only: string[] };
}

type Requests = Methods & { "textDocument/codeAction": { params: CodeActionParams; result: CodeAction[] | null } };

/** The text was changed while the server worked on it. */
export const CONTENT_MODIFIED = -32801;
/** What is asked for cannot be done; the message says why. */
export const REQUEST_FAILED = -32803;
/** Pauses before the connection is tried again, ms; the last one again and again. */
const PAUSES = [100, 500, 1_000, 2_000, 5_000];

const CAPABILITIES = {
  general: { positionEncodings: ["utf-16"] },
  workspace: { workspaceEdit: { documentChanges: true }, didChangeWatchedFiles: { dynamicRegistration: true } },
  textDocument: {
    publishDiagnostics: { versionSupport: true, dataSupport: true },
    codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ["quickfix", "source.fixAll.wedm"] } }, dataSupport: true },
  },
};

interface Told {
  diagnosed: (uri: string, version: number | null, diagnostics: Diagnostic[]) => void;
  connected: () => void;
  /** Tries again `attempt` times so far. */
  lost: (attempt: number) => void;
}

export class Server {
  #connection: Connection | null = null;
  #isReady = false;
  /** What waits for the connection. */
  #waiting: (() => void)[] = [];
  readonly #open = new Map<string, Opened>();
  #attempt = 0;

  constructor(
    private readonly address: string,
    private readonly language: string,
    private readonly folders: { name: string; uri: string }[],
    private readonly told: Told,
  ) {
    this.#connect();
  }

  #connect(): void {
    const connection: Connection = new Connection(
      this.address,
      (method, params) => {
        this.#heard(method, params);
      },
      // What is refused here is lost with the connection.
      () => void this.#greet(connection).catch(() => undefined),
      () => {
        this.#isReady = false;
        this.told.lost(this.#attempt);
        setTimeout(() => {
          this.#connect();
        }, PAUSES[Math.min(this.#attempt, PAUSES.length - 1)]);
        this.#attempt += 1;
      },
    );
    this.#connection = connection;
  }

  #ready(): Promise<void> {
    return this.#isReady ? Promise.resolve() : new Promise((resolve) => this.#waiting.push(resolve));
  }

  async #greet(connection: Connection): Promise<void> {
    const folders = this.folders.map(({ name, uri }) => ({ name, uri }));
    await connection.request("initialize", {
      processId: null,
      rootUri: folders[0]?.uri ?? null,
      workspaceFolders: folders,
      locale: this.language,
      capabilities: CAPABILITIES,
      initializationOptions: {},
    });
    connection.notify("initialized", {});
    this.#attempt = 0;
    for (const opened of this.#open.values()) {
      connection.notify("textDocument/didOpen", { textDocument: opened });
    }
    this.#isReady = true;
    this.#waiting.splice(0).forEach((resolve) => {
      resolve();
    });
    this.told.connected();
  }

  #heard(method: string, params: unknown): void {
    if (method === "textDocument/publishDiagnostics") {
      const { uri, version, diagnostics } = params as { uri: string; version?: number; diagnostics: Diagnostic[] };
      this.told.diagnosed(uri, version ?? null, diagnostics);
    }
  }

  /** Opens a document, or gives an open one its new text. */
  async put(uri: string, languageId: string, text: string): Promise<number> {
    await this.#ready();
    const version = (this.#open.get(uri)?.version ?? 0) + 1;
    if (version === 1) {
      this.#connection?.notify("textDocument/didOpen", { textDocument: { uri, languageId, version, text } });
    } else {
      this.#connection?.notify("textDocument/didChange", { textDocument: { uri, version }, contentChanges: [{ text }] });
    }
    this.#open.set(uri, { uri, languageId, version, text });
    return version;
  }

  close(uri: string): void {
    if (this.#open.delete(uri)) {
      this.#connection?.notify("textDocument/didClose", { textDocument: { uri } });
    }
  }

  /** A wedm.toml has changed on disk. */
  settingsChanged(uris: readonly string[]): void {
    const changes = uris.map((uri) => ({ uri, type: 2 }));
    this.#connection?.notify("workspace/didChangeWatchedFiles", { changes });
  }

  async request<M extends keyof Requests>(method: M, params: Requests[M]["params"]): Promise<Requests[M]["result"]> {
    await this.#ready();
    return (await this.#connection?.request(method, params)) as Requests[M]["result"];
  }
}
