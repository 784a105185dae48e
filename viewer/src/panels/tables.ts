// Summary, settings and notes, as the document has them.

import type { ViewDocument } from "../data/document.js";
import { card, definitionTable, element } from "./dom.js";
import { count } from "./words.js";

export function summaryCard(view: ViewDocument): HTMLElement | null {
  if (view.summary.length === 0) return null;
  return card("Summary", definitionTable(view.summary.map(({ name, value, note }) => [name, value, note])));
}

export function settingsCard(view: ViewDocument): HTMLElement | null {
  if (view.settings.length === 0) return null;
  const fold = element("details", { class: "card" });
  fold.open = true;
  const lines = view.settings.map(({ name, value }) => [name, value] as const);
  fold.append(element("summary", { text: "Settings" }), definitionTable(lines));
  if (view.tool !== "") fold.append(element("p", { class: "quiet", text: `Made by ${view.tool}.` }));
  return fold;
}

/** Never folded: what was left out decides what the picture means. */
export function notesCard(view: ViewDocument): HTMLElement | null {
  const notes = [...reductionNotes(view), ...view.notes];
  if (notes.length === 0) return null;
  const list = element("ul", {}, ...notes.map((text) => element("li", { text })));
  const node = card("Notes", list);
  node.classList.add("notes");
  return node;
}

function reductionNotes(view: ViewDocument): string[] {
  const { reduction, indices, trianglesInFile, name } = view.scene;
  if (reduction === "none" || view.notes.some((note) => note.includes(name))) return [];
  const shown = `${count(indices.length / 3)} of the ${count(trianglesInFile)} triangles of ${name}`;
  return [`The scene is ${reduction}: shown are ${shown}. Contacts were computed with all of them.`];
}
