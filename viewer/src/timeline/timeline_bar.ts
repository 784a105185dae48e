// What stands above the timeline: what its colours mean, what is looked for, and how it is zoomed.

import { isSlide } from "../contacts/feet.js";
import { countPerson } from "../contacts/person.js";
import { walkTouches } from "../panels/choosing.js";
import { element, button } from "../panels/dom.js";
import { meaningOf } from "../panels/glossary.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import type { Grouping } from "./rows.js";
import { groupings } from "./rows.js";
import { verdictOf } from "./bars.js";

const groupingNames: Record<Grouping, string> = { limb: "by limb", link: "by link", object: "by object", all: "all links" };
const beginnings = { contact: "contact", starts_in_contact: "touching already", undecided: "undecided" } as const;
const meanings = {
  contact: "Begins with a contact between two poses.",
  starts_in_contact: "It touched already when somebody first looked.",
  undecided: "The step's budget ended before it was known.",
} as const;

export interface Zooming {
  in(): void;
  out(): void;
  all(): void;
  group(grouping: Grouping): void;
}

export function timelineBar(model: Model, store: Store, zooming: Zooming, hint: HTMLElement): HTMLElement {
  const title = model.knowsTouches ? "Touches" : "Contacts";
  return element("div", { class: "timeline-bar" },
    element("h2", { text: title }), legendOf(model), searchOf(model, store), groupingOf(zooming), ...groundOf(model, store), hint,
    element("div", { class: "group" },
      button("−", "Show more time", () => zooming.out()),
      button("+", "Show less time", () => zooming.in()),
      button("Fit", "Show the whole clip", () => zooming.all()),
    ),
  );
}

function legendOf(model: Model): HTMLElement {
  const legend = element("span", { class: "verdicts" });
  for (const verdict of ["contact", "starts_in_contact", "undecided"] as const) {
    const count = model.touches.filter((touch) => !touch.isGround && verdictOf(touch) === verdict).length;
    if (count === 0 && !model.isLive) continue;
    legend.append(entry(verdict, model.isLive ? beginnings[verdict] : `${count} ${beginnings[verdict]}`, meanings[verdict]));
  }
  const { ground } = model.countTouches();
  if (ground > 0) legend.append(entry("ground", `${ground} ground`, "Touches that stand on the ground."));
  const slides = model.stances.filter(({ stance }) => stance !== null && isSlide(stance)).length;
  if (slides > 0) legend.append(entry("slide", `${slides} ${slides === 1 ? "slides" : "slide"}`, "Touches of feet that slide 2 mm or more; the notch in a bar says how deep the foot is."));
  if (model.person !== null) {
    const { certain, possible } = countPerson(model.person), counted = (count: number, word: string): string => (model.isLive ? word : `${count} ${word}`);
    legend.append(element("span", { text: "the person:" }), entry("person", counted(certain, "certain"), meaningOf("certain")), entry("perhaps", counted(possible, "possible"), meaningOf("possible")));
  }
  return legend;
}

function entry(swatch: string, text: string, title: string): HTMLElement {
  return element("span", { class: "entry" }, element("span", { class: `swatch ${swatch}` }), element("span", { text, title }));
}

function searchOf(model: Model, store: Store): HTMLElement {
  const search = element("input", { class: "search", label: "Search links and objects" });
  search.type = "search";
  search.placeholder = "search";
  search.title = "Links and objects whose names have these words (/); Enter goes to the next touch";
  search.addEventListener("input", () => store.set({ search: search.value }));
  search.addEventListener("keydown", (event) => {
    if (event.key === "Enter") walkTouches(store, model, event.shiftKey ? -1 : 1);
    if (event.key !== "Escape") return;
    // A browser would empty the field.
    event.preventDefault();
    event.stopPropagation();
    search.blur();
  });
  return search;
}

function groupingOf(zooming: Zooming): HTMLElement {
  const select = element("select", { label: "Rows of the timeline" });
  for (const grouping of groupings) {
    const option = element("option", { text: groupingNames[grouping] });
    option.value = grouping;
    select.append(option);
  }
  select.addEventListener("change", () => {
    const chosen = groupings.find((grouping) => grouping === select.value);
    if (chosen !== undefined) zooming.group(chosen);
  });
  return select;
}

function groundOf(model: Model, store: Store): HTMLElement[] {
  if (model.countTouches().ground === 0) return [];
  const node = button("Ground", "Show touches that are ground contact, too", () => store.set({ showsGround: !store.state.showsGround }));
  const show = (): void => node.setAttribute("aria-pressed", String(store.state.showsGround));
  store.subscribe((changes) => {
    if (changes.has("showsGround")) show();
  });
  show();
  return [node];
}
