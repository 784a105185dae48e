// Summary, settings and notes, as the document has them.

import type { ViewDocument } from "../data/document.js";
import { card, definitionTable, element } from "./dom.js";
import { count } from "./words.js";

/** Rows that programs read by name, as people call them. */
const rowNames = new Map([
  ["touches_missed", "touches missed"],
  ["touches_ground", "touches of the ground"],
  ["touches_own", "touches of own links"],
]);

export function summaryCard(view: ViewDocument): HTMLElement | null {
  if (view.summary.length === 0) return null;
  return card("Summary", definitionTable(view.summary.map(({ name, value, note }) => [rowNames.get(name) ?? name, value, note])));
}

export function settingsCard(view: ViewDocument): HTMLElement | null {
  const quiet = notesOfPage(view);
  if (view.settings.length === 0 && quiet.length === 0) return null;
  const fold = element("details", { class: "card" });
  fold.open = true;
  const lines = view.settings.map(({ name, value }) => [name, value] as const);
  fold.append(element("summary", { text: "Settings" }), definitionTable(lines));
  if (view.tool !== "") fold.append(element("p", { class: "quiet", text: `Made by ${view.tool}.` }));
  fold.append(...quiet);
  return fold;
}

/** What the person should know of what was asked; what only the page leaves out is a quiet line under the settings. */
export function notesCard(view: ViewDocument): HTMLElement | null {
  const notes = view.notes.filter((note) => !isOfPage(note));
  if (notes.length === 0) return null;
  const node = card("Notes", listOf(notes));
  node.classList.add("notes");
  return node;
}

function listOf(notes: readonly string[]): HTMLElement {
  return element("ul", {}, ...notes.map((text) => element("li", { text })));
}

/** Limits of the page, which say nothing of the answers. */
const ofPage = [
  /^(The )?[Ss]wept surfaces /, /That is for the page alone/, /^The avatar's [\d,]+ triangles are shown simplified/,
];

function isOfPage(note: string): boolean {
  return ofPage.some((pattern) => pattern.test(note));
}

function notesOfPage(view: ViewDocument): HTMLElement[] {
  const notes = [...reductionNotes(view), ...view.notes.filter(isOfPage)];
  if (notes.length === 0) return [];
  return [element("div", { class: "of-page quiet" }, element("h3", { text: "What the page leaves out" }), listOf(notes))];
}

function reductionNotes(view: ViewDocument): string[] {
  const { reduction, indices, trianglesInFile, name } = view.scene;
  if (reduction === "none" || view.notes.some((note) => note.includes(name))) return [];
  const shown = `${count(indices.length / 3)} of the ${count(trianglesInFile)} triangles of ${name}`;
  return [`The scene is ${reduction}: shown are ${shown}. Contacts were computed with all of them.`];
}
