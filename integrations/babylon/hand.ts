// A hand of WebXR, as the session's frames have it.

import type { Camera, Nullable, WebXRSessionManager } from "@babylonjs/core";
import { ForetouchError } from "foretouch";
import { framesOf, type JointSource, moveHand, readHand, RigidPart, sourceOfHand } from "foretouch/host";
import type { Thing } from "./objects.js";
import type { Hand } from "./touchers.js";

/** WebXRExperienceHelper (xr.baseExperience) has it all. */
export interface Experience {
  readonly sessionManager: Pick<WebXRSessionManager, "currentFrame" | "referenceSpace" | "session">;
  /** What its parent does, the hands do: a platform, a vehicle. */
  readonly camera?: Nullable<Pick<Camera, "parent">>;
}

export function handSource({ sessionManager, camera = null }: Experience, handedness: "left" | "right", hand: Hand): JointSource<Thing> {
  const name = `The ${handedness} hand`;
  let rig: RigidPart | null = null;
  return sourceOfHand<Thing>(hand.object, name, (tracked) => {
    const { currentFrame: frame, referenceSpace, session } = sessionManager;
    const source = frame ? Array.from(session?.inputSources ?? []).find((one) => one.handedness === handedness && one.hand) : undefined;
    if (!frame || source === undefined || !readHand(frame, source, referenceSpace, tracked)) return false;
    const above = camera?.parent ?? null;
    if (above === null) return true;
    const matrix = above.computeWorldMatrix(true).asArray(), frames = framesOf(1);
    rig ??= new RigidPart(name, matrix, hand.mirror);
    if (rig.scale === null || !rig.read(matrix, frames, 0)) throw new ForetouchError(`${name}: the camera's parent is scaled unevenly, or its scale has changed; expected one scale that stays`);
    moveHand(tracked, frames, rig.scale);
    return true;
  }, (frames, radii) => hand.show(frames, radii), hand.tell);
}
