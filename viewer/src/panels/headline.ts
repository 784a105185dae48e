// The page's title and the one sentence that matters.

import { discreteCount } from "../contacts/discrete.js";
import type { Model } from "../model.js";
import { byId } from "./dom.js";
import { plural, tally } from "./words.js";

export function showHeadline(model: Model): void {
  byId("title").textContent = model.document.title;
  document.title = `${model.document.title} · Foretouch`;
  byId("headline").textContent = headline(model);
}

function headline(model: Model): string {
  if (model.document.kind === "inspection") return "Is this the right unit, the right axis and the right place?";
  if (model.isLive) return "Live: what the service answers, as it answers it.";
  if (model.contacts.length === 0) return "No contact in the whole clip.";
  const discrete = discreteCount(model.contacts);
  if (discrete === null || discrete.seen === discrete.all) return `${tally(model.contacts)}.`;
  const missed = discrete.all - discrete.seen;
  const touching = missed === 1 ? "touches" : "touch";
  return `${tally(model.contacts)}. ${plural(missed, "contact")} ${touching} nothing at either pose: a discrete check misses ${missed === 1 ? "it" : "them"}.`;
}
