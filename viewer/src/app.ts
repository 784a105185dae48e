// Puts the page together: model, state, view, timeline and panels, each told of what changes.

import { keepAddress } from "./address_bar.js";
import { openingOf } from "./contacts/opening.js";
import type { Check, ViewDocument } from "./data/document.js";
import { Feed } from "./live/feed.js";
import { LatencyPlot } from "./live/latency_plot.js";
import { LiveCard } from "./live/live_card.js";
import { TouchesNow } from "./live/touches_now.js";
import { Model } from "./model.js";
import { Posture } from "./motion/clip.js";
import { Caption } from "./panels/caption.js";
import { checklistCard, checksOf } from "./panels/checklist.js";
import { timeOf } from "./panels/choosing.js";
import { Details } from "./panels/details.js";
import { byId, element } from "./panels/dom.js";
import { FeetCard } from "./panels/feet_card.js";
import { showHeadline } from "./panels/headline.js";
import { Help } from "./panels/help.js";
import { Histogram } from "./panels/histogram.js";
import { Legend } from "./panels/legend.js";
import { PlaceCard } from "./panels/place_card.js";
import { addSharing } from "./panels/sharing.js";
import { notesCard, settingsCard, summaryCard } from "./panels/tables.js";
import { TouchTable } from "./panels/touch_table.js";
import { Transport } from "./panels/transport.js";
import type { Page } from "./api.js";
import { listenForKeys } from "./keys.js";
import { Player } from "./player.js";
import { boundsOfPosture } from "./scene3d/bounds.js";
import { View3D } from "./scene3d/view.js";
import type { Change, Shape } from "./state.js";
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
  addPanels(model, store, view);
  addSharing(model, store, view);
  keepAddress(model, store);
  const player = new Player(model, store);
  if (model.isLive) startFeed(model, store, player);
  connectView(view, model, store);
  return { model, store, view };
}

function initialStore(model: Model): Store {
  const { touch, contact } = openingOf(model), shown = touch ?? contact;
  return new Store({
    time: contact?.at ?? (touch === null ? model.start : timeOf(touch)),
    isPlaying: false,
    speed: 1,
    contact,
    touch,
    link: shown === null ? null : { avatar: shown.avatar, link: shown.link },
    showsDiscrete: false,
    showsGhosts: contact !== null || model.isSolid,
    showsSwept: model.avatars.some((avatar) => avatar.swept.length > 0),
    cutsAway: true,
    tracks: true,
    shape: openingShape(model),
    theme: preferredTheme(),
    follows: model.isLive,
    search: "",
    showsGround: true,
    ray: null,
    place: null,
    refusal: null,
  });
}

/** The surface that was asked: a document has meshes where contacts are those of meshes. */
function openingShape(model: Model): Shape {
  const hasMeshes = model.avatars.some((avatar) => avatar.meshes.length > 0);
  const hasLss = model.avatars.some((avatar) => avatar.lss.length > 0);
  return hasMeshes && (model.document.kind !== "inspection" || !hasLss) ? "mesh" : "lss";
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
  byId("everything").hidden = model.document.kind !== "inspection";
  byId("everything").addEventListener("click", () => view?.frame(false, "everything"));
  listenForKeys(model, store, { frame: (scope) => view?.frame(false, scope), help: () => help.toggle() });
  if (view === null) return;
  view.open();
  let isFramed = !model.isLive;
  store.subscribe((changes) => {
    view.update(changes);
    if (changes.has("contact") || changes.has("touch")) view.keepInSight();
    if (!isFramed && model.clips.some((clip) => clip.hasPose)) {
      isFramed = true;
      view.open();
    }
  });
}

/** False of inspections, and of worlds that were not replayed: no contact is not an answer then. */
function wasAsked({ document }: Model): boolean {
  return document.kind !== "inspection" && (document.kind !== "world" || document.touches !== null);
}

function addControls(model: Model, store: Store): void {
  const caption = new Caption(model, store);
  const legend = new Legend(model, store);
  byId("caption").append(caption.node);
  byId("legend").append(legend.node);
  const transport = new Transport(model, store);
  const timeline = new Timeline(model, store);
  const hasTime = model.isLive || model.end > model.start;
  if (hasTime) byId("controls").append(transport.node);
  if (hasTime && wasAsked(model)) byId("controls").append(timeline.node);
  store.subscribe((changes) => {
    transport.update(changes);
    timeline.update(changes);
    if (model.isLive && changes.size === 1 && changes.has("time")) return;
    caption.update();
    legend.update();
  });
}

function addPanels(model: Model, store: Store, view3d: View3D | null): void {
  const panels = byId("panels"), view = model.document;
  const isInspection = view.kind === "inspection";
  if (isInspection) addInspection(model, store, view3d, panels);
  const details = wasAsked(model) ? new Details(model, store) : null;
  if (details !== null) panels.append(details.node);
  const feet = FeetCard.of(model, store);
  if (feet !== null) panels.append(feet.node);
  for (const node of [summaryCard(view), notesCard(view)]) if (node !== null) panels.append(node);
  const histogram = makeHistogram(model, store);
  if (histogram !== null) panels.append(histogram.node);
  histogram?.draw();
  const table = wasAsked(model) ? new TouchTable(model, store) : null;
  if (table !== null) panels.append(table.node);
  const settings = settingsCard(view);
  if (settings !== null) panels.append(settings);
  store.subscribe((changes) => {
    if (changes.has("theme")) histogram?.draw();
    const matters: Change[] = ["contact", "touch", "link", "contacts"];
    if (matters.some((change) => changes.has(change))) details?.update();
    if (changes.has("touch")) feet?.update();
    if (changes.has("search") || changes.has("showsGround") || matters.some((change) => changes.has(change))) table?.update();
  });
}

function makeHistogram(model: Model, store: Store): Histogram | null {
  const latencies = model.avatars.flatMap((avatar) => Array.from(avatar.track?.latencyUs ?? []));
  return latencies.some((value) => value > 0) ? new Histogram(latencies, store) : null;
}

function addInspection(model: Model, store: Store, view: View3D | null, panels: HTMLElement): void {
  const { checks } = model.document;
  panels.append(checklistCard(checks.length > 0 ? checks : measuredChecks(model)));
  if (view === null || model.avatars.length === 0 || model.document.scene.indices.length === 0) return;
  const place = new PlaceCard(model, store, () => view.frame(false));
  panels.append(place.node);
  store.subscribe((changes) => {
    if (changes.has("place")) place.update();
  });
}

function measuredChecks(model: Model): Check[] {
  const avatars = model.avatars.flatMap((avatar, i) => {
    const clip = model.clips[i];
    if (!clip.hasPose) return [];
    const posture = new Posture(clip);
    posture.moveTo(model.start);
    return [{ name: avatar.name, bounds: boundsOfPosture(avatar, posture.world) }];
  });
  return checksOf(avatars, model.document.scene.bounds);
}

function startFeed(model: Model, store: Store, player: Player): void {
  const card = new LiveCard(), plot = new LatencyPlot(store), now = new TouchesNow(model, store, byId("view"));
  byId("panels").prepend(now.node, plot.node, card.node);
  const feed: Feed = new Feed(model.document.events ?? "/events", model, store, () => {
    card.update(feed);
    plot.add(feed.state.status);
    player.wake();
  }, (begun) => now.begun(begun));
  store.subscribe((changes) => {
    if (changes.has("contacts") || changes.has("avatars")) now.showBodies();
  });
  card.update(feed);
  feed.start();
}
