// A body in the view: itself, and ghosts of it (where its tracker says that it is; where a step begins).

import * as THREE from "three";
import type { Pose } from "../../../bindings/wasm/foretouch.js";
import type { Avatar, Vector } from "../../src/data/document.js";
import { compose, transformSize } from "../../src/motion/chain.js";
import { AvatarBody, bodyGeometry, bodyStencil, LinkColours } from "../../src/scene3d/avatar_body.js";
import { Ghost } from "../../src/scene3d/ghosts.js";
import type { Palette } from "../../src/scene3d/palette.js";
import { pickLink } from "../../src/scene3d/picking.js";
import { linkMaterial } from "../../src/scene3d/shading.js";
import type { Body } from "./messages.js";

const atZero: Vector = [0, 0, 0];

/** What the viewer's drawing knows of a body. */
function drawnAvatar(body: Body): Avatar {
  return {
    id: 0,
    name: body.name,
    links: body.links.map(({ name }, link) => ({ name, parent: body.parents[link] })),
    lss: body.links.flatMap(({ lss }, link) => (lss ?? []).map((one) => ({ ...one, link }))),
    meshes: [],
    track: null,
    tracked: null,
    solid: null,
    isLiveSolid: false,
    contacts: [],
    swept: [],
    carried: [],
    outline: null,
  };
}

export class Figure {
  readonly group = new THREE.Group();
  readonly avatar: Avatar;
  readonly world: Float64Array;
  private readonly ghostWorld: Float64Array;
  private readonly solidBody: AvatarBody;
  private readonly colours: LinkColours;
  private readonly ghosts: Record<"before" | "tracked", Ghost>;

  constructor(readonly body: Body) {
    this.avatar = drawnAvatar(body);
    const links = body.links.length, geometry = bodyGeometry(this.avatar, "lss", false);
    this.world = new Float64Array(transformSize * links);
    this.ghostWorld = new Float64Array(transformSize * links);
    this.colours = new LinkColours(links);
    const material = linkMaterial("links", { stencilWrite: true, stencilRef: bodyStencil, stencilZPass: THREE.ReplaceStencilOp });
    material.uniforms["colours"].value = this.colours.texture;
    this.solidBody = new AvatarBody(geometry, links, material);
    this.group.add(this.solidBody.mesh);
    this.ghosts = { before: new Ghost("before", geometry, links, this.group), tracked: new Ghost("tracked", geometry, links, this.group) };
    this.place(body.rest);
  }

  get mesh(): THREE.SkinnedMesh {
    return this.solidBody.mesh;
  }

  place(pose: Pose): void {
    compose(this.body.parents, pose, this.world);
    this.solidBody.place(this.world, atZero);
  }

  /** The origin of a link, in W. */
  placeOf(link: number): [number, number, number] {
    const at = transformSize * link + 9;
    return [this.world[at], this.world[at + 1], this.world[at + 2]];
  }

  ghost(name: "before" | "tracked", pose: Pose | null): void {
    if (pose === null) return this.ghosts[name].hide();
    compose(this.body.parents, pose, this.ghostWorld);
    this.ghosts[name].show(this.ghostWorld, atZero);
  }

  paint(palette: Palette, touching: ReadonlySet<number>): void {
    this.colours.paint(this.body.links.map((_, link) => (touching.has(link) ? palette.touching : palette.avatar)));
    for (const ghost of Object.values(this.ghosts)) ghost.paint(palette);
  }

  /** Which link a ray meets, how far away. */
  pick(ray: THREE.Ray): { link: number; distance: number } | null {
    return pickLink(this.avatar, this.world, ray.origin.toArray(), ray.direction.toArray());
  }
}
