// The picture in a webview of VS Code.

import type { FromPage, ToPage } from "../../picture/messages";
import { Picture } from "../../picture/picture";
import { speak } from "../../picture/words";

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void; setState(state: unknown): void };

const code = acquireVsCodeApi();

speak(JSON.parse(document.getElementById("words")?.textContent ?? "{}") as Record<string, string>);
const picture = new Picture({
  hear: (message) => {
    code.postMessage(message);
  },
  shows: (uri) => {
    code.setState({ uri });
  },
});
window.addEventListener("message", ({ data }: MessageEvent<ToPage>) => {
  picture.receive(data);
});
new MutationObserver(() => {
  picture.recolour();
}).observe(document.body, { attributes: true, attributeFilter: ["data-vscode-theme-id"] });
