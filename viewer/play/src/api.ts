// `window.foretouch`: for tests, and for programs that embed the page.

import type { Pose } from "../../../bindings/wasm/foretouch.js";
import type { Play, Said } from "./play.js";
import type { PlayView } from "./play_view.js";
import type { Reached } from "./xr.js";

export interface PlayApi {
  /** The library is loaded and the room is shown, or state().error says why not. */
  readonly ready: Promise<void>;
  readonly said: () => Said;
  /** The pose that the pointer would have led to: the later one, in a step. */
  readonly lead: (pose: Pose) => Promise<void>;
  readonly pose: () => { from: Pose; tracked: Pose };
  readonly links: () => readonly string[];
  /** Pixel of the canvas where a point of W is; null behind the camera. */
  readonly screenOf: (point: readonly [number, number, number]) => [number, number] | null;
  readonly linkPlace: (link: number) => [number, number, number];
  readonly setMode: (mode: "reach" | "step") => Promise<void>;
  readonly seek: (time: number) => Promise<void>;
  readonly seekFrame: (frame: number) => Promise<void>;
  readonly take: (files: readonly File[]) => Promise<void>;
  readonly state: () => { readonly frames: number; readonly isAtRest: boolean; /** What could not be done last; null: nothing. */ readonly error: string | null };
  /** Of a session in VR. */
  readonly reached: () => Reached | null;
}

interface Parts {
  readonly ready: Promise<void>;
  readonly play: Play;
  readonly view: PlayView | null;
  readonly reach: () => Reached | null;
  readonly take: (files: readonly File[]) => Promise<void>;
  readonly refusal: () => string;
}

export function publish({ ready, play, view, reach, take, refusal }: Parts): void {
  const api: PlayApi = {
    ready,
    said: () => play.now,
    lead: (pose) => play.lead(pose),
    pose: () => ({ from: play.from, tracked: play.tracked }),
    links: () => play.body?.links.map(({ name }) => name) ?? [],
    screenOf: (point) => view?.screenOf(point) ?? null,
    linkPlace: (link) => view?.figure?.placeOf(link) ?? [0, 0, 0],
    setMode: (mode) => play.setMode(mode),
    seek: (time) => play.seek(time),
    seekFrame: (frame) => play.seekFrame(frame),
    take,
    state: () => ({ frames: view?.stage.frames ?? 0, isAtRest: (view?.stage.isAtRest ?? true) && play.isAtRest, error: refusal() === "" ? null : refusal() }),
    reached: reach,
  };
  (window as unknown as { foretouch: PlayApi }).foretouch = api;
}
