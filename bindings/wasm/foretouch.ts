// Foretouch for JavaScript: what an articulated body touches between two poses, when and where, and
// a solid avatar that passes through nothing. Metres in a world W with y up; quaternions w, x, y, z;
// t is 0 at the earlier pose and 1 at the later. The promise: docs/guarantees.md. Everything here is
// for one thread at a time, and answers at once; a page with much to do asks from a worker.

/** Of every joint in its parent's frame, roots in W: w, x, y, z per joint, and x, y, z per joint. */
export interface Pose {
  readonly rotations: Float64Array;
  readonly translations: Float64Array;
}

export type Point = readonly [number, number, number];

/** A capsule in its link's frame. a = b: a sphere. */
export interface Lss {
  readonly a: Point;
  readonly b: Point;
  readonly radius: number;
}

/** As in an avatar file (docs/formats.md). */
export interface Link {
  readonly name: string;
  /** The name of an earlier link; null: a root, placed in W. */
  readonly parent: string | null;
  readonly offset: Point;
  readonly rotation?: readonly [number, number, number, number];
  readonly lss?: readonly Lss[];
}

export const verdicts = ["clear", "contact", "starts_in_contact", "undecided"] as const;
export type Verdict = (typeof verdicts)[number];

/** What one link meets first. Sound: toi and freeUntil never exceed the true time of contact. */
export interface Contact {
  readonly link: number;
  readonly verdict: Verdict;
  /** Why a link is undecided: the number that it has in foretouch.h. */
  readonly reason: number;
  /** Time of impact in [0, 1], rounded down; freeUntil if there is no contact. */
  readonly toi: number;
  readonly freeUntil: number;
  readonly separation: number;
  readonly penetration: number;
  /** Of the scene; -1: none. */
  readonly triangle: number;
  readonly object: number;
  /** Which of the link's LSS; -1: none. */
  readonly lss: number;
  readonly pointScene: Point;
  readonly pointLink: Point;
  /** Unit, from the scene to the link. */
  readonly normal: Point;
}

export const solidStates = ["placing", "equal", "following", "sliding", "held", "around", "snapped"] as const;
export type SolidState = (typeof solidStates)[number];
export const solidJointStates = ["free", "sliding", "held", "lost"] as const;
export type SolidJointState = (typeof solidJointStates)[number];
export const solidLimits = ["none", "budget", "catch-up", "inside"] as const;
export type SolidLimit = (typeof solidLimits)[number];

/** A place where a surface holds the shown pose from the tracked one. */
export interface SolidContact {
  readonly link: number;
  readonly lss: number;
  readonly triangle: number;
  readonly object: number;
  readonly point: Point;
  /** Unit, from the surface to the link. */
  readonly normal: Point;
  readonly gap: number;
  /** How hard the tracked pose presses, in metres: times a stiffness (N/m) it is a force. */
  readonly push: number;
  /** Along the surface, m/s. */
  readonly slipSpeed: number;
}

export interface SolidTick {
  readonly shown: Pose;
  readonly state: SolidState;
  readonly limit: SolidLimit;
  /** Proven: on the whole way from the pose shown before, the avatar touches nothing. */
  readonly isCertified: boolean;
  /** It appeared where its way begins: its first place, or one after it was inside. */
  readonly hasAppeared: boolean;
  /** The largest of all links. */
  readonly deviation: number;
  readonly lift: number;
  /** Lower bound on the separation on the whole way; infinite if it did not move. */
  readonly clearance: number;
  /** Pieces of the way (Solid.way). */
  readonly wayCount: number;
  readonly joints: readonly { readonly state: SolidJointState; readonly deviation: number }[];
  readonly contacts: readonly SolidContact[];
}

export interface SceneArrays {
  /** x, y, z per vertex. */
  readonly positions: ArrayLike<number>;
  /** Three per triangle; left out: three vertices per triangle, in order. */
  readonly indices?: ArrayLike<number>;
  /** The object of each triangle; left out: all are object 0. */
  readonly objects?: ArrayLike<number>;
}

export interface SweptSurface {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
}

/** What was given cannot be used; the message says where, and what was expected. */
export class ForetouchError extends Error {
  override readonly name = "ForetouchError";
}

const numbersPerContact = 18, numbersPerSolidContact = 13, numbersPerTick = 9;
const mostTriangles = 50_000_000;

type Call = (...values: number[]) => number;

interface Exports extends Record<string, unknown> {
  readonly memory: WebAssembly.Memory;
}

/** The module in memory, and how to talk with it. */
class Machine {
  constructor(private readonly exports: Exports) {}

  call(name: string, ...values: number[]): number {
    return (this.exports[name] as Call)(...values);
  }

  /** The same of calls that can fail. */
  ask(name: string, ...values: number[]): number {
    const answer = this.call(name, ...values);
    if (answer === 0) throw new ForetouchError(this.text(this.call("ftw_error")));
    return answer;
  }

  /** Room for so many numbers, and what is there already. Valid until the next call of anything. */
  numbers(count: number): Float64Array {
    const at = this.call("ftw_numbers", count);
    if (at === 0) throw new ForetouchError(this.text(this.call("ftw_error")));
    return new Float64Array(this.exports.memory.buffer, at, count);
  }

  /** The same of bytes. */
  bytes(count: number): Uint8Array {
    const at = this.call("ftw_bytes", count);
    if (at === 0 && count > 0) throw new ForetouchError(this.text(this.call("ftw_error")));
    return new Uint8Array(this.exports.memory.buffer, at, count);
  }

  say(text: string): number {
    const encoded = new TextEncoder().encode(text);
    this.bytes(encoded.length).set(encoded);
    return encoded.length;
  }

  text(at: number): string {
    const memory = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(memory.subarray(at, memory.indexOf(0, at)));
  }
}

/** The few things that the C library asks of its surroundings: none of them is there. */
function surroundings(): WebAssembly.Imports {
  const notThere = 52; // ENOSYS of WASI
  const absent = (): number => notThere;
  const stop = (): never => {
    throw new ForetouchError("expected the module to go on, but it stopped itself");
  };
  const known: Record<string, () => number> = { proc_exit: stop, emscripten_notify_memory_growth: () => 0 };
  const anything = new Proxy(known, { get: (target, name) => target[String(name)] ?? absent });
  return { wasi_snapshot_preview1: anything, env: anything } as unknown as WebAssembly.Imports;
}

/** The library, loaded once. */
export class Foretouch {
  private constructor(
    /** For the classes beside this one. */
    readonly machine: Machine,
    readonly version: string,
  ) {}

  /** `module`: the content of foretouch.wasm, or the answer of a fetch() of it. */
  static async load(module: BufferSource | WebAssembly.Module | Response | PromiseLike<Response>): Promise<Foretouch> {
    const given = await module;
    const source = typeof Response !== "undefined" && given instanceof Response ? await given.arrayBuffer() : (given as BufferSource | WebAssembly.Module);
    const compiled = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source);
    const instance = await WebAssembly.instantiate(compiled, surroundings());
    const machine = new Machine(instance.exports as Exports);
    if (typeof instance.exports["ftw_version"] !== "function") throw new ForetouchError("expected foretouch.wasm, found another module");
    (instance.exports["_initialize"] as (() => void) | undefined)?.();
    return new Foretouch(machine, machine.text(machine.call("ftw_version")));
  }

  /** Triangles at rest, two-sided. */
  scene(arrays: SceneArrays): Scene {
    return new Scene(this.machine, arrays);
  }

  /** From an avatar file, or its links. */
  avatar(file: string | readonly Link[]): Avatar {
    const text = typeof file === "string" ? file : JSON.stringify({ format: "foretouch-avatar", version: 1, links: file });
    return new Avatar(this.machine, this.machine.ask("ftw_avatar", this.machine.say(text)));
  }

  /** A BVH file, for an avatar, or with one made of it. `scale`: metres per unit of the file. */
  clip(bvh: string, { avatar, scale = 1 }: { avatar?: Avatar; scale?: number } = {}): Clip {
    return new Clip(this.machine, bvh, scale, avatar ?? null);
  }

  /** What does each link meet first? `tolerance` in metres. */
  query(scene: Scene, avatar: Avatar, { tolerance = 1e-3 }: { tolerance?: number } = {}): Query {
    return new Query(this.machine, scene, avatar, tolerance);
  }

  /** An avatar that passes through nothing. `liftsFeet`: a tracked body whose feet are below the floor is lifted whole. */
  solid(scene: Scene, avatar: Avatar, { skin = 2e-3, tolerance = skin / 4, liftsFeet = true }: { skin?: number; tolerance?: number; liftsFeet?: boolean } = {}): Solid {
    return new Solid(this.machine, scene, avatar, skin, tolerance, liftsFeet);
  }
}

/** Something that lives in the module until dispose(). Queries and solid avatars keep what they stand on alive themselves. */
abstract class Held {
  constructor(
    protected readonly machine: Machine,
    private readonly kind: string,
    private held: number,
  ) {}

  /** For the classes beside this one. */
  get handle(): number {
    if (this.held === 0) throw new ForetouchError("expected something that was not disposed of");
    return this.held;
  }

  dispose(): void {
    this.machine.call(`ftw_${this.kind}_destroy`, this.held);
    this.held = 0;
  }
}

export class Scene extends Held {
  readonly triangles: number;

  constructor(machine: Machine, { positions, indices, objects }: SceneArrays) {
    const vertices = Math.floor(positions.length / 3);
    const corners = indices?.length ?? vertices;
    const triangles = Math.floor(corners / 3);
    if (positions.length % 3 !== 0 || corners % 3 !== 0) throw new ForetouchError("expected three numbers per vertex, and three vertices per triangle");
    if (triangles === 0 || triangles > mostTriangles) throw new ForetouchError(`expected 1 to 50,000,000 triangles, found ${triangles}`);
    if (objects !== undefined && objects.length !== triangles) throw new ForetouchError(`expected the object of each of ${triangles} triangles, found ${objects.length}`);
    let count = 1;
    machine.numbers(positions.length).set(positions);
    const bytes = machine.bytes(16 * triangles);
    const integers = new Uint32Array(bytes.buffer, bytes.byteOffset, 4 * triangles);
    for (let corner = 0; corner < corners; ++corner) {
      const vertex = indices === undefined ? corner : indices[corner];
      if (!(vertex >= 0 && vertex < vertices)) throw new ForetouchError(`triangle ${Math.floor(corner / 3)}: expected vertices 0 to ${vertices - 1}, found ${vertex}`);
      integers[corner] = vertex;
    }
    for (let triangle = 0; triangle < triangles; ++triangle) {
      const object = objects?.[triangle] ?? 0;
      if (!(object >= 0 && object <= triangles)) throw new ForetouchError(`triangle ${triangle}: expected an object from 0 to ${triangles}, found ${object}`);
      integers[corners + triangle] = object;
      count = Math.max(count, object + 1);
    }
    super(machine, "scene", machine.ask("ftw_scene", vertices, triangles, count));
    this.triangles = triangles;
  }
}

export class Avatar extends Held {
  readonly links: readonly Link[];
  /** Per link: the index of its parent; -1: a root. */
  readonly parents: Int32Array;

  constructor(machine: Machine, handle: number) {
    super(machine, "avatar", handle);
    this.links = (JSON.parse(this.file()) as { links: Link[] }).links;
    const places = new Map(this.links.map(({ name }, index) => [name, index]));
    this.parents = Int32Array.from(this.links, ({ parent }) => (parent === null ? -1 : (places.get(parent) ?? -1)));
  }

  /** The avatar as a file. */
  file(): string {
    this.machine.ask("ftw_avatar_file", this.handle);
    return this.machine.text(this.machine.call("ftw_text"));
  }

  /** Every joint as the file has it. */
  restPose(): Pose {
    return {
      rotations: Float64Array.from(this.links.flatMap(({ rotation }) => rotation ?? [1, 0, 0, 0])),
      translations: Float64Array.from(this.links.flatMap(({ offset }) => offset)),
    };
  }
}

/** Poses at constant spacing. */
export class Clip extends Held {
  readonly avatar: Avatar;
  readonly frames: number;
  readonly secondsPerFrame: number;

  constructor(machine: Machine, bvh: string, scale: number, avatar: Avatar | null) {
    const handle = machine.ask("ftw_clip", machine.say(bvh), scale, avatar?.handle ?? 0);
    const [made, frames, seconds] = machine.numbers(3);
    super(machine, "clip", handle);
    this.frames = frames;
    this.secondsPerFrame = seconds;
    this.avatar = avatar ?? new Avatar(machine, made);
  }

  pose(frame: number): Pose {
    this.machine.ask("ftw_clip_pose", this.handle, frame);
    return poseIn(this.machine.numbers(7 * this.avatar.links.length), 0, this.avatar.links.length);
  }
}

export class Query extends Held {
  private readonly links: number;

  constructor(machine: Machine, scene: Scene, avatar: Avatar, tolerance: number) {
    super(machine, "query", machine.ask("ftw_query", scene.handle, avatar.handle, tolerance));
    this.links = avatar.links.length;
  }

  /**
   * Answers the motion from one pose to another: every joint turns at constant rate on the shorter
   * arc, translations are linear, links follow down the chain. One contact per link, in order.
   */
  step(from: Pose, to: Pose): Contact[] {
    const given = this.machine.numbers(14 * this.links);
    writePose(from, given, 0, this.links, "from");
    writePose(to, given, 7 * this.links, this.links, "to");
    this.machine.ask("ftw_query_step", this.handle);
    const n = this.machine.numbers(numbersPerContact * this.links);
    return Array.from({ length: this.links }, (_, link) => contactIn(n, numbersPerContact * link, link));
  }

  /** Of the last step: spans of t and planes that show that a link touches nothing, as `foretouch-verify` reads them; empty if none were found. */
  certificate(link: number): string {
    this.machine.ask("ftw_query_certificate", this.handle, link);
    return this.machine.text(this.machine.call("ftw_text"));
  }

  /** Of the last step: a closed surface around all that one LSS sweeps until `end`, at most `error` metres from it. */
  swept(link: number, lss: number, { end = 1, error = 2e-3 }: { end?: number; error?: number } = {}): SweptSurface {
    this.machine.ask("ftw_query_swept", this.handle, link, lss, end, error);
    const [vertices, triangles] = this.machine.numbers(2);
    const positions = Float32Array.from(this.machine.numbers(2 + 3 * vertices).subarray(2));
    const bytes = this.machine.bytes(12 * triangles);
    return { positions, indices: new Uint32Array(bytes.slice().buffer) };
  }
}

export class Solid extends Held {
  private readonly links: number;

  constructor(machine: Machine, scene: Scene, avatar: Avatar, skin: number, tolerance: number, liftsFeet: boolean) {
    super(machine, "solid", machine.ask("ftw_solid", scene.handle, avatar.handle, skin, tolerance, liftsFeet ? 1 : 0));
    this.links = avatar.links.length;
  }

  /**
   * One tick: the shown pose goes as near to the tracked one as surfaces let it. `seconds`: since the
   * last tick, above 0 and at most 10. `isTracked`: per joint false if its tracker lost it.
   */
  follow(tracked: Pose, seconds: number, isTracked?: ArrayLike<boolean>): SolidTick {
    const { links } = this;
    const given = this.machine.numbers(8 * links);
    writePose(tracked, given, 0, links, "tracked");
    for (let joint = 0; joint < links; ++joint) given[7 * links + joint] = isTracked?.[joint] === false ? 0 : 1;
    this.machine.ask("ftw_solid_follow", this.handle, seconds);
    const contacts = this.machine.numbers(numbersPerTick)[8];
    return tickIn(this.machine.numbers(numbersPerTick + 9 * links + numbersPerSolidContact * contacts), links, contacts);
  }

  /** Piece `index` of the last tick's way: when it is reached, in (0, 1] of the tick, and the pose that it ends with. */
  way(index: number): { readonly time: number; readonly pose: Pose } {
    this.machine.ask("ftw_solid_way", this.handle, index);
    const n = this.machine.numbers(1 + 7 * this.links);
    return { time: n[0], pose: poseIn(n, 1, this.links) };
  }

  /** Goes on in another scene. If it is inside something there, it stays until a tick finds a free place. */
  changeScene(scene: Scene): void {
    this.machine.ask("ftw_solid_change_scene", this.handle, scene.handle);
  }

  /** Forgets the shown pose: the user was teleported. */
  reset(): void {
    this.machine.call("ftw_solid_reset", this.handle);
  }
}

function writePose({ rotations, translations }: Pose, out: Float64Array, at: number, links: number, name: string): void {
  if (rotations.length !== 4 * links || translations.length !== 3 * links) {
    throw new ForetouchError(`${name}: expected ${links} joints, found ${rotations.length / 4} rotations and ${translations.length / 3} translations`);
  }
  out.set(rotations, at);
  out.set(translations, at + 4 * links);
}

function poseIn(n: Float64Array, at: number, links: number): Pose {
  return { rotations: n.slice(at, at + 4 * links), translations: n.slice(at + 4 * links, at + 7 * links) };
}

function pointIn(n: Float64Array, at: number): Point {
  return [n[at], n[at + 1], n[at + 2]];
}

function contactIn(n: Float64Array, at: number, link: number): Contact {
  return {
    link,
    verdict: verdicts[n[at]],
    reason: n[at + 1],
    toi: n[at + 2],
    freeUntil: n[at + 3],
    separation: n[at + 4],
    penetration: n[at + 5],
    triangle: n[at + 6],
    object: n[at + 7],
    lss: n[at + 8],
    pointScene: pointIn(n, at + 9),
    pointLink: pointIn(n, at + 12),
    normal: pointIn(n, at + 15),
  };
}

function tickIn(n: Float64Array, links: number, contacts: number): SolidTick {
  const joints = numbersPerTick + 7 * links, first = joints + 2 * links;
  return {
    state: solidStates[n[0]],
    limit: solidLimits[n[1]],
    isCertified: n[2] === 1,
    hasAppeared: n[3] === 1,
    deviation: n[4],
    lift: n[5],
    clearance: n[6],
    wayCount: n[7],
    shown: poseIn(n, numbersPerTick, links),
    joints: Array.from({ length: links }, (_, joint) => ({ state: solidJointStates[n[joints + 2 * joint]], deviation: n[joints + 2 * joint + 1] })),
    contacts: Array.from({ length: contacts }, (_, i) => solidContactIn(n, first + numbersPerSolidContact * i)),
  };
}

function solidContactIn(n: Float64Array, at: number): SolidContact {
  return {
    link: n[at],
    lss: n[at + 1],
    triangle: n[at + 2],
    object: n[at + 3],
    point: pointIn(n, at + 4),
    normal: pointIn(n, at + 7),
    gap: n[at + 10],
    push: n[at + 11],
    slipSpeed: n[at + 12],
  };
}
