// What is added to a world: it reports what it touches by observables.

import type { Scene } from "@babylonjs/core";
import { Quaternion, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { TransformNode } from "@babylonjs/core/Meshes/transformNode.js";
import { Observable } from "@babylonjs/core/Misc/observable.js";
import type { SolidBodyTick, SolidState } from "foretouch";
import { type Frames, handJoints, type JointMember, type Press, type RigidMember, type SceneWorld, stateOf, type Touch as HostTouch, usualRadius } from "foretouch/host";
import type { Thing } from "./objects.js";

/** A touch: `object` is what is touched. */
export type Touch = Omit<HostTouch<Thing>, "point" | "normal"> & {
  /** On the surface of the one that it is reported to. */
  readonly point: Vector3;
  /** Unit, from the other to it. */
  readonly normal: Vector3;
};
/** Where a surface holds or pushes a solid body. */
export type Pressing = Omit<Press<Thing>, "point" | "normal"> & { readonly point: Vector3; readonly normal: Vector3 };

const placed = <T extends { readonly point: ArrayLike<number>; readonly normal: ArrayLike<number> }>(told: T) => ({ ...told, point: Vector3.FromArray(told.point), normal: Vector3.FromArray(told.normal) });

/** What reports touches. */
export class Teller {
  readonly onEnterObservable = new Observable<Touch>();
  readonly onLeaveObservable = new Observable<Touch>();
  /** It touches something where the two are known first. */
  readonly onStartsInsideObservable = new Observable<Touch>();
  /** From or to where nothing is claimed. */
  readonly onUnresolvedObservable = new Observable<Touch>();

  /** For the classes beside this one. */
  readonly tell = (touch: HostTouch<Thing>): void => {
    const by = touch.kind === "enter" ? this.onEnterObservable : touch.kind === "leave" ? this.onLeaveObservable : touch.kind === "starts_inside" ? this.onStartsInsideObservable : this.onUnresolvedObservable;
    if (by.hasObservers()) by.notifyObservers(placed(touch));
  };

  dispose(): void {
    for (const by of [this.onEnterObservable, this.onLeaveObservable, this.onStartsInsideObservable, this.onUnresolvedObservable]) by.clear();
  }
}

export class Toucher extends Teller {
  constructor(readonly object: Thing) {
    super();
  }
}

/** What moves as a whole. */
export class Rigid extends Toucher {
  /** For the classes beside this one. */
  member: RigidMember<Thing> | null = null;
}

/** Something with joints. */
export class Body extends Toucher {
  /** For the classes beside this one. */
  member: JointMember<Thing> | null = null;

  constructor(
    object: Thing,
    private readonly world: SceneWorld<Thing>,
  ) {
    super(object);
  }

  /** How a solid one is, as of the last update. */
  get tick(): SolidBodyTick | null {
    return this.member?.tick ?? null;
  }

  /** "held", "sliding", "equal" and so on; null: it is not solid, or has not been seen yet. */
  get state(): SolidState | null {
    return this.tick === null ? null : stateOf(this.tick);
  }

  /** Where surfaces hold or push it. */
  get presses(): Pressing[] {
    return this.member === null ? [] : this.world.presses(this.member).map(placed);
  }

  /** For the classes beside this one. */
  get mirror(): 1 | -1 {
    return this.world.host.mirror;
  }
}

/** A hand of WebXR that passes through nothing. */
export class Hand extends Body {
  /** A node per joint, by WebXR's names, where nothing is in its way: parent your meshes to them. */
  readonly joints: Readonly<Record<string, TransformNode>>;
  readonly root: TransformNode;
  /** Each joint's radius, metres. */
  readonly radii = new Map<string, number>();

  constructor(scene: Scene, world: SceneWorld<Thing>, handedness: string) {
    const root = new TransformNode(`${handedness} hand`, scene);
    super(root, world);
    this.root = root;
    root.setEnabled(false);
    this.joints = Object.fromEntries(handJoints.map(({ name }) => {
      const node = new TransformNode(name, scene);
      node.parent = root;
      node.rotationQuaternion = Quaternion.Identity();
      return [name, node];
    }));
  }

  /** For the classes beside this one. */
  show({ rotations: r, places }: Frames, radii: Float64Array): void {
    const m = this.mirror;
    if (!this.root.isEnabled(false)) this.root.setEnabled(true);
    handJoints.forEach(({ name }, joint) => {
      const { position, rotationQuaternion } = this.joints[name], q = 4 * joint, p = 3 * joint;
      position.set(places[p], places[p + 1], m * places[p + 2]);
      rotationQuaternion?.set(m * r[q + 1], m * r[q + 2], r[q + 3], r[q]);
      this.radii.set(name, radii[joint] ?? usualRadius);
    });
  }
}
