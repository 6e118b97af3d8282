// The language client, without notices of its own about starts and ends of the server: notices.ts shows these, with what can be done.

import { window } from "vscode";
import type { MessageTransports } from "vscode-languageclient/node";
import { LanguageClient, LSPErrorCodes, ResponseError } from "vscode-languageclient/node";

export class QuietClient extends LanguageClient {
  /** Something that is no message has come from the server: whatever follows it is not read. */
  onBabble: (error: Error) => void = () => undefined;

  /** Only here are errors of what was read told from those of what was to be written. */
  protected override async createMessageTransports(encoding: string): Promise<MessageTransports> {
    const transports = await super.createMessageTransports(encoding);
    transports.reader.onError((error) => {
      this.onBabble(error);
    });
    return transports;
  }

  override error(message: string, data?: unknown, show: boolean | "force" = true): void {
    // Why the server refuses is of more use than which request it was.
    const refusal = show === true && data instanceof ResponseError && data.code === LSPErrorCodes.RequestFailed ? data : undefined;
    super.error(message, data, show === "force" || refusal ? false : show);
    if (refusal) void window.showWarningMessage(refusal.message);
  }
}
