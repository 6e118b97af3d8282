// What this client can do beyond LSP, told to the server in `initialize`.

import type { ClientCapabilities, FeatureState, StaticFeature } from "vscode-languageclient";

/** The commands that the server's code lenses name are registered here. */
export const abilities: StaticFeature = {
  fillClientCapabilities(capabilities: ClientCapabilities): void {
    const others = typeof capabilities.experimental === "object" ? (capabilities.experimental as object) : {};
    capabilities.experimental = { ...others, wedm: { codeLens: true, rulePages: true } };
  },
  initialize: () => undefined,
  getState: (): FeatureState => ({ kind: "static" }),
  clear: () => undefined,
};
