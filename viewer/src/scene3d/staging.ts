// Puts the avatars and what belongs to them on the stage as the state says: as it happened, or as a
// check of the poses alone sees it.

import * as THREE from "three";
import type { Contact } from "../contacts/contact.js";
import { contactsAt } from "../contacts/contact.js";
import { seenAtPoses, touchingLinks } from "../contacts/discrete.js";
import type { Bounds, Vector } from "../data/document.js";
import type { Model } from "../model.js";
import { carried } from "../motion/placing.js";
import type { Store } from "../state.js";
import { ball, emptyBounds, union } from "./bounds.js";
import { ContactShadow } from "./contact_shadow.js";
import { Markers } from "./markers.js";
import type { Palette } from "./palette.js";
import { palettes } from "./palette.js";
import { Performer } from "./performer.js";
import { SweptView } from "./swept_view.js";

/** How long a contact stays lit while time runs, seconds: shorter than this nobody sees it. */
const afterglow = 0.3;
/** Of an avatar's size. */
const arrowLength = 0.11;
/** Where the strength is known, of the usual arrow: at rest, and from 2 m/s on. */
const shortestArrow = 0.6, longestArrow = 2;

/** The links of an avatar that these contacts are of, on either side. */
function touchingOf(avatar: number, contacts: readonly Contact[]): ReadonlySet<number> {
  const links = new Set<number>();
  for (const contact of contacts) {
    if (contact.verdict === "undecided") continue;
    if (contact.avatar === avatar) links.add(contact.link);
    if (contact.otherAvatar === avatar) links.add(contact.otherLink ?? 0);
  }
  return links;
}

export class Staging {
  readonly group = new THREE.Group();
  readonly performers: Performer[] = [];
  readonly markers = new Markers();
  readonly shadow = new ContactShadow();
  private readonly swept: SweptView;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
    private readonly origin: Vector,
  ) {
    this.swept = new SweptView(model.avatars);
    this.group.add(this.markers.group, this.swept.group);
    this.join();
    this.setContacts();
  }

  /** Avatars that have no performer yet get one. */
  join(): void {
    const { avatars, clips, tracked } = this.model, { shape, theme } = this.store.state;
    for (let i = this.performers.length; i < avatars.length; ++i) {
      const performer = new Performer(avatars[i], clips[i], shape, this.origin, tracked[i]);
      performer.paintGhosts(palettes[theme]);
      this.performers.push(performer);
      this.group.add(performer.group);
    }
  }

  setContacts(): void {
    this.markers.setContacts(this.model.contacts, this.origin, (contact) => this.thickness(contact), (contact) => this.strength(contact));
  }

  setShape(): void {
    for (const one of this.performers) one.setShape(this.store.state.shape);
  }

  setCoarse(isCoarse: boolean): void {
    for (const one of this.performers) one.setCoarse(isCoarse);
  }

  paint(palette: Palette): void {
    this.markers.paint(palette);
    this.swept.paint(palette);
    for (const performer of this.performers) performer.paintGhosts(palette);
  }

  /** As it happened. */
  poseTruth(): void {
    const { state } = this.store;
    const lit = this.litContacts();
    this.performers.forEach((performer, index) => {
      performer.moveTo(state.time);
      performer.paint(palettes[state.theme], touchingOf(index, lit), this.chosenLink(index));
      if (state.place !== null) this.poseAtPlace(performer);
      else this.poseGhosts(performer, index);
      performer.showVeil(state.touch?.link ?? 0, state.touch?.avatar === index ? (state.touch.person?.growth ?? null) : null);
    });
    const arrows = state.contact === null ? lit : [...new Set([state.contact, ...lit])];
    this.markers.hasTraces = true;
    this.markers.setCurrent(lit, state.contact, this.origin);
    this.markers.setArrows(arrows, this.origin, arrowLength * 2 * this.radiusOf(0));
    this.swept.show(state.showsSwept ? (state.contact === null ? lit : [state.contact]) : [], this.origin);
  }

  /** As one sees it who looks at the poses alone: the body jumps from pose to pose. */
  poseCheck(): void {
    const { state } = this.store;
    const seen = seenAtPoses(this.model, state.time);
    this.performers.forEach((performer, index) => {
      performer.moveTo(performer.clip.poseTimeAt(state.time));
      const touching = touchingLinks(this.model.avatars[index].track, state.time);
      performer.paint(palettes[state.theme], touching, this.chosenLink(index));
      performer.hideGhosts();
      const { step } = performer.clip.instantAt(state.time);
      if (!state.isPlaying && step >= 0) performer.showGhost("asked", step, 1);
    });
    this.markers.hasTraces = false;
    this.markers.setCurrent(seen, null, this.origin);
    this.markers.setArrows([], this.origin, 1);
    this.swept.show([], this.origin);
  }

  castShadows(renderer: THREE.WebGLRenderer): void {
    const casting = this.performers.filter(({ clip, avatar }) => clip.hasPose && avatar.outline === null);
    const bounds = casting.map((one) => one.bounds()).reduce(union, emptyBounds);
    const local = (point: Vector): Vector => [point[0] - this.origin[0], point[1] - this.origin[1], point[2] - this.origin[2]];
    const box: Bounds | null = casting.length === 0 ? null : { min: local(bounds.min), max: local(bounds.max) };
    this.shadow.cast(renderer, casting.map(({ mesh }) => mesh), box);
  }

  /** Of the ball around an avatar as it is now, metres. */
  radiusOf(index: number): number {
    const performer = this.performers[index];
    return performer?.clip.hasPose === true ? ball(performer.bounds()).radius : 1;
  }

  litContacts(): Contact[] {
    const { state } = this.store;
    const { contacts, longestStep } = this.model;
    const glow = state.isPlaying || state.follows ? afterglow : 0;
    const now = contactsAt(contacts, state.time, longestStep + glow);
    return glow === 0 ? now : [...new Set([...now, ...contactsAt(contacts, state.time - glow, longestStep + glow)])];
  }

  private chosenLink(avatar: number): number | null {
    const { link } = this.store.state;
    return link?.avatar === avatar ? link.link : null;
  }

  private poseGhosts(performer: Performer, index: number): void {
    const { state } = this.store;
    if (performer.isSolid) {
      if (state.showsGhosts) performer.showTracked(state.time);
      else performer.hideGhosts();
      return;
    }
    const chosen = state.contact !== null && state.contact.avatar === index ? state.contact : null;
    const step = chosen?.step ?? performer.instant.step;
    const isShown = state.showsGhosts && state.touch?.person == null && !state.showsDiscrete && !state.isPlaying && !state.follows && step >= 0;
    performer.showGhost("before", step, isShown ? 0 : null);
    performer.showGhost("asked", step, isShown ? 1 : null);
    const isElsewhere = chosen !== null && Math.abs(state.time - chosen.at) > 1e-6;
    performer.showGhost("atContact", step, isShown && isElsewhere ? (chosen?.toi ?? null) : null);
  }

  /** Where a click would have it. */
  private poseAtPlace(performer: Performer): void {
    const { place } = this.store.state;
    if (place !== null) performer.showGhostAt("asked", carried(performer.posture.world, this.model.place, place));
  }

  /** Of a contact's arrow, where a touch begins with it: by the speed at which the two approach. */
  private strength(contact: Contact): number {
    const touch = this.model.touchOf(contact), speed = touch?.rows[0] === contact ? (touch.strength?.speed ?? null) : null;
    return speed === null ? 1 : Math.min(longestArrow, shortestArrow + Math.sqrt(Math.max(0, speed)));
  }

  /** Of the thickest LSS of the link in contact; where it has none nothing is small. Metres. */
  private thickness({ avatar, link }: Contact): number {
    const radii = this.model.avatars[avatar].lss.filter((lss) => lss.link === link).map((lss) => lss.radius);
    return radii.length === 0 ? Infinity : 2 * Math.max(...radii);
  }
}
