// Elements with text. Texts of a document are untrusted: they become text nodes and nothing else.

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
    const heading = element("th", { text: name });
    heading.scope = "row";
    table.append(element("tr", {}, heading, cell));
  }
  return table;
}

/** Touches the page only where the text is another one. */
export function setText(node: HTMLElement, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}
