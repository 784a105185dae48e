// What happens, in words: sentences and figures for people who do not see the picture.

import type { Contact, SolidState } from "../../../bindings/wasm/foretouch.js";
import { card, definitionTable, element } from "../../src/panels/dom.js";
import type { Play, Said } from "./play.js";

const states: Record<SolidState, string> = {
  placing: "It looks for a free place.",
  equal: "It is where you lead it: nothing is in the way.",
  following: "It is on its way to you, and touches nothing.",
  sliding: "A surface keeps it from you; it slides along.",
  held: "A surface keeps it from you; it stays where it is.",
  around: "It goes a proven way around what is between you and it.",
  snapped: "It appeared at this place.",
};

/** What a browser's clock tells apart, microseconds. */
const clockUs = 100;

const millimetres = (metres: number): string => `${(1e3 * metres).toFixed(Math.abs(metres) < 0.01 ? 2 : 1)} mm`;

export function headline(play: Play): string {
  const { body, scene, now } = play;
  if (body === null || scene === null) return "Loading ...";
  if (now.mode === "reach") return now.tick === null ? "Drag the body through the room." : states[now.tick.state];
  const first = [...now.contacts].sort((a, b) => a.toi - b.toi)[0];
  if (first === undefined) return "Between the two poses it touches nothing: proven, at every instant.";
  const what = `${body.links[first.link].name} meets ${scene.objectNames[first.object] ?? "the scene"}`;
  if (first.verdict === "starts_in_contact") return `${what} from the start.`;
  if (first.verdict === "undecided") return `${body.links[first.link].name} is free until t = ${first.freeUntil.toFixed(4)}; nothing is claimed after it.`;
  return `${what} at t = ${first.toi.toFixed(4)} of the step, free before it.`;
}

function contactLine(play: Play, { link, verdict, toi, separation, penetration, object }: Contact): [string, string, string] {
  const { body, scene } = play;
  const inside = penetration === null ? "how deep is not known" : `${millimetres(penetration)} deep`;
  const depth = verdict === "starts_in_contact" ? inside : `${millimetres(separation)} apart`;
  return [body?.links[link].name ?? "", verdict === "contact" ? `t = ${toi.toFixed(4)}` : verdict.replaceAll("_", " "), `${scene?.objectNames[object] ?? ""}, ${depth}`];
}

/** The panel's cards, made anew. */
export function cards(play: Play): HTMLElement[] {
  const { body, scene, now } = play;
  if (body === null || scene === null) return [];
  const shown = [now.mode === "reach" ? reachCard(play, now) : stepCard(play, now)];
  const about = definitionTable([
    ["body", body.name, `${body.links.length} links${body.frames > 0 ? `, ${body.frames} frames` : ""}`],
    ["scene", scene.name, `${scene.objects.length.toLocaleString("en")} triangles`],
    ["answer", now.microseconds < clockUs ? "under 0.1 ms" : `${(now.microseconds / 1e3).toFixed(1)} ms`, "of the library's time, in this browser"],
  ]);
  return [...shown, card("What is asked", about)];
}

function reachCard(play: Play, { tick }: Said): HTMLElement {
  if (tick === null) return card("Reach", element("p", { text: "The body is solid: take hold of it, and lead it into things." }));
  const { body, scene } = play;
  const lines: [string, string, string?][] = [
    ["state", tick.state, tick.isCertified ? "the whole way here is proven free" : "not proven"],
    ["from where you lead it", millimetres(tick.deviation)],
  ];
  for (const { link, object, push, gap } of tick.contacts.slice(0, 6)) {
    lines.push([body?.links[link].name ?? "", scene?.objectNames[object] ?? "itself", `pressed by ${millimetres(push)}, gap ${millimetres(gap)}`]);
  }
  return card("Reach", definitionTable(lines));
}

function stepCard(play: Play, { contacts, clearLinks, planes, seesProof }: Said): HTMLElement {
  const lines = [...contacts].sort((a, b) => a.toi - b.toi).slice(0, 8).map((one) => contactLine(play, one));
  const proof = !seesProof ? "" : planes.length > 0 ? ` The ${planes.length} planes part some of them from what is near, at this instant.` : " At this instant boxes are enough to part those looked at from what is near.";
  const clear = element("p", { text: `${clearLinks} links touch nothing: proven, at every instant between the poses.${proof}` });
  const parts = [...(lines.length > 0 ? [definitionTable(lines)] : []), ...(clearLinks > 0 ? [clear] : [])];
  return card("Step", ...parts);
}
