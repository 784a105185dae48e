// A skeleton and what is skinned to it, as links with LSS that contain it.

import { ForetouchError } from "../machine.js";
import type { Link, Lss } from "../shapes.js";
import { type Frames, framesOf, localPose, type Matrix, poseRoom, RigidPart } from "./frames.js";
import type { Note } from "./geometry.js";

export interface HostBone {
  readonly name: string;
  /** Index of its parent among these, in any order; -1: none of them. */
  readonly parent: number;
  /** To the host's world, now. */
  readonly matrix: Matrix;
}

export interface HostSkin<O> {
  readonly object: O;
  readonly name: string;
  readonly positions: ArrayLike<number>;
  readonly indices: ArrayLike<number> | null;
  /** How many bones each vertex has, which, and how much each of them counts. */
  readonly influences: number;
  readonly joints: ArrayLike<number>;
  readonly weights: ArrayLike<number>;
  /** 16 per bone: from the vertices' space to that bone's, where the two were bound. */
  readonly toBones: ArrayLike<number>;
}

/** A skeleton as the library has it: parents before children. */
export interface Rig {
  readonly links: readonly Link[];
  readonly parents: Int32Array;
  /** By link: the host's bone. */
  readonly bones: readonly number[];
  readonly parts: readonly RigidPart[];
}

/** Bones with parents before children, unique names and one scale each. */
function linkedBones(bones: readonly HostBone[], mirror: 1 | -1): Omit<Rig, "links"> & { readonly names: string[] } {
  const order: number[] = [], place = new Map<number, number>([[-1, -1]]), names: string[] = [], taken = new Set<string>();
  while (order.length < bones.length) {
    const before = order.length;
    bones.forEach(({ parent }, bone) => {
      if (!place.has(bone) && place.has(parent)) place.set(bone, order.push(bone) - 1);
    });
    if (order.length === before) throw new ForetouchError("expected bones of which none is its own parent");
  }
  for (const bone of order) {
    let name = bones[bone].name;
    for (let i = 2; name === "" || taken.has(name); ++i) name = `${bones[bone].name || "bone"} ${i}`;
    taken.add(name);
    names.push(name);
  }
  const parts = order.map((bone, link) => {
    const part = new RigidPart(`Bone ${names[link]}`, bones[bone].matrix, mirror);
    if (part.scale === null) {
      const [a, b, c] = [0, 1, 2].map((column) => Math.hypot(...part.stretch.subarray(3 * column, 3 * column + 3)).toPrecision(3));
      throw new ForetouchError(`Bone ${names[link]}: its scale in the world is (${a}, ${b}, ${c}); expected the same along x, y and z, which capsules can follow: apply the scale in the modelling program`);
    }
    return part;
  });
  return { names, bones: order, parts, parents: Int32Array.from(order, (bone) => place.get(bones[bone].parent) ?? -1) };
}

/** For each of its triangles the bone that counts most; -1: no bone counts. */
function owners<O>({ influences, joints, weights }: HostSkin<O>, corners: ArrayLike<number>, bones: number): Int32Array {
  const owner = new Int32Array(corners.length / 3), sums = new Float64Array(bones);
  for (let triangle = 0; triangle < owner.length; ++triangle) {
    sums.fill(0);
    for (let corner = 0; corner < 3 * influences; ++corner) {
      const at = influences * corners[3 * triangle + Math.floor(corner / influences)] + (corner % influences);
      if (weights[at] > 0 && joints[at] < bones) sums[joints[at]] += weights[at];
    }
    owner[triangle] = sums.reduce((most, sum, bone) => (sum > (most < 0 ? 0 : sums[most]) ? bone : most), -1);
  }
  return owner;
}

/** For every link, the triangles that move with it, nine numbers each, in its frame. */
function trianglesOfLinks<O>(skins: Iterable<HostSkin<O>>, { bones, parts }: Omit<Rig, "links">, mirror: 1 | -1, note: Note<O>): number[][] {
  const all: number[][] = bones.map(() => []), linkOf = new Map(bones.map((bone, link) => [bone, link]));
  for (const skin of skins) {
    const vertices = Math.floor(skin.positions.length / 3);
    const corners = skin.indices ?? Uint32Array.from({ length: vertices - (vertices % 3) }, (_, i) => i);
    if (vertices === 0 || corners.length < 3) note(`${skin.name} has no ${vertices === 0 ? "vertices" : "triangles"}: it touches nothing`, skin.object);
    let loose = 0;
    owners(skin, corners, bones.length).forEach((bone, triangle) => {
      const link = linkOf.get(bone);
      if (link === undefined) return void ++loose;
      for (let corner = 0; corner < 3; ++corner) all[link].push(...inLink(skin, corners[3 * triangle + corner], bone, parts[link], mirror));
    });
    if (loose > 0) note(`${skin.name}: ${loose} triangles have no weight of any bone: left out`, skin.object);
  }
  return all;
}

/** A vertex in the bone's own space, then with the scale that the bone has in the world. */
function inLink<O>({ name, positions: p, toBones: m }: HostSkin<O>, vertex: number, bone: number, { stretch: s }: RigidPart, mirror: 1 | -1): number[] {
  const x = p[3 * vertex], y = p[3 * vertex + 1], z = p[3 * vertex + 2], at = 16 * bone;
  const [u, v, w] = [0, 1, 2].map((row) => (row === 2 ? mirror : 1) * (m[at + row] * x + m[at + 4 + row] * y + m[at + 8 + row] * z + m[at + 12 + row]));
  const point = [0, 1, 2].map((row) => s[row] * u + s[3 + row] * v + s[6 + row] * w);
  if (!point.every(Number.isFinite)) throw new ForetouchError(`${name}: its vertex ${vertex} is at no place: (${x}, ${y}, ${z})`);
  return point;
}

/** A rig without LSS. */
export function rigOf(bones: readonly HostBone[], mirror: 1 | -1): Rig {
  if (bones.length === 0) throw new ForetouchError("expected a skeleton with bones, found none");
  const { names, ...rig } = linkedBones(bones, mirror), frames = readRig(rig, bones.map(({ matrix }) => matrix), framesOf(bones.length));
  const rest = localPose(rig.parents, frames, poseRoom(bones.length));
  const links = names.map((name, link) => ({
    name,
    parent: rig.parents[link] < 0 ? null : names[rig.parents[link]],
    offset: Array.from(rest.translations.subarray(3 * link, 3 * link + 3)) as unknown as Link["offset"],
    rotation: Array.from(rest.rotations.subarray(4 * link, 4 * link + 4)) as unknown as NonNullable<Link["rotation"]>,
  }));
  return { ...rig, links };
}

/** `fit`: Foretouch.fit(), or an engine's. */
export async function fitted<O>(rig: Rig, skins: Iterable<HostSkin<O>>, mirror: 1 | -1, note: Note<O>, fit: (triangles: ArrayLike<number>) => Lss[] | Promise<Lss[]>): Promise<Rig> {
  const triangles = trianglesOfLinks(skins, rig, mirror, note);
  if (triangles.every((own) => own.length === 0)) throw new ForetouchError("expected a skinned mesh with triangles that bones move: there is nothing that could touch");
  const links = await Promise.all(rig.links.map(async (link, i) => ({ ...link, lss: await fit(triangles[i]) })));
  return { ...rig, links };
}

/** Matrices by the host's bones. Throws in the host's words where one no longer moves rigidly. */
export function readRig({ bones, parts }: Pick<Rig, "bones" | "parts">, matrices: readonly Matrix[], frames: Frames): Frames {
  for (let link = 0; link < bones.length; ++link) {
    if (!parts[link].read(matrices[bones[link]], frames, link)) throw new ForetouchError(`${parts[link].name}: its scale has changed; expected the one that it had when the body was made: make it anew`);
  }
  return frames;
}
