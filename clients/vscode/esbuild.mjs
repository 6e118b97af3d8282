// Builds the extension, the page of the picture and, when asked, the tests:
//   node esbuild.mjs [--production] [--unit] [--browser]
import { build } from "esbuild";
import { cp, readdir, readFile, writeFile } from "node:fs/promises";

const asked = new Set(process.argv.slice(2));
/**
 * The licences of the packages whose files are in the bundle, which travel with it.
 * @param {string[]} files
 */
async function licences(files) {
  const folders = [...new Set(files.map((file) => /^.*node_modules\/(@[^/]+\/)?[^/]+/.exec(file)?.[0]).filter((folder) => folder !== undefined))];
  const texts = folders.sort().map(async (folder) => {
    const { name, version, license } = JSON.parse(await readFile(`${folder}/package.json`, "utf8"));
    const file = (await readdir(folder)).find((file) => /^licen[cs]e/i.test(file));
    const text = file === undefined ? `Licence: ${license}` : await readFile(`${folder}/${file}`, "utf8");
    return `${name} ${version}\n\n${text.trim()}\n`;
  });
  return (await Promise.all(texts)).join(`\n${"-".repeat(80)}\n\n`);
}

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

/**
 * The pictures that pages show, which are those of the documentation.
 * @param {string} folder
 */
async function pictures(folder) {
  const texts = await Promise.all((await readdir(folder)).map((name) => readFile(`${folder}/${name}`, "utf8")));
  return new Set(texts.flatMap((text) => [...text.matchAll(/\(\.\.\/dist\/pictures\/([\w.-]+)\)/g)].map(([, name]) => name)));
}

const extension = { entryPoints: ["src/extension.ts"], outfile: "dist/extension.js", format: "cjs", external: ["vscode"], metafile: true };
const { metafile } = await build({ ...node, ...extension });
if (asked.has("--production")) {
  await writeFile("dist/THIRD-PARTY.txt", await licences(Object.keys(metafile.inputs)));
}
await build({ ...common, platform: "browser", entryPoints: ["webview/picture.ts"], outfile: "dist/picture.js", format: "iife" });
await build({ ...common, entryPoints: ["webview/picture.css"], outfile: "dist/picture.css" });
for (const picture of await pictures("walkthrough")) {
  await cp(`../../docs/pictures/${picture}`, `dist/pictures/${picture}`);
}
if (asked.has("--unit")) {
  await build({ ...node, entryPoints: await entries("tests/unit"), outdir: "dist/unit", format: "esm", outExtension: { ".js": ".mjs" }, minify: false });
}
if (asked.has("--browser")) {
  await build({
    ...node,
    entryPoints: ["tests/browser/run.ts"],
    outfile: "dist/browser/run.mjs",
    format: "esm",
    external: ["playwright-core", "vscode-jsonrpc"],
    minify: false,
  });
}
