// A page of a rule, out of Markdown: headings, paragraphs, lists, tables and code as they are written.

import { make } from "./dom";

export function readable(markdown: string): HTMLElement {
  const page = make("div", { class: "page" });
  let isCode = false;
  let block: string[] = [];
  const end = (): void => {
    const text = block.join(isCode ? "\n" : " ");
    const isTable = block[0]?.startsWith("|") === true;
    if (text !== "") {
      page.append(isCode || isTable ? make("pre", { text: block.join("\n") }) : paragraph(text));
    }
    block = [];
  };
  for (const line of markdown.split(/\r?\n/)) {
    if (line.startsWith("```")) {
      end();
      isCode = !isCode;
    } else if (!isCode && (line.trim() === "" || /^(#|[-*] |\d+\. )/.test(line))) {
      end();
      if (line.trim() !== "") {
        block.push(line);
      }
    } else {
      block.push(line);
    }
    if (!isCode && line.startsWith("#")) {
      end();
    }
  }
  end();
  return page;
}

function paragraph(text: string): HTMLElement {
  const plain = text.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/[`*]{1,2}/g, "");
  const level = /^#+/.exec(plain)?.[0].length;
  if (level !== undefined) {
    return make(level === 1 ? "h2" : "h3", { text: plain.replace(/^#+\s*/, "") });
  }
  return make("p", { text: text.startsWith("- ") || text.startsWith("* ") ? `• ${plain.replace(/^[-*]? */, "")}` : plain });
}
