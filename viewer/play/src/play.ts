// What a person does with the page, and what the library says of it. Two ways to play:
//   reach  the body is solid: it follows the pointer as closely as surfaces let it;
//   step   the body moves from one pose to another, or through a clip: what does it meet first?

import * as THREE from "three";
import type { Contact, Pose, SolidTick } from "../../../bindings/wasm/foretouch.js";
import { interpolate } from "../../src/motion/chain.js";
import type { Engine } from "./engine.js";
import type { Body, ProofPlane } from "./messages.js";
import type { Mark, PlayView } from "./play_view.js";
import type { NamedScene } from "./room.js";

export type Mode = "reach" | "step";

/** What the page shows in words, too. */
export interface Said {
  readonly mode: Mode;
  /** Of "reach". */
  readonly tick: SolidTick | null;
  /** Of "step": all links that are not clear. */
  readonly contacts: readonly Contact[];
  readonly clearLinks: number;
  readonly planes: readonly ProofPlane[];
  /** Of the last answer. */
  readonly microseconds: number;
  /** Of the step, 0 to 1. */
  readonly time: number;
  readonly frame: number;
  readonly seesProof: boolean;
  readonly seesSwept: boolean;
}

/** A still target is at rest after so many ticks: nothing is asked any more. */
const restTicks = 90;
/** Longest time between two ticks that counts as one, seconds. */
const longestTick = 0.1;
/** Arrow of a contact in a step; of a push, per metre of it; and at most. Metres. */
const arrow = 0.12, arrowPerPush = 4, longestArrow = 0.3;
/** Links whose proof is shown at once. */
const mostProven = 3;

function copied({ rotations, translations }: Pose): Pose {
  return { rotations: rotations.slice(), translations: translations.slice() };
}

export class Play {
  scene: NamedScene | null = null;
  body: Body | null = null;
  mode: Mode = "reach";
  /** Where the pointer has led the body to. */
  tracked: Pose = { rotations: new Float64Array(), translations: new Float64Array() };
  from: Pose = this.tracked;
  private said: Said = { mode: "reach", tick: null, contacts: [], clearLinks: 0, planes: [], microseconds: 0, time: 1, frame: 0, seesProof: true, seesSwept: true };
  private still = 0;
  private isTicking = false;
  private lastTick = 0;
  /** Answers to what was asked before the last change are not shown. */
  private asked = 0;

  constructor(
    private readonly engine: Engine,
    private readonly view: PlayView | null,
    private readonly tell: (said: Said) => void,
  ) {}

  /** Whether nothing is asked, nor will be before a person does something. */
  get isAtRest(): boolean {
    return !this.isTicking;
  }

  get now(): Said {
    return this.said;
  }

  async setScene(scene: NamedScene): Promise<{ triangles: number; milliseconds: number }> {
    const { positions, indices, objects } = scene;
    const answer = await this.engine.ask("scene", { positions, indices, objects });
    this.scene = scene;
    this.view?.setScene(scene);
    if (this.body !== null) await this.restart();
    return answer;
  }

  /** At a place of its own; a clip begins with its first frame. */
  async setBody(body: Body, at: readonly number[] | null): Promise<void> {
    this.body = body;
    const pose = body.frames > 0 ? await this.engine.ask("frame", { frame: 0 }) : copied(body.rest);
    if (at !== null) pose.translations.set(at, 0);
    [this.tracked, this.from] = [pose, copied(pose)];
    this.view?.setBody(body).place(pose);
    await this.restart();
  }

  async setMode(mode: Mode): Promise<void> {
    this.mode = mode;
    this.from = copied(this.said.tick?.shown ?? this.tracked);
    if (mode === "step") this.tracked = copied(this.from);
    await this.restart();
  }

  private async restart(): Promise<void> {
    if (this.body === null || this.scene === null) return;
    await this.engine.ask("reset", {});
    this.say({ mode: this.mode, tick: null, contacts: [], planes: [], time: 1, frame: 0 });
    this.view?.setSwept([]);
    this.view?.setPlanes([]);
    this.view?.setMarks([]);
    await this.changed();
  }

  /** Moves the whole body: that of the later pose, in a step. */
  move(by: THREE.Vector3): void {
    this.roots((pose, root) => {
      for (const axis of [0, 1, 2]) pose.translations[3 * root + axis] += by.getComponent(axis);
    });
    void this.changed();
  }

  turn(axis: THREE.Vector3, radians: number): void {
    const by = new THREE.Quaternion().setFromAxisAngle(axis, radians), q = new THREE.Quaternion();
    this.roots((pose, root) => {
      const [w, x, y, z] = pose.rotations.subarray(4 * root, 4 * root + 4);
      q.set(x, y, z, w).premultiply(by).normalize();
      pose.rotations.set([q.w, q.x, q.y, q.z], 4 * root);
    });
    void this.changed();
  }

  /** For tests and programs: the pose that the pointer would have led to. */
  async lead(pose: Pose): Promise<void> {
    this.tracked = copied(pose);
    await this.changed();
  }

  private roots(change: (pose: Pose, root: number) => void): void {
    this.body?.parents.forEach((parent, link) => {
      if (parent < 0) change(this.tracked, link);
    });
  }

  private async changed(): Promise<void> {
    this.still = 0;
    if (this.mode === "step") return this.askStep();
    this.keepTicking();
  }

  // ---- reach

  private keepTicking(): void {
    if (this.isTicking || this.body === null || this.scene === null) return;
    this.isTicking = true;
    this.lastTick = performance.now() - 1000 / 60;
    const next = async (): Promise<void> => {
      const isDone = this.mode !== "reach" || this.still > restTicks;
      if (isDone || !(await this.tick().catch(() => false))) this.isTicking = false;
      else requestAnimationFrame(() => void next());
    };
    void next();
  }

  /** One tick of the solid body; false where it is asked no more. */
  private async tick(): Promise<boolean> {
    const { body } = this, now = performance.now();
    const seconds = Math.min(longestTick, Math.max(1e-3, (now - this.lastTick) / 1000));
    this.lastTick = now;
    ++this.still;
    const { tick, microseconds } = await this.engine.ask("follow", { tracked: this.tracked, seconds });
    if (body !== this.body || this.mode !== "reach") return false;
    this.show(tick.shown, tick.state === "equal" ? null : this.tracked);
    this.view?.setTouching(new Set(tick.contacts.map(({ link }) => link)));
    this.view?.setMarks(tick.contacts.map(({ point, normal, push }): Mark => ({ point, normal, length: Math.min(longestArrow, arrowPerPush * push) })));
    this.say({ tick, microseconds });
    return true;
  }

  // ---- step

  /** Asks what is met between the two poses, and shows it at the time that is set. */
  async askStep(): Promise<void> {
    const { body } = this, turn = ++this.asked;
    if (body === null || this.scene === null) return;
    const { contacts, microseconds } = await this.engine.ask("step", { from: this.from, to: this.tracked });
    if (turn !== this.asked) return;
    const met = contacts.filter(({ verdict }) => verdict !== "clear");
    this.say({ contacts: met, clearLinks: contacts.length - met.length, microseconds });
    await this.showStep();
    await this.showSwept(turn);
  }

  async seek(time: number): Promise<void> {
    this.say({ time });
    await this.showStep();
  }

  /** Of a clip: from this frame to the next. */
  async seekFrame(frame: number): Promise<void> {
    const { body } = this;
    if (body === null || body.frames < 2) return;
    const first = Math.min(body.frames - 2, Math.max(0, Math.floor(frame)));
    [this.from, this.tracked] = [await this.engine.ask("frame", { frame: first }), await this.engine.ask("frame", { frame: first + 1 })];
    this.say({ frame: first });
    if (this.mode === "step") await this.askStep();
    else await this.changed();
  }

  async see({ proof, swept }: { proof?: boolean; swept?: boolean }): Promise<void> {
    this.say({ seesProof: proof ?? this.said.seesProof, seesSwept: swept ?? this.said.seesSwept });
    if (this.mode === "step") await this.askStep();
  }

  private async showStep(): Promise<void> {
    const { body } = this, { time, contacts } = this.said;
    if (body === null || this.mode !== "step") return;
    const between = copied(this.from);
    interpolate(this.from, this.tracked, time, between);
    this.show(between, null, this.from);
    const touched = contacts.filter(({ toi, verdict }) => verdict !== "undecided" && toi <= time);
    this.view?.setTouching(new Set(touched.map(({ link }) => link)));
    this.view?.setMarks(contacts.filter(({ verdict }) => verdict !== "undecided").map(({ pointScene, normal }): Mark => ({ point: pointScene, normal, length: arrow })));
    await this.showProof();
  }

  private async showSwept(turn: number): Promise<void> {
    const { contacts, seesSwept } = this.said;
    if (!seesSwept) return this.view?.setSwept([]);
    const links = contacts.filter(({ verdict }) => verdict === "contact").slice(0, mostProven);
    const surfaces = [];
    for (const { link, toi } of links) surfaces.push(...(await this.engine.ask("swept", { link, end: Math.max(1e-3, toi) })));
    if (turn === this.asked) this.view?.setSwept(surfaces);
  }

  /** Why links are clear: of those that the proof needs planes for now, some. */
  private async showProof(): Promise<void> {
    const turn = this.asked, { body } = this, { contacts, time, seesProof } = this.said;
    if (body === null) return;
    if (!seesProof) {
      this.say({ planes: [] });
      return this.view?.setPlanes([]);
    }
    const met = new Set(contacts.map(({ link }) => link));
    const clear = body.links.flatMap(({ lss }, link) => (met.has(link) || (lss ?? []).length === 0 ? [] : [link])).slice(-2 * mostProven);
    const planes = await this.engine.ask("proof", { links: clear, time });
    if (turn !== this.asked || this.mode !== "step") return;
    this.say({ planes });
    this.view?.setPlanes(planes);
  }

  private show(pose: Pose, tracked: Pose | null, before: Pose | null = null): void {
    const figure = this.view?.figure ?? null;
    figure?.place(pose);
    figure?.ghost("tracked", tracked);
    figure?.ghost("before", before);
    this.view?.stage.draw();
  }

  private say(what: Partial<Said>): void {
    this.said = { ...this.said, ...what };
    this.tell(this.said);
  }
}
