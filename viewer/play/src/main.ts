// Puts the page together, and says in one sentence why something cannot be had.

import "../../src/style.css";
import "./play.css";
import { byId, element } from "../../src/panels/dom.js";
import { applyTheme, preferredTheme } from "../../src/theme.js";
import { publish } from "./api.js";
import { dancerLinks, handLinks } from "./bodies.js";
import { Controls } from "./controls.js";
import { listenForDrags } from "./drag.js";
import { readDropped } from "./dropped.js";
import { Engine, Refused } from "./engine.js";
import { libraryModule } from "./module.js";
import { Play } from "./play.js";
import { PlayView } from "./play_view.js";
import { ownRoom, roomName } from "./room.js";
import { cards, headline } from "./words.js";
import { hasVr, Reach } from "./xr.js";

/** Where the bodies begin, in the page's own room, and how far away one looks from. Metres. */
const handPlace = [-0.25, 1.1, -0.35], handDistance = 1.5, dancerPlace = [-0.2, 0.98, 0.3], dancerDistance = 3.4;
/** In another scene: above its middle. */
const above = 0.3;
/** What a clip's unit may be, metres; and people's longest bone, a thigh or a shin. */
const scales = [1, 0.01, 0.0254, 0.001], longestBone = 0.43;

let theme = preferredTheme();
const engine = new Engine();
const view = makeView();
const play = new Play(engine, view, () => update());
const controls = new Controls(play, { hand: () => act(takeHand), dancer: () => act(takeDancer), again: () => act(() => begin()), files: (files) => act(() => take(files)) });
const reach = view === null ? null : new Reach(engine, view, () => view.frame(handDistance));
let begin: () => Promise<void> = takeHand;

/** Without WebGL the words still say what happens. */
function makeView(): PlayView | null {
  try {
    return new PlayView(byId("view"));
  } catch {
    byId("view").append(element("p", { class: "no-webgl", text: "This browser has no WebGL, so there is no 3D view. The answers in words work without it." }));
    return null;
  }
}

let isUpdating = false;
function update(): void {
  if (isUpdating) return;
  isUpdating = true;
  requestAnimationFrame(() => {
    isUpdating = false;
    byId("headline").textContent = headline(play);
    byId("panels").replaceChildren(...notes(), ...cards(play));
    controls.update();
  });
}

/** What could not be done; goes away with the next thing that is done. */
let refusal = "";
function notes(): HTMLElement[] {
  return refusal === "" ? [] : [element("p", { class: "play-refusal", text: refusal })];
}

function act(what: () => Promise<unknown>): void {
  void attempt(what);
}

async function attempt(what: () => Promise<unknown>): Promise<void> {
  refusal = "";
  try {
    await what();
  } catch (reason) {
    refusal = reason instanceof Refused ? reason.message : `This did not work: ${reason instanceof Error ? reason.message : String(reason)}.`;
  }
  update();
}

/** In a scene of the person's own, in the middle and above what is there. */
function placeFor(own: readonly number[]): readonly number[] {
  if (play.scene === null || play.scene.name === roomName || view === null) return own;
  const [x, y, z] = view.centre;
  return [x, y + above, z];
}

async function takeHand(): Promise<void> {
  begin = takeHand;
  const body = await engine.ask("links", { name: "hand", links: handLinks(), liftsFeet: false });
  await play.setBody(body, placeFor(handPlace));
  view?.frame(handDistance);
}

async function takeDancer(): Promise<void> {
  begin = takeDancer;
  const body = await engine.ask("links", { name: "dancer", links: dancerLinks(), liftsFeet: true });
  await play.setBody(body, placeFor(dancerPlace));
  view?.frame(dancerDistance);
}

async function take(files: FileList | readonly File[]): Promise<void> {
  for (const file of Array.from(files)) {
    const dropped = await readDropped(file);
    if (dropped.kind === "scene") {
      await play.setScene(dropped.scene);
      if (begin === takeHand || begin === takeDancer) await begin();
      continue;
    }
    begin = dropped.kind === "avatar" ? () => takeAvatar(file.name, dropped.text) : () => takeClip(file.name, dropped.text);
    await begin();
  }
}

async function takeAvatar(name: string, text: string): Promise<void> {
  await play.setBody(await engine.ask("avatar", { name, text }), null);
  view?.frame(dancerDistance);
}

/** BVH does not say its unit: the one in which the body is about as large as people are. */
async function takeClip(name: string, text: string): Promise<void> {
  const asWritten = await engine.ask("clip", { name, text, scale: 1 }), longest = longestIn(asWritten.rest.translations);
  const off = (scale: number): number => Math.abs(Math.log((scale * longest) / longestBone));
  const scale = scales.reduce((best, one) => (off(one) < off(best) ? one : best));
  await play.setBody(scale === 1 ? asWritten : await engine.ask("clip", { name, text, scale }), null);
  await play.setMode("step");
  view?.frame(dancerDistance);
}

/** Of all joints' offsets but the root's. */
function longestIn(translations: Float64Array): number {
  let longest = 0;
  for (let i = 3; i + 2 < translations.length; i += 3) longest = Math.max(longest, Math.hypot(...translations.subarray(i, i + 3)));
  return longest;
}

function listen(): void {
  const target = byId("drop");
  addEventListener("dragover", (event) => {
    event.preventDefault();
    target.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) target.hidden = true;
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    target.hidden = true;
    const files = event.dataTransfer?.files;
    if (files !== undefined) act(() => take(files));
  });
  byId("theme").addEventListener("click", () => paint(theme === "dark" ? "light" : "dark"));
  byId("enter").addEventListener("click", () => act(async () => reach?.begin()));
  if (view === null) return;
  listenForDrags(view, {
    moved: (by) => play.move(by),
    turned: (axis, radians) => play.turn(axis, radians),
  });
}

function paint(chosen: typeof theme): void {
  theme = chosen;
  applyTheme(theme);
  view?.paint(theme);
}

async function start(): Promise<void> {
  paint(theme);
  byId("controls").append(controls.node);
  listen();
  const module = await libraryModule();
  await engine.ask("load", { module }, [module]);
  await play.setScene(ownRoom());
  await takeHand();
  byId("enter").hidden = view === null || !(await hasVr());
}

const ready = attempt(start);
publish({ ready, play, view, reach: () => reach?.reached ?? null, take: (files) => attempt(() => take(files)), refusal: () => refusal });
