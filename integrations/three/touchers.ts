// What is added to a world: it hears what it touches.

import { EventDispatcher, Group, type Object3D, Vector3 } from "three";
import type { Point, SolidBodyTick, SolidState } from "foretouch";
import { type Frames, handJoints, type JointMember, type Press, type RigidMember, stateOf, type SceneWorld, type Touch as HostTouch, usualRadius } from "foretouch/host";

/** A touch, as its listeners have it: `object` is what is touched. */
export type Touch = Omit<HostTouch<Object3D>, "kind" | "point" | "normal"> & {
  /** On the surface of the one that it is reported to. */
  readonly point: Vector3;
  /** Unit, from the other to it. */
  readonly normal: Vector3;
};
export type Touches = { [K in HostTouch<Object3D>["kind"]]: Touch };
/** Where a surface holds or pushes a solid body. */
export type Pressing = Omit<Press<Object3D>, "point" | "normal"> & { readonly point: Vector3; readonly normal: Vector3 };

const placed = <T extends { readonly point: Point; readonly normal: Point }>(told: T) => ({ ...told, point: new Vector3(...told.point), normal: new Vector3(...told.normal) });
export const threes = ({ kind, ...touch }: HostTouch<Object3D>): Touch & { readonly type: HostTouch<Object3D>["kind"] } => ({ ...placed(touch), type: kind });

/** "enter", "leave", "starts_inside", "unresolved_from", "unresolved_to". */
export class Toucher extends EventDispatcher<Touches> {
  /** For the classes beside this one. */
  readonly tell = (touch: HostTouch<Object3D>): void => this.dispatchEvent(threes(touch));

  constructor(readonly object: Object3D) {
    super();
  }
}

/** What moves as a whole. */
export class Rigid extends Toucher {
  /** For the classes beside this one. */
  member: RigidMember<Object3D> | null = null;
}

/** Something with joints. */
export class Body extends Toucher {
  /** For the classes beside this one. */
  member: JointMember<Object3D> | null = null;

  constructor(
    object: Object3D,
    private readonly world: SceneWorld<Object3D>,
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
}

/** As renderer.xr.getHand() has it. */
export type HandSpace = Object3D & { readonly joints: Partial<Record<string, Object3D & { jointRadius?: number | undefined }>> };

/** A hand of WebXR that passes through nothing. */
export class Hand extends Body {
  /** Put it into your scene. Its `joints` are as those of renderer.xr.getHand(), where nothing is in their way. */
  readonly shown: Group & { readonly joints: Record<string, Group & { jointRadius: number }> };

  constructor(object: Object3D, world: SceneWorld<Object3D>) {
    super(object, world);
    const joints = Object.fromEntries(handJoints.map(({ name }) => [name, Object.assign(new Group(), { name, jointRadius: usualRadius })]));
    this.shown = Object.assign(new Group(), { joints, visible: false });
    this.shown.add(...Object.values(joints));
  }

  /** For the classes beside this one. */
  show({ rotations, places }: Frames, radii: Float64Array): void {
    this.shown.visible = true;
    handJoints.forEach(({ name }, joint) => {
      const group = this.shown.joints[name], q = 4 * joint;
      group.position.fromArray(places, 3 * joint);
      group.quaternion.set(rotations[q + 1], rotations[q + 2], rotations[q + 3], rotations[q]);
      group.jointRadius = radii[joint];
    });
  }
}
