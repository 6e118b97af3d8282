// The files of the folders: which there are, with their errors and warnings, searched and chosen.

import { t } from "../../picture/words";
import { type FileEntry, files } from "./api";
import { complain } from "./ask";
import { make } from "./dom";
import { List, type Row } from "./list";
import { fileRows } from "./rows";

/** Changes come in swarms; the list is read once for one. */
const SWARM = 60;

export class FileList {
  readonly element: HTMLElement;
  readonly #search: HTMLInputElement;
  readonly #note = make("p", { class: "note" });
  readonly #list: List;
  #files: readonly FileEntry[] = [];
  #memory: readonly { uri: string; name: string }[] = [];
  #timer = 0;

  constructor(
    chosen: (uri: string) => void,
    /** The files are read, and other than before. */
    private readonly known: (files: readonly FileEntry[]) => void,
  ) {
    this.#list = new List(t("Files"), ({ key }) => { chosen(key); }, t("No drawing and no program is here. Save one from your CAD program, or drop one."));
    this.#search = make("input", { type: "search", placeholder: t("Search files (/)"), "aria-label": t("Search files (/)") });
    this.#search.addEventListener("input", () => {
      this.#show();
    });
    this.#search.addEventListener("keydown", (event) => {
      if (event.key === "ArrowDown" || event.key === "Enter") {
        event.preventDefault();
        this.#list.element.focus();
        this.#list.step(1);
      }
    });
    this.element = make("nav", { id: "left", class: "pane", "aria-label": t("Files") }, this.#search, this.#list.element, this.#note);
  }

  get files(): readonly FileEntry[] {
    return this.#files;
  }

  search(): void {
    this.#search.focus();
    this.#search.select();
  }

  mark(uri: string): void {
    this.#list.mark(uri);
  }

  /** Documents that no file holds come first. */
  putMemory(memory: readonly { uri: string; name: string }[]): void {
    this.#memory = memory;
    this.#show();
  }

  async read(): Promise<void> {
    const { files: all, pending, left } = await files();
    this.#files = all;
    const counting = pending ? t("being checked…") : "";
    this.#note.textContent = left > 0 ? t("{0} more files are not listed.", left) : counting;
    this.#show();
    this.known(all);
  }

  soon(): void {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => void this.read().catch(complain), SWARM);
  }

  #show(): void {
    const memory = this.#memory.map(({ uri, name }): Row => ({ key: uri, text: name, kind: "file", badges: [{ text: t("not saved"), kind: "kind" }] }));
    this.#list.put([...memory, ...fileRows(this.#files, this.#search.value)]);
  }
}
