// A world of Babylon.js: what stands still, what moves, skeletons, and hands of WebXR that pass through
// nothing; and what touches what, as observables report it.

import type { Scene, TransformNode } from "@babylonjs/core";
import type { BodyOptions, Foretouch, SolidOptions } from "foretouch";
import { type EngineLike, SceneWorld, type SceneWorldOptions, type Shown } from "foretouch/host";
import { type Experience, handSource } from "./hand.js";
import { babylon } from "./host.js";
import type { Thing } from "./objects.js";
import { Body, Hand, Rigid, Teller, type Toucher } from "./touchers.js";

export type WorldOptions = SceneWorldOptions<Thing> & {
  /** What stands still, with all below it but what is added; left out: all of the scene; null: nothing. */
  readonly still?: TransformNode | null;
};

/** Reports every touch once, from its first side; what was added gets its own ones. */
export class TouchWorld extends Teller {
  private readonly things: SceneWorld<Thing>;

  /** `library`: Foretouch, or its engine in a worker. */
  constructor(library: Foretouch | EngineLike, private readonly scene: Scene, { still, ...options }: WorldOptions = {}) {
    super();
    this.things = new SceneWorld<Thing>(library, babylon(scene.useRightHandedSystem), still === undefined ? scene : still, this.tell, options);
  }

  /** What stands still is another node, or has changed: the next update reads it anew and begins anew. */
  stand(still?: TransformNode | Scene | null): void {
    this.things.stand(still);
  }

  /** Something that moves as a whole, as your code moves it, with the meshes below it. */
  addMoving(node: TransformNode, options: BodyOptions = {}): Rigid {
    const rigid = new Rigid(node);
    rigid.member = this.things.addMoving(node, rigid.tell, options);
    return rigid;
  }

  /** A mesh with a skeleton, or a tree with such, whose bones your code moves. `shown`: a copy of it that follows and passes through nothing. */
  async addBody(mesh: TransformNode, options: SolidOptions & BodyOptions & Shown<Thing> = {}): Promise<Body> {
    const body = new Body(mesh, this.things);
    await this.things.addBody(mesh, body.tell, (member) => (body.member = member), options);
    return body;
  }

  /** A hand of WebXR, solid; `experience`: xr.baseExperience. Its size is that of the first frame in which all its joints are tracked. */
  addHand(experience: Experience, handedness: "left" | "right", options: SolidOptions & BodyOptions = {}): Hand {
    const hand = new Hand(this.scene, this.things, handedness);
    this.things.addJoints(handSource(experience, handedness, hand), { liftsFeet: false, ...options }, (member) => (hand.member = member), hand.root);
    return hand;
  }

  /** Removes it: it is in nothing's way, and hears nothing more. */
  remove({ object }: Toucher): void {
    this.things.remove(object);
  }

  /** From now on the joint carries it, as it is there; until letGo(), or a gap. */
  hold({ member }: Rigid, by: Body, joint: string): void {
    if (member !== null) this.things.hold(member, by.member, joint);
  }

  letGo({ member }: Rigid): void {
    if (member !== null) this.things.letGo(member);
  }

  /** Once per frame, with its time in milliseconds, before it is rendered: of scene.onBeforeRenderObservable. A promise where the engine is in a worker; there is no need to wait for it. */
  update(timeMs: number): void | Promise<void> {
    return this.things.update(timeMs);
  }

  /** After a teleport: nothing between the last update and the next one is swept. */
  restart(): void {
    this.things.restart();
  }

  override dispose(): void {
    super.dispose();
    this.things.dispose();
  }
}
