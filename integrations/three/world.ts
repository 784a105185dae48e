// A world of three.js: what stands still, what moves, skeletons, and hands of WebXR that pass through
// nothing; and what touches what, as EventDispatcher reports it.

import { EventDispatcher, type Object3D } from "three";
import { type BodyOptions, type Foretouch, ForetouchError, type SolidOptions } from "foretouch";
import { type EngineLike, SceneWorld, type SceneWorldOptions, type Shown } from "foretouch/host";
import { handSource } from "./hand.js";
import { three } from "./host.js";
import { nameOf } from "./objects.js";
import { Body, Hand, type HandSpace, Rigid, threes, type Touches, type Toucher } from "./touchers.js";

export type WorldOptions = SceneWorldOptions<Object3D>;

/** Reports every touch once, from its first side; what was added gets its own ones. */
export class TouchWorld extends EventDispatcher<Touches> {
  private readonly scene: SceneWorld<Object3D>;

  /** `library`: Foretouch, or its engine in a worker. `still`: what stands still, with all below it but what is added. */
  constructor(library: Foretouch | EngineLike, still: Object3D | null, options: WorldOptions = {}) {
    super();
    this.scene = new SceneWorld(library, three, still, (touch) => this.dispatchEvent(threes(touch)), options);
  }

  /** What stands still is another object, or has changed: the next update reads it anew and begins anew. */
  stand(still?: Object3D | null): void {
    this.scene.stand(still);
  }

  /** Something that moves as a whole, as your code moves it, with the meshes below it. */
  addMoving(object: Object3D, options: BodyOptions = {}): Rigid {
    const rigid = new Rigid(object);
    rigid.member = this.scene.addMoving(object, rigid.tell, options);
    return rigid;
  }

  /** A SkinnedMesh, or a tree with such, whose bones your code moves. `shown`: a copy of it (SkeletonUtils.clone() makes one) that follows and passes through nothing. */
  async addBody(mesh: Object3D, options: SolidOptions & BodyOptions & Shown<Object3D> = {}): Promise<Body> {
    const body = new Body(mesh, this.scene);
    await this.scene.addBody(mesh, body.tell, (member) => (body.member = member), options);
    return body;
  }

  /** A hand of WebXR, solid: renderer.xr.getHand(0). Its size is that of the first frame in which all its joints are tracked. */
  addHand(space: Object3D, options: SolidOptions & BodyOptions = {}): Hand {
    if (!("joints" in space)) throw new ForetouchError(`${nameOf(space)}: expected a hand, renderer.xr.getHand(0)`);
    const hand = new Hand(space, this.scene);
    this.scene.addJoints(handSource(space as HandSpace, hand), { liftsFeet: false, ...options }, (member) => (hand.member = member), space, hand.shown);
    return hand;
  }

  /** Removes it: it is in nothing's way, and hears nothing more. */
  remove({ object }: Toucher): void {
    this.scene.remove(object);
  }

  /** From now on the joint carries it, as it is there; until letGo(), or a gap. */
  hold({ member }: Rigid, by: Body, joint: string): void {
    if (member !== null) this.scene.hold(member, by.member, joint);
  }

  letGo({ member }: Rigid): void {
    if (member !== null) this.scene.letGo(member);
  }

  /** Once per frame, with its time in milliseconds, before it is rendered. A promise where the engine is in a worker; there is no need to wait for it. */
  update(timeMs: number): void | Promise<void> {
    return this.scene.update(timeMs);
  }

  /** After a teleport: nothing between the last update and the next one is swept. */
  restart(): void {
    this.scene.restart();
  }

  dispose(): void {
    this.scene.dispose();
  }
}
