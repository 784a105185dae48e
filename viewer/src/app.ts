// Puts the page together: model, state, view, timeline and panels, each told of what changes.

import { mostTelling } from "./contacts/telling.js";
import type { ViewDocument } from "./data/document.js";
import { Feed } from "./live/feed.js";
import { LiveCard } from "./live/live_card.js";
import { Model } from "./model.js";
import { Posture } from "./motion/clip.js";
import { Caption } from "./panels/caption.js";
import { checklistCard, checksOf } from "./panels/checklist.js";
import { ContactTable } from "./panels/contact_table.js";
import { Details } from "./panels/details.js";
import { byId, element } from "./panels/dom.js";
import { showHeadline } from "./panels/headline.js";
import { Help } from "./panels/help.js";
import { Histogram } from "./panels/histogram.js";
import { notesCard, settingsCard, summaryCard } from "./panels/tables.js";
import { Transport } from "./panels/transport.js";
import type { Page } from "./api.js";
import { listenForKeys } from "./keys.js";
import { Player } from "./player.js";
import { boundsOfPosture } from "./scene3d/bounds.js";
import { View3D } from "./scene3d/view.js";
import { Store } from "./state.js";
import { keepTheme, preferredTheme } from "./theme.js";
import { Timeline } from "./timeline/timeline.js";

export function showDocument(document: ViewDocument): Page {
  const model = new Model(document);
  const store = initialStore(model);
  keepTheme(store, byId("theme"));
  showHeadline(model);
  const view = makeView(model, store);
  addControls(model, store);
  addPanels(model, store);
  const player = new Player(model, store);
  if (model.isLive) startFeed(model, store, player);
  connectView(view, model, store);
  return { model, store, view };
}

function initialStore(model: Model): Store {
  const telling = mostTelling(model.contacts, model.clips);
  const contact = model.contacts[telling] ?? null;
  const hasLss = model.avatars.some((avatar) => avatar.lss.length > 0);
  return new Store({
    time: contact?.at ?? model.start,
    isPlaying: false,
    speed: 1,
    contact,
    link: null,
    showsDiscrete: false,
    showsGhosts: contact !== null,
    showsSwept: model.avatars.some((avatar) => avatar.swept.length > 0),
    cutsAway: true,
    tracks: true,
    shape: hasLss ? "lss" : "mesh",
    theme: preferredTheme(),
    follows: model.isLive,
  });
}

/** Without WebGL everything else still works. */
function makeView(model: Model, store: Store): View3D | null {
  try {
    return new View3D(byId("view"), model, store);
  } catch {
    const words = "This browser has no WebGL, so there is no 3D view. Timeline, table and figures work without it.";
    byId("view").append(element("p", { class: "no-webgl", text: words }));
    return null;
  }
}

function connectView(view: View3D | null, model: Model, store: Store): void {
  const help = new Help();
  byId("help").addEventListener("click", () => help.toggle());
  byId("frame").addEventListener("click", () => view?.frame(false));
  listenForKeys(model, store, { frame: () => view?.frame(false), help: () => help.toggle() });
  if (view === null) return;
  view.showLabels();
  view.frame(true);
  let isFramed = !model.isLive;
  store.subscribe((changes) => {
    view.update(changes);
    if (changes.has("contact")) view.keepInSight();
    if (!isFramed && model.clips.some((clip) => clip.hasPose)) {
      isFramed = true;
      view.frame(true);
    }
  });
}

function addControls(model: Model, store: Store): void {
  const caption = new Caption(model, store);
  byId("caption").append(caption.node);
  byId("legend").append(caption.legend);
  const transport = new Transport(model, store);
  const timeline = new Timeline(model, store);
  const hasTime = model.isLive || model.end > model.start;
  if (hasTime) byId("controls").append(transport.node);
  if (hasTime && model.document.kind !== "inspection") byId("controls").append(timeline.node);
  store.subscribe((changes) => {
    transport.update(changes);
    timeline.update(changes);
    if (!model.isLive || changes.size > 1 || !changes.has("time")) caption.update();
  });
}

function addPanels(model: Model, store: Store): void {
  const panels = byId("panels"), view = model.document;
  const isInspection = view.kind === "inspection";
  if (isInspection) panels.append(inspectionCard(model));
  const details = isInspection ? null : new Details(model, store);
  if (details !== null) panels.append(details.node);
  for (const node of [notesCard(view), summaryCard(view)]) if (node !== null) panels.append(node);
  const histogram = makeHistogram(model, store);
  if (histogram !== null) panels.append(histogram.node);
  histogram?.draw();
  const table = isInspection ? null : new ContactTable(model, store);
  if (table !== null) panels.append(table.node);
  const settings = settingsCard(view);
  if (settings !== null) panels.append(settings);
  store.subscribe((changes) => {
    if (changes.has("theme")) histogram?.draw();
    if (changes.has("contact") || changes.has("link") || changes.has("contacts")) {
      details?.update();
      table?.update();
    }
  });
}

function makeHistogram(model: Model, store: Store): Histogram | null {
  const latencies = model.avatars.flatMap((avatar) => Array.from(avatar.track?.latencyUs ?? []));
  return latencies.some((value) => value > 0) ? new Histogram(latencies, store) : null;
}

function inspectionCard(model: Model): HTMLElement {
  const avatars = model.avatars.flatMap((avatar, i) => {
    const clip = model.clips[i];
    if (!clip.hasPose) return [];
    const posture = new Posture(clip);
    posture.moveTo(model.start);
    return [{ name: avatar.name, bounds: boundsOfPosture(avatar, posture.world) }];
  });
  return checklistCard(checksOf(avatars, model.document.scene.bounds));
}

function startFeed(model: Model, store: Store, player: Player): void {
  const card = new LiveCard();
  byId("panels").prepend(card.node);
  const feed = new Feed(model.document.events ?? "/events", model, store, () => {
    card.update(feed);
    player.wake();
  });
  card.update(feed);
  feed.start();
}
