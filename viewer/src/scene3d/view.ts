// The 3D view: puts what the state says on the stage.

import * as THREE from "three";
import type { Contact } from "../contacts/contact.js";
import { contactsAt } from "../contacts/contact.js";
import { isSeenAtPose, touchingLinks } from "../contacts/discrete.js";
import type { Vector } from "../data/document.js";
import type { Model } from "../model.js";
import { pointAt, transformSize } from "../motion/chain.js";
import { choose } from "../panels/choosing.js";
import { seconds } from "../panels/words.js";
import type { Change, Store } from "../state.js";
import { ball, emptyBounds, union } from "./bounds.js";
import { Cutaway } from "./cutaway.js";
import { Flight } from "./flight.js";
import type { Limb, Subject } from "./framing.js";
import { sightOf } from "./framing.js";
import type { Label } from "./labels.js";
import { Labels } from "./labels.js";
import { Markers, MarkerState } from "./markers.js";
import { Measures } from "./measures.js";
import { Occluders } from "./occluders.js";
import { palettes } from "./palette.js";
import { Performer } from "./performer.js";
import { contactNear, linkUnder, listenForClicks } from "./pointer.js";
import { Scenery } from "./scenery.js";
import { Stage } from "./stage.js";
import { SweptView } from "./swept_view.js";
import { Tracking } from "./tracking.js";

/** How long a contact stays lit while time runs, seconds: shorter than this nobody sees it. */
const afterglow = 0.3;
/** Of an avatar's size. */
const arrowLength = 0.11;

export class View3D {
  private readonly stage: Stage;
  private readonly flight: Flight;
  private readonly labels: Labels;
  private readonly occluders: Occluders;
  private readonly tracking: Tracking;
  private readonly cutaway = new Cutaway();
  private readonly scenery: Scenery;
  private readonly markers = new Markers();
  private readonly swept: SweptView;
  private readonly performers: Performer[] = [];
  private readonly measures: Measures | null;
  private readonly origin: Vector;

  /** Throws where there is no WebGL. */
  constructor(
    host: HTMLElement,
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.stage = new Stage(host);
    this.flight = new Flight(this.stage);
    this.tracking = new Tracking(this.stage);
    this.labels = new Labels(this.stage, host);
    this.origin = model.document.scene.origin;
    this.scenery = new Scenery(model.document.scene, this.cutaway);
    this.occluders = new Occluders(model.document.scene);
    this.swept = new SweptView(model.avatars);
    this.stage.scene.add(this.scenery.group, this.markers.group, this.swept.group);
    this.addPerformers();
    this.measures = model.document.kind === "inspection" ? this.makeMeasures() : null;
    this.markers.setContacts(model.contacts, this.origin, (contact) => this.thickness(contact));
    this.stage.onFrame((isCoarse) => this.beforeFrame(isCoarse));
    listenForClicks(this.stage.canvas, (x, y) => this.click(x, y));
    this.paint();
    this.update(new Set(["time"]));
  }

  get frames(): number {
    return this.stage.frames;
  }

  get isAtRest(): boolean {
    return this.stage.isAtRest;
  }

  /** Pixels from the canvas' upper left corner; null behind the camera. */
  screenOf(point: Vector): [number, number] | null {
    return this.stage.screenOf(this.local(point));
  }

  update(changes: ReadonlySet<Change>): void {
    const { state } = this.store;
    if (changes.has("avatars")) this.addPerformers();
    if (changes.has("theme")) this.paint();
    if (changes.has("shape")) for (const one of this.performers) one.setShape(state.shape);
    if (changes.has("contacts")) this.markers.setContacts(this.model.contacts, this.origin, (contact) => this.thickness(contact));
    const isShapeFresh = changes.has("shape") || changes.has("theme");
    const matters: Change[] = [
      "time", "contact", "link", "showsDiscrete", "showsGhosts", "showsSwept", "contacts", "isPlaying",
    ];
    if (isShapeFresh || matters.some((change) => changes.has(change))) this.pose();
    if (changes.has("contact")) this.labels.set(this.currentLabels());
    this.stage.draw();
  }

  /** Looks at the chosen contact, or at everything where none is chosen. */
  frame(isInstant: boolean): void {
    const contact = this.store.state.contact;
    const subject = contact === null || contact.point === null ? this.wholeSubject() : this.subjectOf(contact);
    this.flight.to(sightOf(subject, this.stage.camera, this.occluders), isInstant);
    this.pose();
  }

  /** Frames the chosen contact if it is not seen well already. */
  keepInSight(): void {
    const point = this.store.state.contact?.point;
    if (point === undefined || point === null) return;
    const at = this.screenOf(point);
    const { clientWidth, clientHeight } = this.stage.canvas;
    const isCentral = at !== null && Math.abs(at[0] / clientWidth - 0.5) < 0.3 && Math.abs(at[1] / clientHeight - 0.5) < 0.3;
    const distance = this.stage.camera.position.distanceTo(this.local(point));
    if (!isCentral || distance > 5 * this.avatarRadius(this.store.state.contact?.avatar ?? 0)) this.frame(false);
  }

  /** For those avatars that have none yet. */
  private addPerformers(): void {
    const { avatars, clips } = this.model, { shape, theme } = this.store.state;
    for (let i = this.performers.length; i < avatars.length; ++i) {
      const performer = new Performer(avatars[i], clips[i], shape, this.origin);
      performer.paintGhosts(palettes[theme]);
      this.performers.push(performer);
      this.stage.scene.add(performer.group);
    }
  }

  private pose(): void {
    const { state } = this.store;
    const lit = new Set(this.litContacts());
    this.performers.forEach((performer, index) => {
      const shown = state.showsDiscrete ? performer.clip.poseTimeAt(state.time) : state.time;
      performer.moveTo(shown);
      const chosen = state.link?.avatar === index ? state.link.link : null;
      performer.paint(palettes[state.theme], this.touchingOf(index, lit), chosen);
      this.poseGhosts(performer, index);
    });
    this.track();
    this.markers.setStates((contact) => {
      if (contact === state.contact) return MarkerState.Chosen;
      if (lit.has(contact)) return MarkerState.Lit;
      // What starts in contact goes on from the step before: as a trace it only hides where contacts begin.
      return contact.verdict === "starts_in_contact" ? MarkerState.Hidden : MarkerState.Dim;
    });
    const hasChosenArrow = state.contact !== null && !state.showsDiscrete;
    const arrows = hasChosenArrow ? new Set([state.contact as Contact, ...lit]) : lit;
    this.markers.setArrows([...arrows], this.origin, arrowLength * 2 * this.avatarRadius(0));
    const sweeping = state.contact === null ? [...lit] : [state.contact];
    this.swept.show(state.showsSwept ? sweeping : [], this.origin);
  }

  private touchingOf(avatar: number, lit: ReadonlySet<Contact>): ReadonlySet<number> {
    const { state } = this.store;
    if (state.showsDiscrete) return touchingLinks(this.model.avatars[avatar].track, state.time);
    const touching = [...lit].filter((c) => c.avatar === avatar && c.verdict !== "undecided");
    return new Set(touching.map((contact) => contact.link));
  }

  private litContacts(): Contact[] {
    const { state } = this.store;
    const { contacts, avatars, longestStep } = this.model;
    if (state.showsDiscrete) {
      return contacts.filter((contact) => isSeenAtPose(contact, avatars[contact.avatar].track, state.time));
    }
    const glow = state.isPlaying || state.follows ? afterglow : 0;
    if (glow === 0) return contactsAt(contacts, state.time, longestStep);
    return contactsAt(contacts, state.time, longestStep + glow).concat(
      contactsAt(contacts, state.time - glow, longestStep + glow),
    );
  }

  private track(): void {
    const { state } = this.store;
    const performer = this.performers[state.link?.avatar ?? 0];
    const isTracking = state.tracks && (state.isPlaying || state.follows) && performer?.clip.hasPose === true;
    if (!isTracking) return this.tracking.follow(null);
    const [x, y, z] = performer.posture.transform(0).slice(9);
    this.tracking.follow(this.local([x, y, z]));
  }

  private poseGhosts(performer: Performer, index: number): void {
    const { state } = this.store;
    const chosen = state.contact !== null && state.contact.avatar === index ? state.contact : null;
    const step = chosen?.step ?? performer.instant.step;
    const isShown = state.showsGhosts && !state.isPlaying && !state.follows && step >= 0;
    performer.showGhost("before", step, isShown ? 0 : null);
    performer.showGhost("asked", step, isShown ? 1 : null);
    const toi = chosen?.toi ?? null;
    const isElsewhere = chosen !== null && (state.showsDiscrete || Math.abs(state.time - chosen.at) > 1e-6);
    performer.showGhost("atContact", step, isShown && isElsewhere ? toi : null);
  }

  private paint(): void {
    const palette = palettes[this.store.state.theme];
    this.stage.paint(palette);
    this.scenery.paint(palette);
    this.markers.paint(palette);
    this.swept.paint(palette);
    this.measures?.paint(palette);
    for (const performer of this.performers) performer.paintGhosts(palette);
  }

  private beforeFrame(isCoarse: boolean): void {
    const { state } = this.store;
    this.scenery.isCoarse = isCoarse;
    this.markers.setView(this.stage.pixelRatio, this.stage.camera, this.stage.canvas.clientHeight);
    const index = state.contact?.avatar ?? 0;
    const performer = this.performers[index];
    this.stage.camera.updateMatrixWorld();
    if (state.cutsAway && performer !== undefined && performer.clip.hasPose) {
      const { centre, radius } = ball(performer.bounds());
      this.cutaway.aim(this.stage.camera, this.local(centre), radius);
    } else {
      this.cutaway.aim(this.stage.camera, new THREE.Vector3(0, 0, -1), 0);
    }
    this.labels.place();
  }

  private subjectOf(contact: Contact): Subject {
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
      body: this.limbsBeside(contact),
      wanted: [before, after],
      normal: contact.normal === null ? null : new THREE.Vector3(...contact.normal),
      motion: after.clone().sub(before),
    };
  }

  /** All limbs but the one in contact and the one it moves with, as they are posed. */
  private limbsBeside(contact: Contact): Limb[] {
    const { avatar, posture } = this.performers[contact.avatar];
    const beside = avatar.lss.filter(({ link }) => link !== contact.link && link !== avatar.links[contact.link].parent);
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

  private wholeSubject(): Subject {
    const bounds = this.performers.filter((one) => one.clip.hasPose).map((one) => one.bounds());
    const isScenePart = this.model.document.kind === "inspection" || bounds.length === 0;
    if (isScenePart && this.model.document.scene.bounds !== null) bounds.push(this.model.document.scene.bounds);
    const { centre, radius } = ball(bounds.reduce(union, emptyBounds));
    const wanted = bounds.map((box) => this.local(ball(box).centre));
    return { centre: this.local(centre), radius: 0.9 * radius, point: null, wanted, body: [], normal: null, motion: null };
  }

  private avatarRadius(index: number): number {
    const performer = this.performers[index];
    return performer?.clip.hasPose === true ? ball(performer.bounds()).radius : 1;
  }

  private currentLabels(): Label[] {
    const contact = this.store.state.contact;
    const labels = this.measures?.labels() ?? [];
    if (contact === null || contact.point === null) return labels;
    const object = contact.object === null ? "" : ` × ${contact.object}`;
    const text = `${contact.linkName}${object} · ${seconds(contact.at - this.model.timeZero)}`;
    return [...labels, { kind: "callout", text, at: this.local(contact.point) }];
  }

  /** Of the thickest LSS of the link in contact; where it has none nothing is small. Metres. */
  private thickness({ avatar, link }: Contact): number {
    const radii = this.model.avatars[avatar].lss.filter((lss) => lss.link === link).map((lss) => lss.radius);
    return radii.length === 0 ? Infinity : 2 * Math.max(...radii);
  }

  private makeMeasures(): Measures {
    for (const performer of this.performers) performer.moveTo(this.store.state.time);
    const { bounds } = this.model.document.scene;
    const boxes = this.performers.filter((one) => one.clip.hasPose).map((one) => one.bounds());
    const measures = new Measures(this.origin, bounds === null ? boxes : [bounds, ...boxes]);
    this.stage.scene.add(measures.group);
    return measures;
  }

  showLabels(): void {
    this.labels.set(this.currentLabels());
  }

  private click(x: number, y: number): void {
    const { state } = this.store;
    const lit = new Set(this.litContacts());
    const isLit = (contact: Contact): boolean => lit.has(contact) || contact === state.contact;
    const contact = contactNear(this.model.contacts, isLit, (point) => this.screenOf(point), x, y);
    if (contact !== null) return choose(this.store, contact);
    const { origin, direction } = this.stage.rayThrough(x, y);
    const link = linkUnder(this.performers, this.worldOf(origin), [direction.x, direction.y, direction.z]);
    this.store.set({ link, contact: null });
  }

  private local(point: Vector): THREE.Vector3 {
    return new THREE.Vector3(point[0] - this.origin[0], point[1] - this.origin[1], point[2] - this.origin[2]);
  }

  private worldOf(point: THREE.Vector3): Vector {
    return [point.x + this.origin[0], point.y + this.origin[1], point.z + this.origin[2]];
  }
}
