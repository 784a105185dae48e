// One avatar in the view: its body, its ghosts, and where its links are at the time shown.

import * as THREE from "three";
import type { Avatar, Bounds, Vector } from "../data/document.js";
import type { Clip, Instant } from "../motion/clip.js";
import { Posture } from "../motion/clip.js";
import type { Shape } from "../state.js";
import { AvatarBody, bodyGeometry, bodyStencil, grownGeometry, LinkColours } from "./avatar_body.js";
import { boundsOfPosture } from "./bounds.js";
import type { GhostName } from "./ghosts.js";
import { Ghost } from "./ghosts.js";
import { Outline } from "./outline.js";
import type { Palette } from "./palette.js";
import { linkMaterial } from "./shading.js";

/** Of world transforms: nearer than this nobody sees two bodies, metres and shares of an axis. */
const seen = 1e-3;

function isAlmostSame(a: Float64Array, b: Float64Array): boolean {
  return a.every((value, i) => Math.abs(value - b[i]) < seen);
}

export class Performer {
  readonly group = new THREE.Group();
  readonly posture: Posture;
  instant: Instant = { step: -1, u: 0 };
  private readonly geometries = new Map<string, THREE.BufferGeometry>();
  private readonly body: AvatarBody;
  private readonly colours: LinkColours;
  private readonly ghosts: Record<GhostName, Ghost>;
  /** Around a link: where the person's may be. */
  private readonly veil: Ghost;
  private readonly ghostPosture: Posture;
  private readonly trackedPosture: Posture | null;
  /** Of a trigger, which has no body. */
  private readonly outline: Outline | null;
  private shown: THREE.BufferGeometry;
  private isCoarse = false;

  constructor(
    readonly avatar: Avatar,
    readonly clip: Clip,
    private shape: Shape,
    private readonly origin: Vector,
    /** Of a solid avatar: where its tracker says that it is; `clip` is what is shown. */
    private readonly tracked: Clip | null = null,
  ) {
    this.posture = new Posture(clip);
    this.ghostPosture = new Posture(clip);
    this.trackedPosture = tracked === null ? null : new Posture(tracked);
    this.shown = this.geometryNow();
    const links = avatar.links.length;
    this.colours = new LinkColours(links);
    const isThing = avatar.lss.length === 0;
    const material = linkMaterial("links", { stencilWrite: true, stencilRef: bodyStencil, stencilZPass: THREE.ReplaceStencilOp }, isThing);
    material.uniforms["colours"].value = this.colours.texture;
    this.body = new AvatarBody(this.shown, links, material);
    this.group.add(this.body.mesh);
    this.outline = avatar.outline === null ? null : new Outline(avatar.outline, this.group);
    const ghost = (name: GhostName): Ghost => new Ghost(name, this.shown, links, this.group);
    this.ghosts = { before: ghost("before"), asked: ghost("asked"), atContact: ghost("atContact"), tracked: ghost("tracked") };
    this.veil = new Ghost("veil", grownGeometry(avatar, -1, 0), links, this.group);
    this.group.visible = clip.hasPose;
  }

  get mesh(): THREE.SkinnedMesh {
    return this.body.mesh;
  }

  setShape(shape: Shape): void {
    this.shape = shape;
    this.refresh();
  }

  /** In fewer triangles, for pictures that move. */
  setCoarse(isCoarse: boolean): void {
    this.isCoarse = isCoarse;
    this.refresh();
  }

  private refresh(): void {
    const geometry = this.geometryNow();
    if (geometry === this.shown) return;
    this.shown = geometry;
    this.body.mesh.geometry = geometry;
    for (const ghost of Object.values(this.ghosts)) ghost.geometry = geometry;
  }

  moveTo(time: number): void {
    this.group.visible = this.clip.hasPose;
    if (!this.clip.hasPose) return;
    this.instant = this.posture.moveTo(time);
    this.body.place(this.posture.world, this.origin);
    this.outline?.place(this.posture.world, this.origin);
  }

  get isSolid(): boolean {
    return this.tracked !== null;
  }

  /** Shows where the tracker says that the body is; hides it where that is what is shown. */
  showTracked(time: number): void {
    const { tracked, trackedPosture } = this;
    if (tracked === null || trackedPosture === null || !tracked.hasPose) return;
    trackedPosture.moveTo(time);
    if (isAlmostSame(trackedPosture.world, this.posture.world)) this.ghosts.tracked.hide();
    else this.ghosts.tracked.show(trackedPosture.world, this.origin);
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

  /** Shows a ghost with these world transforms. */
  showGhostAt(name: GhostName, world: Float64Array): void {
    this.ghosts[name].show(world, this.origin);
  }

  /** Shows a link as thick as it is with the person in it, where they are up to `growth` metres from it; hides it where that is null. */
  showVeil(link: number, growth: number | null): void {
    if (growth === null) return this.veil.hide();
    this.veil.geometry = this.kept(`${link} ${growth}`, () => grownGeometry(this.avatar, link, growth));
    this.veil.show(this.posture.world, this.origin);
  }

  hideGhosts(): void {
    for (const ghost of Object.values(this.ghosts)) ghost.hide();
    this.veil.hide();
  }

  /** `touching` in the colour of contacts; where the pose is held, all paler. */
  paint(palette: Palette, touching: ReadonlySet<number>, chosen: number | null): void {
    const isHeld = this.instant.step < 0 && this.clip.start < this.clip.end;
    this.colours.paint(
      this.avatar.links.map((_, link) => {
        if (touching.has(link)) return palette.touching;
        if (link === chosen) return palette.chosenLink;
        return isHeld ? palette.avatarHeld : palette.avatar;
      }),
    );
  }

  paintGhosts(palette: Palette): void {
    this.outline?.paint(palette);
    for (const ghost of [...Object.values(this.ghosts), this.veil]) ghost.paint(palette);
  }

  /** Box of all links as they are now, in the world. */
  bounds(): Bounds {
    return boundsOfPosture(this.avatar, this.posture.world);
  }

  private geometryNow(): THREE.BufferGeometry {
    return this.kept(`${this.shape} ${this.isCoarse}`, () => bodyGeometry(this.avatar, this.shape, this.isCoarse));
  }

  private kept(key: string, make: () => THREE.BufferGeometry): THREE.BufferGeometry {
    const geometry = this.geometries.get(key) ?? make();
    this.geometries.set(key, geometry);
    return geometry;
  }
}
