// The page's title and the one sentence that matters.

import { discreteCount } from "../contacts/discrete.js";
import type { Model } from "../model.js";
import { byId } from "./dom.js";
import { plural } from "./words.js";

export function showHeadline(model: Model): void {
  byId("title").textContent = model.document.title;
  document.title = `${model.document.title} · Foretouch`;
  byId("headline").textContent = headline(model);
}

function headline(model: Model): string {
  if (model.document.kind === "inspection") return "Is this the right unit, the right axis and the right place?";
  if (model.isLive) return "Live: what the service answers, as it answers it.";
  const contacts = model.contacts.filter((contact) => contact.verdict === "contact");
  if (model.contacts.length === 0) return "No contact in the whole clip.";
  const discrete = discreteCount(contacts);
  if (discrete === null || discrete.seen === discrete.all) return `${plural(contacts.length, "contact")}.`;
  const missed = discrete.all - discrete.seen;
  const touching = missed === 1 ? "touches" : "touch";
  return `${plural(contacts.length, "contact")}. ${missed} of them ${touching} nothing at either pose: a check at the poses alone misses them.`;
}
