// What the page asks of its worker, where the library is, and what comes back. One answer per
// question, in order.

import type { Contact, Link, Point, Pose, SolidTick, SweptSurface } from "../../../bindings/wasm/foretouch.js";

export interface Body {
  readonly name: string;
  readonly links: readonly Link[];
  /** Per link: index of its parent; -1: a root. */
  readonly parents: Int32Array;
  readonly rest: Pose;
  /** Of a clip; 0: there is none. */
  readonly frames: number;
  readonly secondsPerFrame: number;
}

export interface SceneMesh {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
  /** Per triangle. */
  readonly objects: Int32Array;
}

/** Why a link is clear: at the time asked, the LSS is on one side of each plane, and on the other what is near. */
export interface ProofPlane {
  readonly link: number;
  /** n·p <= offset is the scene's side; n is unit. */
  readonly normal: readonly [number, number, number];
  readonly offset: number;
}

export interface Questions {
  load: { ask: { module: ArrayBuffer }; answer: { version: string } };
  scene: { ask: SceneMesh; answer: { triangles: number; milliseconds: number } };
  links: { ask: { name: string; links: readonly Link[]; liftsFeet: boolean }; answer: Body };
  avatar: { ask: { name: string; text: string }; answer: Body };
  clip: { ask: { name: string; text: string; scale: number }; answer: Body };
  frame: { ask: { frame: number }; answer: Pose };
  step: { ask: { from: Pose; to: Pose }; answer: { contacts: Contact[]; microseconds: number } };
  swept: { ask: { link: number; end: number }; answer: SweptSurface[] };
  proof: { ask: { links: readonly number[]; time: number }; answer: ProofPlane[] };
  follow: { ask: { tracked: Pose; seconds: number; isTracked?: boolean[] }; answer: { tick: SolidTick; microseconds: number } };
  /** Two bodies at once: the hands of WebXR. */
  hands: { ask: { hands: ({ tracked: Pose; isTracked: boolean[] } | null)[]; seconds: number }; answer: { ticks: (SolidTick | null)[]; /** Where each wrist went, piece by piece in straight lines. */ ways: Point[][]; microseconds: number } };
  makeHands: { ask: { links: (readonly Link[])[] }; answer: Body[] };
  reset: { ask: Record<string, never>; answer: Record<string, never> };
}

export type Name = keyof Questions;
export type Ask<N extends Name> = Questions[N]["ask"];
export type Answer<N extends Name> = Questions[N]["answer"];

export interface Question<N extends Name = Name> {
  readonly id: number;
  readonly name: N;
  readonly ask: Ask<N>;
}

export type Reply = { readonly id: number; readonly answer: unknown } | { readonly id: number; readonly error: string };
