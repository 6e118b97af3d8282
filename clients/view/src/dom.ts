// Elements of the page, made by code: the page's policy allows no style and no script in its markup.

type Attributes = Record<string, string | number | boolean | null>;

/** `class`, `text` and attributes; what is null or false is left out. */
export function make<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: (Node | string | null)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "text") {
      made.textContent = String(value);
    } else if (value !== null && value !== false) {
      made.setAttribute(key, value === true ? "" : String(value));
    }
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

export function button(text: string, act: () => unknown, attributes: Attributes = {}): HTMLButtonElement {
  const made = make("button", { type: "button", text, ...attributes });
  made.addEventListener("click", () => void act());
  return made;
}

/** The file's name in an address. */
export function nameOf(uri: string): string {
  return decodeURIComponent(uri.split("/").pop() ?? uri).replace(/^untitled:/, "");
}

/** The address of a file beside another one, as the server writes it: only letters, digits and `-._~` stay. */
export function beside(uri: string, name: string): string {
  const written = encodeURIComponent(name).replace(/[!'()*]/g, (letter) => `%${letter.charCodeAt(0).toString(16).toUpperCase()}`);
  return uri.slice(0, uri.lastIndexOf("/") + 1) + written;
}

/** The name without its ending. */
export function stemOf(name: string): string {
  return name.replace(/\.[^.]*$/, "");
}

/** Hands a file to the browser, which puts it where downloads go. */
export function download(name: string, content: BlobPart): void {
  const address = URL.createObjectURL(new Blob([content]));
  make("a", { href: address, download: name }).click();
  setTimeout(() => {
    URL.revokeObjectURL(address);
  }, 60_000);
}
