// The page's title and the one sentence that matters.

import { discreteCount } from "../contacts/discrete.js";
import { worstBy, worstOf } from "../contacts/feet.js";
import { countPerson } from "../contacts/person.js";
import type { Model } from "../model.js";
import { byId } from "./dom.js";
import { count, length, millimetres, personOf, placeOf, plural, seconds, tally } from "./words.js";

export function showHeadline(model: Model): void {
  byId("title").textContent = model.document.title;
  document.title = `${model.document.title} · Foretouch`;
  byId("headline").textContent = `${headline(model)}${ofFeet(model)}${ofPerson(model)}`;
}

/** The foot that slides farthest, and the deepest. */
function ofFeet(model: Model): string {
  const slides = worstBy(model.stances, ({ slide }) => slide), deep = worstBy(model.stances, ({ depth }) => depth);
  const parts: string[] = [];
  if (slides?.stance != null) parts.push(`${slides.linkName} slides ${millimetres(slides.stance.slide)} (${framed(model, slides.begin)})`);
  if (deep?.stance != null) parts.push(`${deep.linkName} is ${millimetres(deep.stance.depth)} deep in (${framed(model, deep.stance.depthAt)})`);
  if (parts.length > 0) return ` ${parts.join(", and ")}.`;
  if (model.document.feet.length === 0) return "";
  const passing = worstOf(model.stances, ({ depth }) => depth);
  if (passing?.stance == null) return " No foot slides or sinks in.";
  const { depth, depthAt } = passing.stance;
  return ` No foot that stands slides or sinks in; ${passing.linkName} passes ${millimetres(depth)} deep (${framed(model, depthAt)}).`;
}

/** What is true of the person, not of the model. */
function ofPerson({ person, avatars, document }: Model): string {
  if (person === null || document.kind === "live") return "";
  const { certain, possible } = countPerson(person);
  return ` The ${avatars.length > 1 ? "persons" : "person"}: ${count(certain)} surely touched, ${count(possible)} perhaps.`;
}

function framed(model: Model, time: number): string {
  const frame = model.frameAt(time);
  return frame === null ? `at ${seconds(time - model.timeZero)}` : `frame ${frame}`;
}

function headline(model: Model): string {
  if (model.document.kind === "inspection") return "Is this the right unit, the right axis and the right place?";
  if (model.isLive) return "Live: what the service answers, as it answers it.";
  if (model.isSolid) return ofSolid(model);
  if (model.document.kind === "world") return ofWorld(model);
  if (model.touches.length === 0 && model.contacts.length === 0) return "No contact in the whole clip.";
  return model.knowsTouches ? ofTouches(model) : ofContacts(model);
}

/** Nothing is passed through; how far that keeps the body from where it was tracked. */
function ofSolid(model: Model): string {
  const { all, ground } = model.countTouches();
  const who = `The ${personOf(model.avatars[0]?.name ?? "")} passes through nothing of the ${placeOf(model.document.scene.name)}`;
  const most = model.avatars.reduce((far, { solid }) => Array.from(solid?.deviations ?? []).reduce((a, b) => Math.max(a, b), far), 0);
  const kept = all + ground === 0 ? "" : ` Surfaces hold it ${times(all + ground)}, at most ${length(most)} from where it was tracked.`;
  return `${who}.${kept}`;
}

/** Who moves among others touches them, and the scene. */
function ofWorld(model: Model): string {
  const { all, missed, ground } = model.countTouches(), bodies = plural(model.bodies.length, "body", "bodies");
  if (model.document.touches === null) return `${bodies} that move; who touches whom was not asked.`;
  if (all + ground === 0) return `${bodies}, and nobody touches anything.`;
  const met = model.touches.filter((touch) => touch.otherAvatar !== null && !touch.isUndecided).length;
  const scene = all + ground - met;
  const others = met === 0 ? "do not touch each other" : `touch each other ${times(met)}`;
  const rest = scene === 0 ? "" : `${met === 0 ? "; they touch" : ", and"} the ${placeOf(model.document.scene.name)} ${times(scene)}`;
  const unseen = missed === 0 ? "" : ` Looking where windows begin and end alone would miss ${count(missed)} of these.`;
  return `${bodies} ${others}${rest}.${unseen}`;
}

function ofTouches(model: Model): string {
  const { all, missed, ground } = model.countTouches();
  const who = model.avatars.length > 1 ? "The bodies touch" : `The ${personOf(model.avatars[0]?.name ?? "")} touches`;
  const place = placeOf(model.document.scene.name);
  if (all === 0) return `${who} ${ground === 0 ? "nothing of" : "nothing but the ground of"} the ${place}.`;
  const met = `${who} the ${place} ${times(all)}${ground === 0 ? "" : `, and the ground ${times(ground)} besides`}.`;
  if (missed === 0) return met;
  return `${met} Checking the poses alone would miss ${missed === all ? (all === 1 ? "it" : "all of them") : `${count(missed)} of ${ground === 0 ? "them" : `the ${count(all)}`}`}.`;
}

/** "137 times". */
function times(number: number): string {
  return number === 1 ? "once" : number === 2 ? "twice" : plural(number, "time");
}

/** Of a document that has but the contacts of single steps. */
function ofContacts(model: Model): string {
  const discrete = discreteCount(model.contacts);
  if (discrete === null || discrete.seen === discrete.all) return `${tally(model.contacts)}.`;
  return `${tally(model.contacts)}. Checking the poses alone would miss ${count(discrete.all - discrete.seen)} of the ${plural(discrete.all, "contact")}.`;
}
