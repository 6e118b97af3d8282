// Makes the page that the program embeds, src/view/page, out of these sources:
//   node build.mjs [--check | --unit | --browser]
// With --check nothing is written; it fails where the page is not what the sources make.
import { build } from "esbuild";
import { readdir, readFile, writeFile } from "node:fs/promises";

const PAGE = new URL("../../src/view/page/", import.meta.url);
const asked = process.argv[2];
const HERE = new URL(".", import.meta.url).pathname;
process.chdir(HERE);

/**
 * The sentences of a source: first arguments of `t` and `text`, and the words of profiles, which are handed to it.
 * @param {string} source
 */
function sentences(source) {
  const calls = [...source.matchAll(/(?<![.\w])(?:t|text)\(\s*("(?:[^"\\]|\\.)*")/g)].map(([, quoted]) => quoted);
  const meant = [...source.matchAll(/^ {2}\["[\w-]+", ("[^"]*")\],$/gm)].map(([, quoted]) => quoted);
  return [...calls, ...meant].map((quoted) => JSON.parse(quoted));
}

/** The Chinese of every sentence: the picture's are those of VS Code, the page's own stand beside it. */
async function chinese() {
  const table = async (/** @type {string} */ file) => JSON.parse(await readFile(new URL(file, import.meta.url), "utf8"));
  const [shared, own] = [await table("../vscode/l10n/bundle.l10n.zh-cn.json"), await table("zh.json")];
  const folders = [new URL("src/", import.meta.url), new URL("../picture/", import.meta.url)];
  const said = new Set();
  for (const folder of folders) {
    for (const name of (await readdir(folder)).filter((name) => name.endsWith(".ts") && name !== "protocol.ts" && name !== "words.ts")) {
      sentences(await readFile(new URL(name, folder), "utf8")).filter((sentence) => !sentence.startsWith(".")).forEach((sentence) => said.add(sentence));
    }
  }
  const missing = [...said].filter((sentence) => shared[sentence] === undefined && own[sentence] === undefined);
  const idle = Object.keys(own).filter((sentence) => !said.has(sentence) || shared[sentence] !== undefined);
  if (missing.length + idle.length > 0) {
    throw new Error(`zh.json lacks ${JSON.stringify(missing, null, 2)} and holds what nobody says ${JSON.stringify(idle, null, 2)}`);
  }
  return Object.fromEntries([...said].sort().map((sentence) => [sentence, own[sentence] ?? shared[sentence]]));
}

/** `import chinese from "chinese"`. */
const words = {
  name: "chinese",
  setup(/** @type {import("esbuild").PluginBuild} */ plugins) {
    plugins.onResolve({ filter: /^chinese$/ }, () => ({ path: "chinese", namespace: "words" }));
    plugins.onLoad({ filter: /.*/, namespace: "words" }, async () => ({ contents: JSON.stringify(await chinese()), loader: "json" }));
  },
};

async function page() {
  const common = { absWorkingDir: HERE, bundle: true, minify: true, write: false, target: "es2022", logLevel: "warning", charset: "utf8", legalComments: "none" };
  const [script, style] = await Promise.all([
    build({ ...common, entryPoints: ["src/main.ts"], format: "iife", platform: "browser", plugins: [words] }),
    build({ ...common, entryPoints: ["src/page.css"] }),
  ]);
  return {
    "index.html": await readFile("src/index.html", "utf8"),
    "page.js": script.outputFiles[0].text,
    "page.css": style.outputFiles[0].text,
    "icon.svg": await readFile("../vscode/icons/dxf.svg", "utf8"),
  };
}

const tests = { absWorkingDir: HERE, bundle: true, platform: "node", target: "node20", format: "esm", logLevel: "warning", external: ["playwright-core"] };
if (asked === "--unit" || asked === "--browser") {
  const folder = asked.slice(2);
  const names = folder === "unit" ? await readdir("tests/unit") : ["run.ts"];
  const entryPoints = names.map((name) => `tests/${folder}/${name}`);
  await build({ ...tests, entryPoints, outdir: `dist/${folder}`, outExtension: { ".js": ".mjs" }, plugins: [words] });
} else {
  for (const [name, text] of Object.entries(await page())) {
    const file = new URL(name, PAGE);
    if (asked !== "--check") {
      await writeFile(file, text);
    } else if ((await readFile(file, "utf8").catch(() => "")) !== text) {
      console.error(`src/view/page/${name} is not what clients/view makes; make it again with: node clients/view/build.mjs`);
      process.exitCode = 1;
    }
  }
}
