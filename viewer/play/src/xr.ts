// "Reach in": a WebXR session whose two tracked hands are solid in the room. What is shown are the
// library's hands; where the tracker says that they are is a ghost.

import type { Point, Pose, SolidTick } from "../../../bindings/wasm/foretouch.js";
import { localPose, poseRoom } from "../../../bindings/wasm/host/frames.js";
import { handJoints, handParents, linksOfHand, readHand, type TrackedHand, trackedHand } from "../../../bindings/wasm/host/webxr_hand.js";
import type { Engine } from "./engine.js";
import { Refused } from "./engine.js";
import type { PlayView } from "./play_view.js";

const sides = ["left", "right"] as const;
const longestTick = 0.1;
/** Of what a session has shown, pieces and answers. */
const mostKept = 10000;

/** What a session has shown so far. */
export interface Reached {
  readonly frames: number;
  readonly ticks: readonly (SolidTick | null)[];
  readonly tracked: readonly (Pose | null)[];
  /** Where each shown wrist went, in straight lines: the last of it. */
  readonly ways: readonly (readonly Point[])[];
  readonly areCertified: boolean;
  readonly microseconds: readonly number[];
}

export async function hasVr(): Promise<boolean> {
  return (await navigator.xr?.isSessionSupported("immersive-vr").catch(() => false)) ?? false;
}

export class Reach {
  reached: Reached = { frames: 0, ticks: [null, null], tracked: [null, null], ways: [[], []], areCertified: true, microseconds: [] };
  private isAsking = false;
  private areHandsMade = false;
  private lastTime = 0;
  private readonly kept: (TrackedHand | null)[] = [null, null];

  constructor(
    private readonly engine: Engine,
    private readonly view: PlayView,
    private readonly ended: () => void,
  ) {}

  async begin(): Promise<void> {
    if (navigator.xr === undefined) throw new Refused("This browser has no WebXR.");
    const session = await navigator.xr.requestSession("immersive-vr", { requiredFeatures: ["local-floor"], optionalFeatures: ["hand-tracking"] });
    const renderer = this.view.stage.drawer;
    renderer.xr.enabled = true;
    renderer.xr.setReferenceSpaceType("local-floor");
    await renderer.xr.setSession(session);
    session.addEventListener("end", () => {
      renderer.setAnimationLoop(null);
      renderer.xr.enabled = false;
      this.view.setHands([]);
      // The next session may be another person's.
      this.areHandsMade = false;
      this.kept.fill(null);
      this.lastTime = 0;
      if (this.view.figure !== null) this.view.figure.group.visible = true;
      this.ended();
    });
    if (this.view.figure !== null) this.view.figure.group.visible = false;
    renderer.setAnimationLoop((time: number, frame?: XRFrame) => {
      if (frame !== undefined) this.frame(time, frame);
      renderer.render(this.view.stage.scene, this.view.stage.camera);
    });
  }

  private frame(time: number, frame: XRFrame): void {
    const space = this.view.stage.drawer.xr.getReferenceSpace();
    if (space === null) return;
    const tracked = sides.map((side) => this.joints(frame, space, side));
    tracked.forEach((joints, side) => (this.kept[side] = joints ?? this.kept[side]));
    this.reached = { ...this.reached, frames: this.reached.frames + 1 };
    // One question at a time: who draws faster than the library answers shows the last answer again.
    if (this.isAsking || this.kept.some((joints) => joints === null)) return;
    this.isAsking = true;
    const seconds = this.lastTime === 0 ? 1 / 72 : Math.min(longestTick, Math.max(1e-3, (time - this.lastTime) / 1000));
    this.lastTime = time;
    void this.ask(tracked, seconds).finally(() => (this.isAsking = false));
  }

  /** Null where the hand is not tracked: it then stays where it is. */
  private joints(frame: XRFrame, space: XRReferenceSpace, side: (typeof sides)[number]): TrackedHand | null {
    const source = Array.from(frame.session.inputSources).find(({ handedness, hand }) => handedness === side && hand);
    if (source === undefined) return null;
    const joints = trackedHand();
    return readHand(frame, source, space, joints) ? joints : null;
  }

  private async ask(tracked: readonly (TrackedHand | null)[], seconds: number): Promise<void> {
    const joints = this.kept as TrackedHand[];
    if (!this.areHandsMade) {
      this.view.setHands(await this.engine.ask("makeHands", { links: joints.map(linksOfHand) }));
      this.areHandsMade = true;
    }
    const poses = joints.map(({ frames }) => localPose(handParents, frames, poseRoom(handJoints.length)));
    const hands = poses.map((pose, side) => ({ tracked: pose, isTracked: handJoints.map(() => tracked[side] !== null) }));
    const { ticks, ways, microseconds } = await this.engine.ask("hands", { hands, seconds });
    ticks.forEach((tick, side) => {
      if (tick === null) return;
      const figure = this.view.hands[side];
      figure.place(tick.shown);
      figure.ghost("tracked", tick.state === "equal" ? null : poses[side]);
      this.view.paintHand(side, new Set(tick.contacts.map(({ link }) => link)));
    });
    const { reached } = this;
    this.reached = {
      ...reached,
      ticks,
      tracked: poses,
      ways: ways.map((way, side) => [...reached.ways[side].slice(-mostKept), ...way]),
      areCertified: reached.areCertified && ticks.every((tick) => tick?.isCertified ?? true),
      microseconds: [...reached.microseconds.slice(-mostKept), microseconds],
    };
  }
}
