// One avatar in the view: its body, its ghosts, and where its links are at the time shown.

import * as THREE from "three";
import type { Avatar, Bounds, Vector } from "../data/document.js";
import type { Clip, Instant } from "../motion/clip.js";
import { Posture } from "../motion/clip.js";
import type { Shape } from "../state.js";
import { AvatarBody, bodyGeometry, bodyStencil } from "./avatar_body.js";
import { boundsOfPosture } from "./bounds.js";
import type { GhostName } from "./ghosts.js";
import { Ghost } from "./ghosts.js";
import type { Palette } from "./palette.js";

export class Performer {
  readonly group = new THREE.Group();
  readonly posture: Posture;
  instant: Instant = { step: -1, u: 0 };
  private readonly geometries = new Map<Shape, THREE.BufferGeometry>();
  private readonly body: AvatarBody;
  private readonly ghosts: Record<GhostName, Ghost>;
  private readonly ghostPosture: Posture;

  constructor(
    readonly avatar: Avatar,
    readonly clip: Clip,
    shape: Shape,
    private readonly origin: Vector,
  ) {
    this.posture = new Posture(clip);
    this.ghostPosture = new Posture(clip);
    const geometry = this.geometryOf(shape), links = avatar.links.length;
    const material = new THREE.MeshLambertMaterial({
      vertexColors: true,
      stencilWrite: true,
      stencilRef: bodyStencil,
      stencilZPass: THREE.ReplaceStencilOp,
    });
    this.body = new AvatarBody(geometry, links, material);
    this.group.add(this.body.mesh);
    const ghost = (name: GhostName): Ghost => new Ghost(name, geometry, links, this.group);
    this.ghosts = { before: ghost("before"), asked: ghost("asked"), atContact: ghost("atContact") };
    this.group.visible = clip.hasPose;
  }

  setShape(shape: Shape): void {
    const geometry = this.geometryOf(shape);
    this.body.geometry = geometry;
    for (const ghost of Object.values(this.ghosts)) ghost.geometry = geometry;
  }

  moveTo(time: number): void {
    this.group.visible = this.clip.hasPose;
    if (!this.clip.hasPose) return;
    this.instant = this.posture.moveTo(time);
    this.body.place(this.posture.world, this.origin);
  }

  /** Shows the ghost at `u` of a step; hides it where `u` is null. */
  showGhost(name: GhostName, step: number, u: number | null): void {
    if (u === null || this.clip.spanOf(step) === null) {
      this.ghosts[name].hide();
      return;
    }
    this.ghostPosture.moveWithin(step, u);
    this.ghosts[name].show(this.ghostPosture.world, this.origin);
  }

  /** `touching` in the colour of contacts; where the pose is held, all paler. */
  paint(palette: Palette, touching: ReadonlySet<number>, chosen: number | null): void {
    const isHeld = this.instant.step < 0 && this.clip.start < this.clip.end;
    this.body.paint(
      this.avatar.links.map((_, link) => {
        if (touching.has(link)) return palette.touching;
        if (link === chosen) return palette.chosenLink;
        return isHeld ? palette.avatarHeld : palette.avatar;
      }),
    );
  }

  paintGhosts(palette: Palette): void {
    for (const ghost of Object.values(this.ghosts)) ghost.paint(palette);
  }

  /** Box of all links as they are now, in the world. */
  bounds(): Bounds {
    return boundsOfPosture(this.avatar, this.posture.world);
  }

  private geometryOf(shape: Shape): THREE.BufferGeometry {
    const known = this.geometries.get(shape);
    if (known !== undefined) return known;
    const geometry = bodyGeometry(this.avatar, shape);
    this.geometries.set(shape, geometry);
    return geometry;
  }
}
