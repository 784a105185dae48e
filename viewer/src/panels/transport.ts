// Play, pause, speed, steps from contact to contact, the scrubber, and what is shown.

import { discreteCount } from "../contacts/discrete.js";
import type { Model } from "../model.js";
import type { Change, Store, ViewState } from "../state.js";
import { walkTouches } from "./choosing.js";
import { button, element } from "./dom.js";
import { seconds } from "./words.js";

export const speeds: readonly number[] = [1 / 8, 1 / 4, 1 / 2, 1, 2];
const speedNames = ["⅛×", "¼×", "½×", "1×", "2×"];
const scrubberSteps = 100000;

type Toggle = "showsDiscrete" | "showsGhosts" | "showsSwept" | "cutsAway" | "tracks";

export class Transport {
  readonly node = element("div", { class: "transport" });
  private readonly play: HTMLButtonElement;
  private readonly live: HTMLButtonElement;
  private readonly scrubber = element("input", { class: "scrubber", label: "Time" });
  private readonly clock = element("output", { class: "clock" });
  private readonly speed = element("select", { label: "Speed" });
  private readonly toggles = new Map<Toggle, HTMLButtonElement>();
  private shape: HTMLButtonElement | null = null;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.play = button("▶", "Play (space)", () => togglePlaying(store, model), "primary");
    this.live = button("Live", "Follow the stream", () => store.set({ follows: true, contact: null, touch: null, isPlaying: false }));
    this.live.hidden = !model.isLive;
    this.makeScrubber();
    this.makeSpeed();
    const word = model.knowsTouches ? "touch" : "contact";
    const previous = button("⟨", `Previous ${word} ([)`, () => walkTouches(store, model, -1));
    const next = button("⟩", `Next ${word} (])`, () => walkTouches(store, model, 1));
    previous.hidden = next.hidden = model.document.kind === "inspection";
    const moves = element("div", { class: "group" }, previous, this.play, next, this.live);
    this.node.append(moves, this.scrubber, this.clock, this.speed, this.makeToggles());
    this.update(new Set());
  }

  update(changes: ReadonlySet<Change>): void {
    const { state } = this.store;
    const { start, end, timeZero } = this.model;
    const frame = this.model.frameAt(state.time);
    this.clock.textContent = `${seconds(state.time - timeZero)}${frame === null ? "" : `, frame ${frame}`}`;
    const u = end > start ? (state.time - start) / (end - start) : 0;
    this.scrubber.value = String(Math.round(u * scrubberSteps));
    this.scrubber.setAttribute("aria-valuetext", seconds(state.time - timeZero));
    if (changes.size === 1 && changes.has("time")) return;
    this.play.textContent = state.isPlaying ? "❚❚" : "▶";
    this.play.setAttribute("aria-label", state.isPlaying ? "Pause (space)" : "Play (space)");
    this.live.setAttribute("aria-pressed", String(state.follows));
    this.speed.value = String(speeds.indexOf(state.speed));
    for (const [name, node] of this.toggles) node.setAttribute("aria-pressed", String(state[name]));
    this.shape?.setAttribute("aria-pressed", String(state.shape === "lss"));
  }

  private makeScrubber(): void {
    this.scrubber.type = "range";
    this.scrubber.min = "0";
    this.scrubber.max = String(scrubberSteps);
    this.scrubber.step = "1";
    this.scrubber.addEventListener("input", () => {
      const { start, end } = this.model;
      const time = start + (Number(this.scrubber.value) / scrubberSteps) * (end - start);
      this.store.set({ time, isPlaying: false, follows: false });
    });
  }

  private makeSpeed(): void {
    speeds.forEach((_, i) => {
      const option = element("option", { text: speedNames[i] });
      option.value = String(i);
      this.speed.append(option);
    });
    this.speed.addEventListener("change", () => this.store.set({ speed: speeds[Number(this.speed.value)] }));
  }

  private makeToggles(): HTMLElement {
    const group = element("div", { class: "group toggles" });
    const add = (name: Toggle, text: string, label: string): void => {
      const flip = (): void => this.store.set({ [name]: !this.store.state[name] } as Partial<ViewState>);
      const node = button(text, label, flip, "toggle");
      this.toggles.set(name, node);
      group.append(node);
    };
    const hasSwept = this.model.avatars.some((avatar) => avatar.swept.length > 0);
    if (discreteCount(this.model.contacts) !== null) add("showsDiscrete", "Check | truth", "What a check of the poses alone would have seen, beside what happened (D)");
    if (this.model.isSolid) add("showsGhosts", "Ghost", "Where the tracker says that the body is, translucent (G)");
    else if (this.model.contacts.length > 0) add("showsGhosts", "Ghosts", "The pose before the step and the pose asked for, translucent (G)");
    if (hasSwept) add("showsSwept", "Swept volume", "Certified surface of what the link sweeps in the step (S)");
    if (this.model.document.scene.indices.length > 0) add("cutsAway", "Cut away", "Leave out what hides the avatar (C)");
    if (this.model.avatars.length > 0 || this.model.isLive) add("tracks", "Track", "The camera goes along with the avatar while time runs (T)");
    if (this.model.avatars.some((avatar) => avatar.meshes.length > 0 && avatar.lss.length > 0)) {
      this.shape = button("Capsules", "The capsules (LSS) that cover the links, instead of their meshes (L)", () => toggleShape(this.store), "toggle");
      group.append(this.shape);
    }
    return group;
  }
}

export function toggleShape(store: Store): void {
  store.set({ shape: store.state.shape === "lss" ? "mesh" : "lss" });
}

/** At the end, playing begins anew. */
export function togglePlaying(store: Store, model: Model): void {
  const isAtEnd = store.state.time >= model.end - 1e-9;
  const isPlaying = !store.state.isPlaying;
  store.set({
    isPlaying,
    follows: false,
    ...(isPlaying && isAtEnd ? { time: model.start } : {}),
    ...(isPlaying ? { contact: null, touch: null } : {}),
  });
}
