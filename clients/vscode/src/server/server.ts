// The one server: found, started, watched, started again when it dies. Documents are opened again by the client with each start.

import type { ChildProcessWithoutNullStreams } from "node:child_process";
import { homedir } from "node:os";
import { setTimeout as sleep } from "node:timers/promises";
import * as vscode from "vscode";
import type { CodeAction, CodeActionParams, LanguageClient, LanguageClientOptions } from "vscode-languageclient/node";
import { CloseAction, ErrorAction, RevealOutputChannelOn, State as ClientState } from "vscode-languageclient/node";
import { selector } from "../languages";
import type { Methods } from "../../../picture/protocol";
import { abilities } from "./abilities";
import { QuietClient } from "./client";
import { findServer } from "./find";
import { misfit } from "./handshake";
import { isProgram, launch } from "./process";
import { Restarts } from "./restarts";
import { forServer } from "./settings";
import { t } from "../../../picture/words";

/** What may be asked: the requests of wedm's own name space, and the one of LSP that VS Code would answer otherwise. */
interface Requests extends Methods {
  "textDocument/codeAction": { params: CodeActionParams; result: CodeAction[] | null };
}

/** A program that has not answered by then is no server. */
const PATIENCE = 20_000;
/** How long to wait for the exit code of a server after its pipe was closed, in ms. */
const CODE_FOLLOWS = 500;
/** How long a server may take to end by itself. */
const LAST_WORDS = 2_000;

export type State =
  | { kind: "stopped" | "starting" | "running" }
  /** Dead, and about to be started again. */
  | { kind: "waiting"; reason: string }
  /** Nothing more is tried until the user does something. */
  | { kind: "failed"; reason: string; cure: Cure };

/** What the user can do: choose another program, or try again. */
export type Cure = "program" | "restart";

export class Server implements vscode.Disposable {
  #client: LanguageClient | undefined;
  #child: ChildProcessWithoutNullStreams | undefined;
  #state: State = { kind: "stopped" };
  #timer: NodeJS.Timeout | undefined;
  /** The number of the start; events of older ones are ignored. */
  #start = 0;
  readonly #restarts = new Restarts();
  /** When the running server answered `initialize`; 0 before. */
  #ready = 0;
  readonly #changed = new vscode.EventEmitter<State>();
  readonly #diagnosed = new vscode.EventEmitter<vscode.Uri>();

  readonly onDidChangeState = this.#changed.event;
  /** The server has checked a document again. */
  readonly onDidDiagnose = this.#diagnosed.event;

  constructor(
    private readonly context: vscode.ExtensionContext,
    private readonly log: vscode.LogOutputChannel,
  ) {}

  get state(): State {
    return this.#state;
  }

  /** The program in use, or the one that would be. */
  async find(): ReturnType<typeof findServer> {
    const setting = vscode.workspace.getConfiguration("wedm").get<string | null>("server.path", null);
    const suffix = process.platform === "win32" ? ".exe" : "";
    const places = {
      setting,
      suffix,
      extensionFolder: this.context.extensionPath,
      path: process.env["PATH"] ?? "",
      home: homedir(),
    };
    return findServer(places, isProgram);
  }

  /** Starts again whatever was before; resolves when the server runs or has failed. */
  async restart(): Promise<void> {
    this.#restarts.reset();
    await this.#launch();
  }

  async #launch(): Promise<void> {
    const start = ++this.#start;
    await this.#end();
    this.#ready = 0;
    this.#become({ kind: "starting" });
    const found = await this.find();
    if (start !== this.#start) {
      return;
    }
    if (found.program === null) {
      this.#fail(found.reason, "program");
      return;
    }
    let child: ChildProcessWithoutNullStreams;
    try {
      child = await launch(found.program, vscode.workspace.getConfiguration("wedm").get("server.log", "warn"));
    } catch (error) {
      if (start !== this.#start) {
        return;
      }
      this.#fail(t("{0} could not be started: {1}", found.program, error instanceof Error ? error.message : String(error)), "program");
      return;
    }
    if (start !== this.#start) {
      child.kill();
      return;
    }
    this.#child = child;
    await this.#begin(start, found.program, child);
  }

  async #begin(start: number, program: string, child: ChildProcessWithoutNullStreams): Promise<void> {
    let ended = t("it ended");
    let babbled = false;
    const exited = new Promise<void>((resolve) => {
      child.once("exit", (code, signal) => {
        const how = signal === null ? t("it ended with code {0}", code ?? 0) : t("it ended with {0}", signal);
        ended = babbled ? t("it wrote what is no message, and was killed") : how;
        this.log.info(`${program} (process ${child.pid ?? 0}): ${ended}`);
        resolve();
      });
    });
    // The client may hear of the closed pipe before there is a code.
    const died = async (): Promise<void> => {
      await Promise.race([exited, sleep(CODE_FOLLOWS)]);
      this.#died(start, ended);
    };
    const client = new QuietClient("wedm", "Wire EDM", () => Promise.resolve(child), this.#options());
    client.registerFeature(abilities);
    client.onBabble = (error) => {
      this.log.error(`${program} (process ${child.pid ?? 0}) wrote what is no message: ${error.message}`);
      babbled = true;
      child.kill("SIGKILL");
    };
    this.#client = client;
    const silence = new AbortController();
    const clock = setTimeout(() => {
      silence.abort();
      child.kill("SIGKILL");
    }, PATIENCE);
    try {
      // If the server ends before it answers, the client may wait for ever, or take it as started.
      await Promise.race([client.start(), exited]);
    } catch (error) {
      this.log.debug(`${program}: ${String(error)}`);
    } finally {
      clearTimeout(clock);
    }
    if (start !== this.#start) {
      return;
    }
    if (client.initializeResult === undefined) {
      if (silence.signal.aborted) {
        await this.#end();
        this.#fail(t("{0} does not answer: there was nothing within {1} s", program, PATIENCE / 1_000), "program");
      } else {
        await died();
      }
      return;
    }
    const unfit = misfit(client.initializeResult, program);
    if (unfit !== null) {
      await this.#end();
      this.#fail(unfit, "program");
      return;
    }
    client.onDidChangeState(({ newState }) => {
      if (newState === ClientState.Stopped) {
        void died();
      }
    });
    if (client.state === ClientState.Stopped) {
      await died();
      return;
    }
    this.#ready = Date.now();
    this.log.info(`${program} (process ${child.pid ?? 0}) runs: ${client.initializeResult.serverInfo?.version ?? ""}`);
    this.#become({ kind: "running" });
  }

  #died(start: number, reason: string): void {
    if (start !== this.#start) {
      return;
    }
    this.log.error(reason);
    const pause = this.#restarts.afterLifeOf(this.#ready === 0 ? 0 : Date.now() - this.#ready);
    if (pause === null) {
      this.#fail(t("the server has ended 6 times in a row ({0}) and is not started again", reason), "restart");
      return;
    }
    const when = pause === 0 ? "" : t(" in {0} s", pause / 1_000);
    this.#become({ kind: "waiting", reason: t("the server has ended ({0}); it is started again{1}", reason, when) });
    this.#timer = setTimeout(() => void this.#launch(), pause);
  }

  #fail(reason: string, cure: Cure): void {
    this.log.error(reason);
    this.#become({ kind: "failed", reason, cure });
  }

  #become(state: State): void {
    this.#state = state;
    this.#changed.fire(state);
  }

  /** Ends what runs, and what waits to be started. */
  async #end(): Promise<void> {
    clearTimeout(this.#timer);
    const [client, child] = [this.#client, this.#child];
    this.#client = this.#child = undefined;
    try {
      if (client !== undefined && client.state !== ClientState.Stopped) {
        await client.stop(LAST_WORDS);
      }
      await client?.dispose(LAST_WORDS);
    } catch (error) {
      this.log.debug(`the server did not end in order: ${String(error)}`);
    }
    child?.kill();
  }

  /** Asks the server. Rejects with its error, or when it does not run. */
  async request<M extends keyof Requests>(
    method: M,
    params: Requests[M]["params"],
    token?: vscode.CancellationToken,
  ): Promise<Requests[M]["result"]> {
    const client = this.#client;
    if (client === undefined || this.#state.kind !== "running") {
      throw new Error("the wedm server is not running");
    }
    // A token that is undefined would be sent as a second param.
    return token === undefined
      ? client.sendRequest<Requests[M]["result"]>(method, params)
      : client.sendRequest<Requests[M]["result"]>(method, params, token);
  }

  #options(): LanguageClientOptions {
    return {
      documentSelector: selector(),
      outputChannel: this.log,
      traceOutputChannel: this.log,
      initializationOptions: {},
      progressOnInitialization: false,
      // What cannot be sent to a server that has just ended is in the log; its end is told by itself.
      revealOutputChannelOn: RevealOutputChannelOn.Never,
      // A failure at the start is reported once for all tries.
      initializationFailedHandler: () => false,
      // Ends and what is no message are dealt with above, as docs/protocol.md says; the client's own way starts again at once, four times.
      errorHandler: {
        error: () => ({ action: ErrorAction.Continue, handled: true }),
        closed: () => ({ action: CloseAction.DoNotRestart, handled: true }),
      },
      middleware: {
        handleDiagnostics: (uri, diagnostics, next) => {
          next(uri, diagnostics);
          this.#diagnosed.fire(uri);
        },
        workspace: {
          configuration: async (params, token, next) => {
            const sections = await next(params, token);
            return Array.isArray(sections) ? sections.map((section: unknown) => forServer(section)) : sections;
          },
          // The server then asks for the section, which it gets without the extension's own keys.
          didChangeConfiguration: (_sections, next) => next(undefined),
        },
      },
    };
  }

  async stop(): Promise<void> {
    this.#start += 1;
    await this.#end();
    this.#become({ kind: "stopped" });
  }

  dispose(): void {
    void this.stop();
  }
}
