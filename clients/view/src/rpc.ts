// JSON-RPC 2.0 over a WebSocket: one message a frame.

export class Refusal extends Error {
  constructor(
    readonly code: number,
    message: string,
    readonly data: unknown,
  ) {
    super(message);
  }
}

interface Message {
  id?: number | string;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { code: number; message: string; data?: unknown };
}

interface Waiting {
  resolve: (result: unknown) => void;
  reject: (error: Error) => void;
}

const METHOD_NOT_FOUND = -32601;

export class Connection {
  readonly #socket: WebSocket;
  readonly #waiting = new Map<number, Waiting>();
  #last = 0;

  constructor(
    address: string,
    /** A notification of the server. */
    private readonly told: (method: string, params: unknown) => void,
    opened: () => void,
    closed: () => void,
  ) {
    this.#socket = new WebSocket(address);
    this.#socket.addEventListener("open", opened);
    this.#socket.addEventListener("message", ({ data }: MessageEvent<string>) => {
      this.#heard(JSON.parse(data) as Message);
    });
    this.#socket.addEventListener("close", () => {
      for (const { reject } of this.#waiting.values()) {
        reject(new Error("the connection is lost"));
      }
      this.#waiting.clear();
      closed();
    });
  }

  request(method: string, params: unknown): Promise<unknown> {
    this.#last += 1;
    const id = this.#last;
    return new Promise((resolve, reject) => {
      if (this.#socket.readyState !== WebSocket.OPEN) {
        reject(new Error("the connection is lost"));
        return;
      }
      this.#waiting.set(id, { resolve, reject });
      this.#send({ id, method, params });
    });
  }

  notify(method: string, params: unknown): void {
    if (this.#socket.readyState === WebSocket.OPEN) {
      this.#send({ method, params });
    }
  }

  #send(message: Message): void {
    this.#socket.send(JSON.stringify({ jsonrpc: "2.0", ...message }));
  }

  #heard({ id, method, params, result, error }: Message): void {
    if (method !== undefined && id !== undefined) {
      // The server asks for what the handshake declares, which is to be told of settings: anything else is not known.
      const isKnown = method === "client/registerCapability" || method === "client/unregisterCapability";
      this.#send({ id, ...(isKnown ? { result: null } : { error: { code: METHOD_NOT_FOUND, message: "not known" } }) });
    } else if (method !== undefined) {
      this.told(method, params);
    } else if (typeof id === "number") {
      const waiting = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (error === undefined) {
        waiting?.resolve(result);
      } else {
        waiting?.reject(new Refusal(error.code, error.message, error.data));
      }
    }
  }
}
