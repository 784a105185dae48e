// The keyboard.

import type { Model } from "./model.js";
import { walkContacts, walkTouches } from "./panels/choosing.js";
import { speeds, togglePlaying, toggleShape } from "./panels/transport.js";
import type { Store } from "./state.js";

interface Actions {
  frame(scope: "body" | "everything"): void;
  help(): void;
}

/** Arrow keys go this share of a step. */
const nudge = 1 / 50;
/** Where no step is known, seconds. */
const defaultStep = 0.1;

export function listenForKeys(model: Model, store: Store, actions: Actions): void {
  const flip = (name: "showsDiscrete" | "showsGhosts" | "showsSwept" | "cutsAway" | "tracks") => (): void =>
    store.set({ [name]: !store.state[name] });
  const keys: Record<string, (event: KeyboardEvent) => void> = {
    " ": () => togglePlaying(store, model),
    "[": () => walkTouches(store, model, -1),
    "]": () => walkTouches(store, model, 1),
    "{": () => walkContacts(store, model, -1),
    "}": () => walkContacts(store, model, 1),
    Home: () => seek(store, model.start),
    End: () => seek(store, model.end),
    ArrowLeft: (event) => move(model, store, -1, event.shiftKey),
    ArrowRight: (event) => move(model, store, 1, event.shiftKey),
    "-": () => changeSpeed(store, -1),
    "+": () => changeSpeed(store, 1),
    d: flip("showsDiscrete"),
    g: flip("showsGhosts"),
    s: flip("showsSwept"),
    c: flip("cutsAway"),
    t: flip("tracks"),
    l: () => toggleShape(store),
    f: (event) => actions.frame(event.shiftKey ? "everything" : "body"),
    "/": () => document.querySelector<HTMLInputElement>("input.search")?.focus(),
    Escape: () => store.set({ contact: null, touch: null, link: null, ray: null, place: null, refusal: null }),
    "?": () => actions.help(),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event)) return;
    const act = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (act === undefined) return;
    event.preventDefault();
    act(event);
  });
}

/** Keys that the focused control needs itself. */
function isTyping(event: KeyboardEvent): boolean {
  const { target } = event;
  if (target instanceof HTMLSelectElement) return true;
  if (target instanceof HTMLInputElement) return isText(target) || /^(Arrow|Home|End)/.test(event.key);
  const isPressable = target instanceof HTMLButtonElement || (target instanceof HTMLElement && target.tagName === "SUMMARY");
  if (document.querySelector("dialog[open]") !== null) return event.key !== "?";
  return isPressable && event.key === " ";
}

function move(model: Model, store: Store, direction: -1 | 1, toPose: boolean): void {
  const { time, contact } = store.state;
  const clip = model.clips[contact?.avatar ?? 0];
  if (clip === undefined) return;
  const span = clip.spanOf(clip.instantAt(time).step) ?? { t0: time - defaultStep, t1: time + defaultStep };
  const step = span.t1 - span.t0;
  const isAtStart = time - span.t0 < 1e-9;
  const pose = direction > 0 ? span.t1 : isAtStart ? clip.poseTimeAt(time - 0.5 * step) : span.t0;
  const next = toPose ? pose : time + direction * nudge * step;
  store.set({ time: Math.min(model.end, Math.max(model.start, next)), isPlaying: false, follows: false });
}

function isText({ type }: HTMLInputElement): boolean {
  return type === "search" || type === "text";
}

function seek(store: Store, time: number): void {
  store.set({ time, isPlaying: false, follows: false });
}

function changeSpeed(store: Store, by: number): void {
  const index = Math.min(speeds.length - 1, Math.max(0, speeds.indexOf(store.state.speed) + by));
  store.set({ speed: speeds[index] });
}
