// The page of `wedm view`: its parts are put together, and told of each other.

import { markup } from "../../picture/markup";
import { t } from "../../picture/words";
import { start, type Start, watch } from "./api";
import { ask, complain, menu, say } from "./ask";
import { Bench } from "./bench";
import { type Doc, isDrawing } from "./doc";
import { button, make } from "./dom";
import { FileList } from "./files";
import { help, type Key, listen } from "./keys";
import { readable } from "./page";
import { Programs } from "./programs";
import { isInPlace, Repairs, setInPlace } from "./repairs";
import { Right } from "./right";
import { Server } from "./server";
import { SettingsForm } from "./settings";
import { chooseLanguage, switchLanguage, switchTheme, wearTheme } from "./theme";

/** Panes of a narrow window, of which one is seen. */
type Pane = "left" | "middle" | "right";

/** Connections that fail one after another before it is taken that the program has ended. */
const ENDED = 6;

function showPane(pane: Pane): void {
  document.body.dataset["pane"] = pane;
  for (const each of document.querySelectorAll<HTMLElement>("#panes button")) {
    each.setAttribute("aria-pressed", String(each.dataset["pane"] === pane));
  }
}

async function begin(): Promise<void> {
  wearTheme(() => {
    bench?.picture.recolour();
  });
  const started = await start();
  const language = chooseLanguage(started.language);
  const server = new Server(`ws://${location.host}/lsp`, language, started.roots, {
    diagnosed: (uri, version, found) => {
      if (uri.endsWith("/wedm.toml")) {
        form.diagnosed(uri, found);
      } else {
        bench?.diagnosed(uri, version, found);
      }
    },
    connected: () => {
      connection("");
    },
    lost: (attempt) => {
      connection(attempt < ENDED ? t("The connection is lost; it is tried again…") : t("wedm view has ended. Start it again, and open the address that it prints."));
    },
  });
  const form = new SettingsForm(server, () => bench?.doc ?? null, started.roots[0]?.uri ?? "");
  const there = (): Bench => {
    if (bench === null) {
      throw new Error("the page is not ready");
    }
    return bench;
  };
  const repairs = new Repairs(server, there);
  const programs = new Programs(server, there, form);
  const open = (uri: string): void => {
    showPane("middle");
    (uri.endsWith("/wedm.toml") ? form.open(false, uri) : there().open(uri)).catch(complain);
  };
  let settingsFiles = "";
  const files = new FileList(open, (all) => {
    const now = all.filter((file) => file.language === "toml").map(({ uri }) => uri);
    if (settingsFiles !== "" && settingsFiles !== now.join()) {
      server.settingsChanged([...new Set([...now, ...settingsFiles.split(",")])]);
    }
    settingsFiles = now.join() || "none";
    bench?.listed(all);
    if (bench !== null && bench.doc === null) {
      openFirst(files, started.opened, open);
    }
  });
  const right = new Right({
    fault: (index) => {
      showPane("middle");
      there().picture.lookAt(index, true);
    },
    segment: (handle, segment, opened) => {
      if (opened) {
        there().picture.approach(handle, segment);
      } else {
        there().picture.receive({ type: "segment", handle, segment });
      }
    },
    contour: (handle) => {
      there().picture.openContour(handle);
    },
    line: (line) => {
      there().picture.receive({ type: "line", line });
    },
    radii: () => there().radii(),
  });
  const bar = toolbar(started, language, { repairs, programs, form, there });
  const middle = make("div", { id: "middle", class: "pane" });
  middle.innerHTML = markup();
  const panes = ([["left", t("Files")], ["middle", t("Picture")], ["right", t("Lists")]] as const).map(([pane, text]) =>
    button(text, () => { showPane(pane); }, { "data-pane": pane }));
  document.body.replaceChildren(
    bar.element,
    make("p", { id: "connection", role: "alert", hidden: true }),
    make("div", { id: "columns" }, files.element, middle, right.element),
    make("div", { id: "panes", role: "toolbar", "aria-label": t("View") }, ...panes),
    make("div", { id: "notices", "aria-live": "polite" }),
  );
  showPane("middle");
  bench = new Bench(server, {
    right,
    turned: (doc) => {
      files.putMemory(there().memory);
      files.mark(doc.uri);
      bar.turned(doc);
      const address = doc.revision === null ? "" : `#${encodeURIComponent(doc.uri)}`;
      if (location.hash !== address) {
        history.replaceState(null, "", address === "" ? "/" : address);
      }
    },
    repairsOf: (doc, finding) => repairs.of(doc, finding),
    fix: (finding, title) => repairs.one(finding, title),
    keep: (handles, said) => form.keepContour(handles, said),
    explain: async (rule) => {
      const { text } = await server.request("wedm/rulePage", { rule });
      await ask(rule, [], readable(text));
    },
    exportPicture: () => {
      programs.picture("svg").catch(complain);
    },
  });
  dropped(there());
  const keys = keysOf({ files, right, repairs, form, bar, there });
  listen(keys);
  watch({
    files: () => {
      files.soon();
    },
    saved: (uri) => {
      if (uri.endsWith("/wedm.toml")) {
        server.settingsChanged([uri]);
      } else {
        bench?.saved(uri).catch(complain);
      }
    },
    writing: (uri) => {
      bench?.writing(uri);
    },
    back: () => {
      files.soon();
      const uri = bench?.doc?.revision === null ? undefined : bench?.doc?.uri;
      if (uri !== undefined) {
        bench?.saved(uri).catch(complain);
      }
    },
  });
  await files.read();
  if (!started.hasSettings) {
    await form.open(true);
  }
}

let bench: Bench | null = null;

/** The file of the address, else one that was named, else the first drawing, else whatever is first. */
function openFirst(files: FileList, named: readonly string[], open: (uri: string) => void): void {
  const asked = decodeURIComponent(location.hash.slice(1));
  const all = files.files.filter(({ language }) => language !== "toml");
  const first = all.find(({ uri }) => uri === asked) ?? all.find(({ uri }) => named.includes(uri)) ?? all.find(({ language }) => language === "dxf") ?? all[0];
  if (first !== undefined) {
    open(first.uri);
  }
}

function connection(sentence: string): void {
  const place = document.getElementById("connection");
  if (place !== null) {
    place.hidden = sentence === "";
    place.textContent = sentence;
  }
}

interface Parts {
  repairs: Repairs;
  programs: Programs;
  form: SettingsForm;
  there: () => Bench;
}

interface Bar {
  element: HTMLElement;
  turned: (doc: Doc) => void;
  fit: () => void;
  program: () => void;
}

function toolbar(started: Start, language: "en" | "zh", { repairs, programs, form, there }: Parts): Bar {
  const tried = (act: () => Promise<unknown>) => () => act().catch(complain);
  const name = make("strong", { id: "document" });
  const keep = button("", tried(async () => {
    const { doc } = there();
    await (doc === null ? undefined : programs.keep(doc));
  }), { id: "keep", class: "primary", hidden: true });
  const all = button(t("Fix all"), tried(() => repairs.all()), { id: "repair-all", title: t("Make every safe repair") });
  const fit = button(t("Fit of the pair"), tried(() => there().fit(!there().isFit)), { id: "fit-pair", "aria-pressed": "false", title: t("Whether punch and plate fit, as the wire leaves them") });
  const program = menu(t("Program"), t("Make the program of the drawing"), () => programs.items().map((item) => ({ ...item, act: tried(async () => { await item.act(); }) })));
  program.id = "programs";
  const exported = menu(t("Export"), t("Save the picture as SVG, PNG or PDF"), () => [
    ...(["svg", "png", "pdf"] as const).map((form) => ({ name: form, text: form.toUpperCase(), act: tried(() => programs.picture(form)) })),
    ...(["csv", "dxf"] as const).map((form) => ({ name: `holes-${form}`, text: `${t("Drill list")} (${form.toUpperCase()})`, act: tried(() => programs.holes(form)) })),
    ...((there().doc?.revision ?? null) === null ? [] : [{ name: "report", text: t("Report"), act: tried(() => programs.report()) }]),
  ]);
  exported.id = "exports";
  const where = menu(t("Repairs go to"), t("Where repairs are written"), () => [
    { name: "beside", text: t("NAME-fixed beside it"), act: () => { setInPlace(false); }, isChecked: !isInPlace() },
    { name: "in-place", text: t("the file itself"), act: () => { setInPlace(true); }, isChecked: isInPlace() },
  ]);
  where.id = "where-repairs";
  const settings = button(t("Settings"), tried(() => form.open()), { id: "settings" });
  const said = make("span", { id: "said" });
  const element = make("div", { id: "bar", role: "banner" },
    make("span", { id: "brand", text: "wedm", title: started.version }), name, keep, said, all, where, program, fit, settings, exported,
    button("◐", switchTheme, { id: "theme", title: t("Light or dark"), "aria-label": t("Light or dark") }),
    button(language === "zh" ? "English" : "中文", () => { switchLanguage(language); }, { id: "language" }),
    button("?", () => { document.dispatchEvent(new KeyboardEvent("keydown", { key: "?" })); }, { id: "help", title: t("Keys"), "aria-label": t("Keys") }));
  return {
    element,
    turned: (doc) => {
      const isDxf = isDrawing(doc) && !doc.source.isBinary;
      document.title = `${doc.name} – wedm`;
      name.textContent = doc.name;
      keep.hidden = doc.revision !== null;
      keep.textContent = doc.saveAs === null ? t("Download") : t("Save {0}", doc.name);
      program.hidden = fit.hidden = !isDxf;
      fit.setAttribute("aria-pressed", String(there().isFit));
      said.textContent = said.title = there().settings?.said ?? "";
    },
    fit: () => { fit.click(); },
    program: () => { program.querySelector("button")?.click(); },
  };
}

/** A file that is dropped is opened in memory. */
function dropped(opened: Bench): void {
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
  });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    for (const file of event.dataTransfer?.files ?? []) {
      file.arrayBuffer().then((bytes) => opened.openMemory(file.name, new Uint8Array(bytes), null)).catch(complain);
    }
  });
}

function keysOf({ files, right, repairs, form, bar, there }: { files: FileList; right: Right; bar: Bar } & Omit<Parts, "programs">): Key[] {
  const tab = (index: number, name: string): Key => ({
    key: String(index + 1),
    does: name,
    act: () => {
      showPane("right");
      right.turnTo(index);
    },
  });
  const keys: Key[] = [
    { key: "/", does: t("Search files"), act: () => { showPane("left"); files.search(); } },
    { key: "n", does: t("The next finding"), act: () => { right.step(1); } },
    { key: "p", does: t("The finding before"), act: () => { right.step(-1); } },
    { key: "f", does: t("Make the first repair of the finding that is shown"), act: () => { document.querySelector<HTMLElement>("#card .primary")?.click(); } },
    { key: "F", does: t("Make every safe repair"), act: () => repairs.all().catch(complain) },
    { key: "g", does: t("Make the program of the drawing"), act: () => { bar.program(); } },
    { key: "s", does: t("Settings"), act: () => form.open().catch(complain) },
    { key: "v", does: t("Fit of the pair"), act: () => { bar.fit(); } },
    tab(0, t("Findings")), tab(1, t("Radii, or the program")), tab(2, t("Contours")),
    { key: "+", does: t("Zoom in"), act: () => { there().picture.zoom(1.5); } },
    { key: "-", does: t("Zoom out"), act: () => { there().picture.zoom(1 / 1.5); } },
    { key: "0", does: t("Show all"), act: () => { there().picture.fit(); } },
    { key: "t", does: t("Light or dark"), act: () => { switchTheme(); } },
  ];
  return [...keys, { key: "?", does: t("Keys"), act: () => help(keys) }];
}

begin().catch((error: unknown) => {
  document.body.append(make("div", { id: "notices" }));
  say(error instanceof Error ? error.message : String(error), "error");
});
