// Builds the extension, the page of the picture and, when asked, the tests:
//   node esbuild.mjs [--production] [--unit] [--browser]
import { build } from "esbuild";
import { cp, readdir } from "node:fs/promises";

const asked = new Set(process.argv.slice(2));
const common = {
  bundle: true,
  sourcemap: asked.has("--production") ? false : "linked",
  minify: asked.has("--production"),
  logLevel: "warning",
  target: "es2022",
};
const node = { ...common, platform: "node", target: "node20" };

/** @param {string} folder */
async function entries(folder) {
  const names = await readdir(folder);
  return names.filter((name) => name.endsWith(".test.ts")).map((name) => `${folder}/${name}`);
}

await build({ ...node, entryPoints: ["src/extension.ts"], outfile: "dist/extension.js", format: "cjs", external: ["vscode"] });
await build({ ...common, platform: "browser", entryPoints: ["webview/picture.ts"], outfile: "dist/picture.js", format: "iife" });
await cp("webview/picture.css", "dist/picture.css");
if (asked.has("--unit")) {
  await build({ ...node, entryPoints: await entries("tests/unit"), outdir: "dist/unit", format: "esm", outExtension: { ".js": ".mjs" }, minify: false });
}
if (asked.has("--browser")) {
  await build({
    ...node,
    entryPoints: ["tests/browser/run.ts"],
    outfile: "dist/browser/run.mjs",
    format: "esm",
    external: ["playwright-core"],
    minify: false,
  });
}
