// Elements with text. Texts of a document are untrusted: they become text nodes and nothing else.

import { meaningOf } from "./glossary.js";

/** Until then a download has begun, and a person has read one word: milliseconds. */
const keepFileMs = 60000, saidMs = 1200;

interface Parts {
  readonly class?: string;
  readonly text?: string;
  readonly title?: string;
  readonly label?: string;
}

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  parts: Parts = {},
  ...children: Node[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  if (parts.class !== undefined) node.className = parts.class;
  if (parts.text !== undefined) node.textContent = parts.text;
  if (parts.title !== undefined) node.title = parts.title;
  if (parts.label !== undefined) node.setAttribute("aria-label", parts.label);
  node.append(...children);
  return node;
}

export function byId(id: string): HTMLElement {
  const node = document.getElementById(id);
  if (node === null) throw new Error(`the page has no #${id}`);
  return node;
}

export function button(text: string, label: string, act: () => void, kind = ""): HTMLButtonElement {
  const node = element("button", { text, label, title: label, class: kind });
  node.type = "button";
  node.addEventListener("click", act);
  return node;
}

/** A titled box beside the view. */
export function card(title: string, ...children: Node[]): HTMLElement {
  return element("section", { class: "card" }, element("h2", { text: title }), ...children);
}

/** Name, value and note, a line each. */
export function definitionTable(lines: readonly (readonly [string, string, string?])[]): HTMLTableElement {
  const table = element("table", { class: "pairs" });
  for (const [name, value, note] of lines) {
    const cell = element("td", { text: value });
    if (note !== undefined && note !== "") cell.append(element("small", { text: note }));
    const heading = element("th", {}, explained(name));
    heading.scope = "row";
    table.append(element("tr", {}, heading, cell));
  }
  return table;
}

/** A word, with its meaning where the page knows one. */
export function explained(word: string): HTMLElement {
  const meaning = meaningOf(word);
  return element("span", meaning === "" ? { text: word } : { class: "explained", text: word, title: meaning });
}

/** Hands a file to the person, as a download. */
export function offerFile(name: string, content: Blob): void {
  const link = element("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), keepFileMs);
}

/** Puts a text on the clipboard, and says so in place of the button's own text for a moment. */
export async function copyFrom(node: HTMLElement, text: string): Promise<void> {
  const before = node.textContent ?? "";
  try {
    await navigator.clipboard.writeText(text);
    node.textContent = "Copied";
  } catch {
    window.prompt("Copy this:", text);
  }
  window.setTimeout(() => (node.textContent = before), saidMs);
}

/** Touches the page only where the text is another one. */
export function setText(node: HTMLElement, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}
