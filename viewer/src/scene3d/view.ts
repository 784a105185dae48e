// The 3D view: stage, camera and what is staged, as the state says.

import * as THREE from "three";
import { discreteCount } from "../contacts/discrete.js";
import { whose } from "../contacts/touch.js";
import type { Vector } from "../data/document.js";
import type { Model } from "../model.js";
import { chooseContact } from "../panels/choosing.js";
import type { Change, LinkChoice, RayHit, Store } from "../state.js";
import { ball } from "./bounds.js";
import { Cutaway } from "./cutaway.js";
import { Flight } from "./flight.js";
import { sightOf } from "./framing.js";
import { Labels } from "./labels.js";
import { Measures } from "./measures.js";
import { Occluders } from "./occluders.js";
import { palettes } from "./palette.js";
import type { Performer } from "./performer.js";
import { pickScene } from "./picking.js";
import { Placing } from "./placing_hand.js";
import { contactNear, linkUnder, listenForClicks } from "./pointer.js";
import { Scenery } from "./scenery.js";
import { SlideTraces } from "./slide_traces.js";
import type { FrameKind, Part } from "./stage.js";
import { Stage } from "./stage.js";
import { Staging } from "./staging.js";
import type { Scope } from "./subjects.js";
import { Subjects } from "./subjects.js";
import { Tracking } from "./tracking.js";
import { Wipe } from "./wipe.js";

export class View3D {
  private readonly stage: Stage;
  private readonly flight: Flight;
  private readonly labels: Labels;
  private readonly occluders: Occluders;
  private readonly tracking: Tracking;
  private readonly cutaway = new Cutaway();
  private readonly scenery: Scenery;
  private readonly staging: Staging;
  private readonly subjects: Subjects;
  private readonly wipe: Wipe;
  private readonly slides: SlideTraces;
  private readonly measures: Measures | null;
  private readonly placing: Placing | null;
  private readonly origin: Vector;

  /** Throws where there is no WebGL. */
  constructor(
    host: HTMLElement,
    private readonly model: Model,
    private readonly store: Store,
  ) {
    const { scene, kind } = model.document;
    this.stage = new Stage(host);
    this.flight = new Flight(this.stage);
    this.tracking = new Tracking(this.stage);
    this.labels = new Labels(this.stage, host);
    this.origin = scene.origin;
    this.staging = new Staging(model, store, this.origin);
    this.subjects = new Subjects(model, this.staging.performers, this.origin);
    this.scenery = new Scenery(scene, this.cutaway, this.staging.shadow);
    this.occluders = new Occluders(scene);
    this.slides = new SlideTraces(model.stances, this.origin);
    this.stage.scene.add(this.scenery.group, this.staging.group, this.slides.group);
    this.wipe = new Wipe(host, () => this.stage.draw());
    this.measures = kind === "inspection" ? this.makeMeasures() : null;
    this.placing = kind === "inspection" ? new Placing(model, store, this.staging.performers) : null;
    this.stage.onFrame((frame) => this.beforeFrame(frame));
    listenForClicks(this.stage.canvas, (x, y) => this.click(x, y));
    this.paint();
    this.staging.poseTruth();
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

  /** What is seen now, as a picture. */
  picture(): HTMLCanvasElement {
    return this.stage.picture();
  }

  update(changes: ReadonlySet<Change>): void {
    const { state } = this.store;
    if (changes.has("avatars")) this.staging.join();
    if (changes.has("theme")) this.paint();
    if (changes.has("shape")) this.staging.setShape();
    if (changes.has("contacts")) this.staging.setContacts();
    if (changes.has("showsDiscrete")) state.showsDiscrete && this.canCheck() ? this.wipe.show() : this.wipe.hide();
    this.stage.draw();
  }

  /** Looks at the chosen contact, or at the body where none is chosen. */
  frame(isInstant: boolean, scope: Scope = "body"): void {
    const { contact, touch } = this.store.state;
    this.staging.poseTruth();
    const isContact = scope === "body" && contact !== null && contact.point !== null;
    const isLink = scope === "body" && touch !== null && whose(touch) !== "link";
    const subject = isContact ? this.subjects.ofContact(contact) : isLink ? this.subjects.ofLink(touch) : this.subjects.ofAll(scope);
    this.flight.to(sightOf(subject, this.stage.camera, this.occluders), isInstant);
    this.staging.poseTruth();
  }

  /** As a page opens. */
  open(): void {
    this.labels.set(this.measures?.labels() ?? []);
    this.frame(true, this.store.state.contact === null ? this.subjects.opening() : "body");
  }

  /** Frames the chosen foot, or link of the person, or the chosen contact if it is not seen well already. */
  keepInSight(): void {
    const { contact, touch } = this.store.state, point = contact?.point ?? null;
    if (touch !== null && whose(touch) !== "link") return this.frame(false);
    if (contact === null || point === null) return;
    const at = this.screenOf(point);
    const { clientWidth, clientHeight } = this.stage.canvas;
    const isCentral = at !== null && Math.abs(at[0] / clientWidth - 0.5 - this.stage.shift) < 0.3 && Math.abs(at[1] / clientHeight - 0.5) < 0.3;
    const distance = this.stage.camera.position.distanceTo(this.local(point));
    if (!isCentral || distance > 5 * this.staging.radiusOf(contact.avatar)) this.frame(false);
  }

  private canCheck(): boolean {
    return discreteCount(this.model.contacts) !== null;
  }

  private track(): void {
    const { state } = this.store;
    const performer = this.staging.performers[state.link?.avatar ?? 0];
    const isTracking = state.tracks && (state.isPlaying || state.follows) && performer?.clip.hasPose === true;
    if (!isTracking) return this.tracking.follow(null);
    const [x, y, z] = performer.posture.transform(0).slice(9);
    this.tracking.follow(this.local([x, y, z]));
  }

  private paint(): void {
    const palette = palettes[this.store.state.theme];
    this.stage.paint(palette);
    this.scenery.paint(palette);
    this.staging.paint(palette);
    this.slides.paint(palette);
    this.measures?.paint(palette);
  }

  private beforeFrame({ isCoarse, maxTriangles }: FrameKind): readonly Part[] {
    const { state } = this.store;
    this.scenery.maxTriangles = maxTriangles;
    this.staging.setCoarse(isCoarse);
    this.staging.poseTruth();
    this.track();
    this.slides.choose(state.touch);
    this.staging.markers.setView(this.stage.pixelRatio, this.stage.camera, this.stage.canvas.clientHeight);
    this.stage.camera.updateMatrixWorld();
    this.aimCutaway(this.staging.performers[state.contact?.avatar ?? 0]);
    this.labels.place();
    const shadowed = (pose: () => void) => (): void => {
      pose();
      this.staging.castShadows(this.stage.drawer);
    };
    const truth = shadowed(() => this.staging.poseTruth());
    if (!state.showsDiscrete || !this.canCheck()) return [{ from: 0, to: 1, prepare: truth }];
    return this.wipe.parts(shadowed(() => this.staging.poseCheck()), truth);
  }

  private aimCutaway(performer: Performer | undefined): void {
    const cuts = this.store.state.cutsAway && performer !== undefined && performer.clip.hasPose;
    if (!cuts) return this.cutaway.aim(this.stage.camera, new THREE.Vector3(0, 0, -1), 0);
    const { centre, radius } = ball(performer.bounds());
    this.cutaway.aim(this.stage.camera, this.local(centre), radius);
  }

  private makeMeasures(): Measures {
    const { bounds } = this.model.document.scene;
    this.staging.poseTruth();
    const boxes = this.staging.performers.filter((one) => one.clip.hasPose).map((one) => one.bounds());
    const measures = new Measures(this.origin, bounds === null ? boxes : [bounds, ...boxes]);
    this.stage.scene.add(measures.group);
    return measures;
  }

  private click(x: number, y: number): void {
    const { state } = this.store;
    const lit = new Set(this.staging.litContacts());
    const contact = contactNear(this.model.contacts, (one) => lit.has(one) || one === state.contact, (point) => this.screenOf(point), x, y);
    if (contact !== null) return chooseContact(this.store, this.model, contact);
    const ray = this.stage.rayThrough(x, y), direction: Vector = [ray.direction.x, ray.direction.y, ray.direction.z];
    const link = linkUnder(this.staging.performers, this.worldOf(ray.origin), direction);
    const { scene } = this.model.document, met = pickScene(scene, ray);
    if (link === null && this.placing?.click(met === null ? null : { at: this.worldOf(met.at), upwards: met.normal.y }) === true) return;
    const hit: RayHit = {
      time: state.time,
      origin: this.worldOf(ray.origin),
      direction,
      link: link === null ? null : this.nameOf(link),
      linkDistance: link?.distance ?? Infinity,
      object: met === null ? null : (scene.objects.find(({ first, count }) => first <= met.triangle && met.triangle < first + count)?.name ?? "the scene"),
      objectDistance: met === null ? Infinity : met.at.distanceTo(ray.origin),
    };
    const choice = link === null ? null : { avatar: link.avatar, link: link.link };
    this.store.set({ link: choice, contact: null, touch: null, ray: link === null && met === null ? null : hit });
  }

  private nameOf({ avatar, link }: LinkChoice): string {
    const { performers } = this.staging, one = performers[avatar].avatar, name = one.links[link].name;
    return performers.length === 1 ? name : `${one.name}'s ${name}`;
  }

  private local(point: Vector): THREE.Vector3 {
    return new THREE.Vector3(point[0] - this.origin[0], point[1] - this.origin[1], point[2] - this.origin[2]);
  }

  private worldOf(point: THREE.Vector3): Vector {
    return [point.x + this.origin[0], point.y + this.origin[1], point.z + this.origin[2]];
  }
}
