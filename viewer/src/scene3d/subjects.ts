// What the camera is to show: a contact with the body around it, the body, or everything.

import * as THREE from "three";
import type { Contact } from "../contacts/contact.js";
import type { Touch } from "../contacts/touch.js";
import type { Bounds, Vector } from "../data/document.js";
import type { Model } from "../model.js";
import { pointAt, transformSize } from "../motion/chain.js";
import { ball, emptyBounds, union } from "./bounds.js";
import type { Limb, Subject } from "./framing.js";
import type { Performer } from "./performer.js";

/** A body smaller than this share of the scene is not seen where all of the scene is. */
const lostShare = 0.2;

/** Of the body's radius: around a foot, or a link. */
const closeUp = 0.35;
/** Of the body's radius: what is to be placed is looked at with the floor that it stands on. */
const surroundings = 1.7;

export type Scope = "body" | "everything";

export class Subjects {
  constructor(
    private readonly model: Model,
    private readonly performers: readonly Performer[],
    private readonly origin: Vector,
  ) {}

  ofContact(contact: Contact): Subject {
    const { posture } = this.performers[contact.avatar];
    const before = this.linkOrigin(contact, 0), after = this.linkOrigin(contact, 1);
    posture.moveTo(contact.at);
    const { centre, radius } = ball(this.performers[contact.avatar].bounds());
    const point = this.local(contact.point ?? centre);
    // The avatar matters, the contact matters more.
    const middle = this.local(centre).lerp(point, 0.55);
    return {
      centre: middle,
      radius: Math.max(0.86 * radius, middle.distanceTo(point) + 0.2 * radius),
      point,
      body: this.limbsBeside(contact.avatar, contact.link),
      wanted: [before, after],
      normal: contact.normal === null ? null : new THREE.Vector3(...contact.normal),
      motion: after.clone().sub(before),
    };
  }

  /** The foot as it is now, from near, with the way that it slides; or the link of the person. */
  ofLink({ avatar, link, stance }: Touch): Subject {
    const { posture } = this.performers[avatar], { radius } = ball(this.performers[avatar].bounds());
    if (stance === null) {
      const middle = this.middleOf(avatar, link);
      return { centre: middle, radius: closeUp * radius, point: middle, wanted: [], body: this.limbsBeside(avatar, link), normal: null, motion: null };
    }
    const ankle = this.local(pointAt(posture.world, transformSize * link, [0, 0, 0])), trace = stance.trace.map((at) => this.local(at));
    const farthest = trace.reduce((most, at) => Math.max(most, at.distanceTo(ankle)), 0);
    return { centre: ankle, radius: Math.max(closeUp * radius, farthest), point: ankle, wanted: trace.slice(0, 1), body: [], normal: new THREE.Vector3(0, 1, 0), motion: null };
  }

  /** Of its LSS; its joint where it has none. */
  private middleOf(avatar: number, link: number): THREE.Vector3 {
    const { avatar: { lss }, posture } = this.performers[avatar];
    const ends = lss.filter((one) => one.link === link).flatMap(({ a, b }) => [a, b]), all = ends.length === 0 ? [[0, 0, 0] as const] : ends;
    const sum = all.reduce((to, end) => to.add(this.local(pointAt(posture.world, transformSize * link, end))), new THREE.Vector3());
    return sum.divideScalar(all.length);
  }

  /** The bodies as they are now; with the scene where asked for, or where there is no body. */
  ofAll(scope: Scope): Subject {
    const bodies = this.bodies();
    const scene = this.model.document.scene.bounds;
    const boxes = (scope === "everything" || bodies.length === 0) && scene !== null ? [...bodies, scene] : bodies;
    const { centre, radius } = ball(boxes.reduce(union, emptyBounds));
    const wanted = boxes.map((box) => this.local(ball(box).centre));
    const isAround = boxes === bodies && this.model.document.kind === "inspection";
    return { centre: this.local(centre), radius: (isAround ? surroundings : 0.9) * radius, point: null, wanted, body: [], normal: null, motion: null };
  }

  /** What an opening page shows: of a large scene the part where the body is. */
  opening(): Scope {
    const scene = this.model.document.scene.bounds, bodies = this.bodies();
    if (this.model.document.kind !== "inspection" || scene === null || bodies.length === 0) return "body";
    return ball(bodies.reduce(union, emptyBounds)).radius < lostShare * ball(scene).radius ? "body" : "everything";
  }

  private bodies(): Bounds[] {
    return this.performers.filter((one) => one.clip.hasPose && one.avatar.outline === null).map((one) => one.bounds());
  }

  /** All limbs but the one in contact and the one it moves with, as they are posed. */
  private limbsBeside(index: number, chosen: number): Limb[] {
    const { avatar, posture } = this.performers[index];
    const beside = avatar.lss.filter(({ link }) => link !== chosen && link !== avatar.links[chosen].parent);
    return beside.map(({ link, a, b, radius }) => {
      const at = transformSize * link;
      return { a: this.local(pointAt(posture.world, at, a)), b: this.local(pointAt(posture.world, at, b)), radius };
    });
  }

  private linkOrigin(contact: Contact, u: number): THREE.Vector3 {
    const { posture } = this.performers[contact.avatar];
    posture.moveWithin(contact.step, u);
    const transform = posture.transform(contact.link);
    return this.local([transform[9], transform[10], transform[11]]);
  }

  private local(point: Vector): THREE.Vector3 {
    return new THREE.Vector3(point[0] - this.origin[0], point[1] - this.origin[1], point[2] - this.origin[2]);
  }
}
