// The library, in a thread of its own: the page stays smooth whatever is asked.

import type { Avatar, Clip, Link, Point, Pose, Query, Scene, Solid } from "../../../bindings/wasm/foretouch.js";
import { Foretouch } from "../../../bindings/wasm/foretouch.js";
import { planesAt } from "./certificate.js";
import type { Answer, Ask, Body, Name, Question, Reply } from "./messages.js";

const tolerance = 1e-3, skin = 2e-3;
/** Of swept surfaces: coarse enough to be there at once, metres. */
const sweptError = 4e-3;

let library: Foretouch | null = null;
let scene: Scene | null = null;
let avatar: Avatar | null = null;
let clip: Clip | null = null;
let query: Query | null = null;
let solid: Solid | null = null;
let hands: { avatar: Avatar; solid: Solid | null }[] = [];
let liftsFeet = false;

function needed<T>(value: T | null, what: string): T {
  if (value === null) throw new Error(`There is no ${what} yet.`);
  return value;
}

function bodyOf(name: string, body: Avatar): Body {
  return {
    name,
    links: body.links,
    parents: body.parents,
    rest: body.restPose(),
    frames: clip?.frames ?? 0,
    secondsPerFrame: clip?.secondsPerFrame ?? 0,
  };
}

/** In the scene that there is now. */
function ask(): void {
  query?.dispose();
  solid?.dispose();
  query = solid = null;
  const around = scene;
  if (library === null || around === null) return;
  for (const hand of hands) {
    hand.solid?.dispose();
    hand.solid = library.solid(around, hand.avatar, { skin, liftsFeet: false });
  }
  if (avatar === null) return;
  query = library.query(around, avatar, { tolerance });
  solid = library.solid(around, avatar, { skin, liftsFeet });
}

function take(name: string, body: Avatar, ofClip: Clip | null, lifts: boolean): Body {
  if (avatar !== body) avatar?.dispose();
  if (clip !== ofClip) clip?.dispose();
  [avatar, clip, liftsFeet] = [body, ofClip, lifts];
  ask();
  return bodyOf(name, body);
}

function rootOf({ translations }: Pose): Point {
  return [translations[0], translations[1], translations[2]];
}

function timed<T>(call: () => T): { value: T; microseconds: number } {
  const begin = performance.now(), value = call();
  return { value, microseconds: 1e3 * (performance.now() - begin) };
}

const answers: { [N in Name]: (given: Ask<N>) => Answer<N> | Promise<Answer<N>> } = {
  load: async ({ module }) => {
    library = await Foretouch.load(module);
    return { version: library.version };
  },
  scene: (mesh) => {
    const { value, microseconds } = timed(() => needed(library, "library").scene(mesh));
    scene?.dispose();
    scene = value;
    ask();
    return { triangles: value.triangles, milliseconds: microseconds / 1e3 };
  },
  links: ({ name, links, liftsFeet: lifts }) => take(name, needed(library, "library").avatar(links), null, lifts),
  avatar: ({ name, text }) => take(name, needed(library, "library").avatar(text), null, true),
  clip: ({ name, text, scale }) => {
    const read = needed(library, "library").clip(text, { scale });
    return take(name, read.avatar, read, true);
  },
  frame: ({ frame }) => needed(clip, "clip").pose(frame),
  step: ({ from, to }) => {
    const { value, microseconds } = timed(() => needed(query, "scene and body").step(from, to));
    return { contacts: value, microseconds };
  },
  swept: ({ link, end }) => {
    const lss = needed(avatar, "body").links[link].lss ?? [];
    return end > 0 ? lss.map((_, index) => needed(query, "scene and body").swept(link, index, { end, error: sweptError })) : [];
  },
  proof: ({ links, time }) => links.flatMap((link) => planesAt(needed(query, "scene and body").certificate(link), link, time)),
  follow: ({ tracked, seconds, isTracked }) => {
    const { value, microseconds } = timed(() => needed(solid, "scene and body").follow(tracked, seconds, isTracked));
    return { tick: value, microseconds };
  },
  makeHands: ({ links }) => {
    hands = links.map((one: readonly Link[]) => ({ avatar: needed(library, "library").avatar(one), solid: null }));
    ask();
    return hands.map((hand, index) => bodyOf(index === 0 ? "left" : "right", hand.avatar));
  },
  hands: ({ hands: given, seconds }) => {
    const { value, microseconds } = timed(() =>
      given.map((one, index) => (one === null ? null : needed(hands[index].solid, "scene").follow(one.tracked, seconds, one.isTracked))));
    const ways = value.map((tick, index) => Array.from({ length: tick?.wayCount ?? 0 }, (_, piece) => rootOf(needed(hands[index].solid, "scene").way(piece).pose)));
    return { ticks: value, ways, microseconds };
  },
  reset: () => {
    solid?.reset();
    for (const hand of hands) hand.solid?.reset();
    return {};
  },
};

/** One question after another: none overtakes one that waits for the module. */
let last: Promise<unknown> = Promise.resolve();

async function answer({ id, name, ask: given }: Question): Promise<void> {
  let reply: Reply;
  try {
    reply = { id, answer: await (answers[name] as (given: unknown) => unknown)(given) };
  } catch (reason) {
    reply = { id, error: reason instanceof Error ? reason.message : String(reason) };
  }
  postMessage(reply);
}

addEventListener("message", ({ data }: MessageEvent<Question>) => {
  last = last.then(() => answer(data));
});
