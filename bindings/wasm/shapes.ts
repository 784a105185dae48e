// What is asked about: triangles at rest, avatars, their poses and clips.

import { ForetouchError, Held, handleOf, type Machine, type Point, pointAt, real, type Room, whole } from "./machine.js";
import * as structs from "./structs.js";

/** Every joint in its parent's frame, roots in W: w, x, y, z per joint, and x, y, z per joint. */
export interface Pose {
  readonly rotations: Float64Array;
  readonly translations: Float64Array;
}

/** The same, any numbers: `{ rotations: [1, 0, 0, 0], translations: [0, 1, 0] }` for one joint. */
export interface PoseLike {
  readonly rotations: ArrayLike<number>;
  readonly translations: ArrayLike<number>;
}

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

export interface SceneArrays {
  /** x, y, z per vertex. */
  readonly positions: ArrayLike<number>;
  /** Three per triangle; left out: three vertices per triangle, in order. */
  readonly indices?: ArrayLike<number>;
  /** The object of each triangle; left out: all are object 0. */
  readonly objects?: ArrayLike<number>;
  /** The objects' names; left out: "object 0" and so on. */
  readonly objectNames?: readonly string[];
}

/** Triangles that bend with several links at once. */
export interface SkinArrays {
  /** Three vertices each. */
  readonly triangles: ArrayLike<number>;
  /** For each triangle, the link whose hit it is. */
  readonly triangleLinks: ArrayLike<number>;
  /** How many links each vertex has. */
  readonly influences: number;
  readonly links: ArrayLike<number>;
  /** How much each counts; a vertex' add up to 1, to a billionth: floats want to be divided by their sum. Where it is 0, the link does not count. */
  readonly weights: ArrayLike<number>;
  /** x, y, z for each link of a vertex: where the vertex was in the link's frame when it was bound. */
  readonly points: ArrayLike<number>;
}

const mostTriangles = 50_000_000;

export class Scene extends Held {
  readonly triangles: number;
  /** By the number that contacts and events have as `object`. */
  readonly objectNames: readonly string[];

  constructor(machine: Machine, { positions, indices, objects, objectNames }: SceneArrays) {
    const vertices = Math.floor(positions.length / 3);
    const corners = indices?.length ?? vertices;
    const triangles = Math.floor(corners / 3);
    if (positions.length % 3 !== 0 || corners % 3 !== 0) throw new ForetouchError("expected three numbers per vertex, and three vertices per triangle");
    if (triangles === 0 || triangles > mostTriangles) throw new ForetouchError(`expected 1 to 50,000,000 triangles, found ${triangles}`);
    if (objects !== undefined && objects.length !== triangles) throw new ForetouchError(`expected the object of each of ${triangles} triangles, found ${objects.length}`);
    for (let corner = 0; indices !== undefined && corner < corners; ++corner) {
      const vertex = indices[corner];
      if (!(vertex >= 0 && vertex < vertices)) throw new ForetouchError(`triangle ${Math.floor(corner / 3)}: expected vertices 0 to ${vertices - 1}, found ${vertex}`);
    }
    let count = 1;
    const most = objectNames === undefined ? triangles : objectNames.length - 1;
    for (let triangle = 0; objects !== undefined && triangle < triangles; ++triangle) {
      const object = objects[triangle];
      if (!(object >= 0 && object <= most)) throw new ForetouchError(`triangle ${triangle}: expected an object from 0 to ${most}, found ${object}`);
      count = Math.max(count, object + 1);
    }
    const names = objectNames?.map(String) ?? Array.from({ length: count }, (_, object) => `object ${object}`);
    super(machine, "scene", machine.within((room) => {
      const arrays = room.written(structs.ft_scene_arrays, {
        positions: room.doubles(positions),
        vertexCount: vertices,
        indices: indices === undefined ? 0 : room.integers(indices),
        triangleCount: triangles,
        objects: objects === undefined ? 0 : room.integers(objects),
        objectNames: room.integers(names.map((name) => room.text(name).at)),
        objectCount: names.length,
      }, "scene");
      return room.answered("ft_scene_create", arrays);
    }));
    this.triangles = triangles;
    this.objectNames = names;
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

  static parsed(machine: Machine, file: string): Avatar {
    return new Avatar(machine, machine.within((room) => {
      const { at, length } = room.text(file);
      return room.answered("ft_avatar_create_from_text", at, length, room.text("avatar").at);
    }));
  }

  /** The avatar as a file. */
  file(): string {
    return this.machine.within((room) => this.machine.text(room.answered("ftw_avatar_file", this.handle)));
  }

  /** Questions meet bodies of this avatar by these triangles, as they are bent at the instant, if the bodies are added after this call. First contacts and events go on by LSS. */
  setSkin({ triangles, triangleLinks, influences, links, weights, points }: SkinArrays): void {
    const vertices = weights.length / whole(influences, "influences", 1);
    if (!Number.isInteger(vertices) || links.length !== weights.length || points.length !== 3 * weights.length) {
      throw new ForetouchError(`weights: expected ${influences} per vertex, a link for each and three numbers of points, found ${weights.length}, ${links.length} and ${points.length}`);
    }
    if (triangles.length !== 3 * triangleLinks.length) throw new ForetouchError(`triangles: expected three vertices each, and a link for each, found ${triangles.length} vertices and ${triangleLinks.length} links`);
    const used = Array.from(weights, (_, share) => share).filter((share) => weights[share] !== 0), firstShare = new Int32Array(vertices + 1);
    for (const share of used) ++firstShare[Math.floor(share / influences) + 1];
    for (let vertex = 0; vertex < vertices; ++vertex) firstShare[vertex + 1] += firstShare[vertex];
    const wholes = (room: Room, values: ArrayLike<number>, name: string): number => room.integers(Array.from(values, (value) => whole(value, name)));
    this.machine.within((room) => this.machine.ask("ft_avatar_set_skin", this.handle, room.written(structs.ft_skin, {
      vertexCount: vertices,
      firstShare: room.integers(firstShare),
      shareLinks: wholes(room, used.map((share) => links[share]), "links"),
      shareWeights: room.doubles(used.map((share) => real(weights[share], "weights"))),
      sharePoints: room.doubles(used.flatMap((share) => [0, 1, 2].map((axis) => real(points[3 * share + axis], "points")))),
      triangles: wholes(room, triangles, "triangles"),
      triangleLinks: wholes(room, triangleLinks, "triangleLinks"),
      triangleCount: triangleLinks.length,
    }, "skin")));
  }

  /** Every joint as the file has it. */
  restPose(): Pose {
    return {
      rotations: Float64Array.from(this.links.flatMap(({ rotation }) => rotation ?? [1, 0, 0, 0])),
      translations: Float64Array.from(this.links.flatMap(({ offset }) => offset)),
    };
  }
}

export function fitted(machine: Machine, triangles: ArrayLike<number>, most: number): Lss[] {
  if (triangles.length % 9 !== 0) throw new ForetouchError(`triangles: expected nine numbers each, found ${triangles.length} in all`);
  for (let i = 0; i < triangles.length; ++i) if (!Number.isFinite(triangles[i])) throw new ForetouchError(`triangles: expected finite numbers, found ${triangles[i]} in triangle ${Math.floor(i / 9)}`);
  return machine.within((room) => {
    const at = room.integers([0, 0]);
    machine.ask("ftw_fit", room.doubles(triangles), triangles.length / 9, whole(most, "most", 1, 64), at, at + 4);
    const memory = machine.view(), from = memory.getUint32(at, true), numbers = 7 * 8;
    return Array.from({ length: memory.getUint32(at + 4, true) }, (_, i) => ({
      a: pointAt(memory, from + i * numbers),
      b: pointAt(memory, from + i * numbers + 24),
      radius: memory.getFloat64(from + i * numbers + 48, true),
    }));
  });
}

/** Poses at constant spacing. */
export class Clip extends Held {
  readonly avatar: Avatar;
  readonly frames: number;
  readonly secondsPerFrame: number;

  constructor(machine: Machine, bvh: string, scale: number, given: Avatar | null) {
    const { avatar, handle } = machine.within((room) => {
      const { at, length } = room.text(bvh);
      const metres = real(scale, "scale");
      const avatar = given ?? new Avatar(machine, room.answered("ftw_avatar_of_clip", at, length, metres));
      return { avatar, handle: room.answered("ftw_clip", at, length, metres, handleOf(avatar, Avatar, machine, "avatar")) };
    });
    super(machine, "clip", handle);
    this.avatar = avatar;
    const info = machine.within((room) => {
      const at = room.zeroed(structs.ft_clip_info);
      machine.ask("ft_clip_get_info", this.handle, at);
      return room.read(structs.ft_clip_info, at);
    });
    this.frames = info.frameCount;
    this.secondsPerFrame = info.frameTimeS;
  }

  pose(frame: number): Pose {
    return poseFrom(this.machine, "ft_clip_pose", this.avatar.links.length, this.handle, whole(frame, "frame", 0));
  }
}

/** The pose that a call writes, whose last arguments are rotations, translations, capacity and how many there are. */
export function poseFrom(machine: Machine, name: string, joints: number, ...values: (number | bigint)[]): Pose {
  return machine.within((room) => {
    const rotations = room.take(8 * 4 * joints), translations = room.take(8 * 3 * joints);
    machine.ask(name, ...values, rotations, translations, joints, 0);
    return { rotations: machine.doubles(rotations, 4 * joints), translations: machine.doubles(translations, 3 * joints) };
  });
}

/** `name`: the argument's. */
export function writtenPose(room: Room, pose: PoseLike, joints: number, name: string): number {
  const { rotations, translations } = pose ?? {};
  if (rotations?.length !== 4 * joints || translations?.length !== 3 * joints) {
    throw new ForetouchError(`${name}: expected ${joints} joints, found ${(rotations?.length ?? 0) / 4} rotations and ${(translations?.length ?? 0) / 3} translations`);
  }
  return room.written(structs.ft_pose, { jointCount: joints, rotations: room.doubles(rotations), translations: room.doubles(translations) }, name);
}
