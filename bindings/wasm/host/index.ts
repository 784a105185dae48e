// What engines and scene graphs for JavaScript share: three.js' and Babylon.js' integrations are made of
// it, and another host can be. Plain arrays in, records out.

export { Engine, type EngineLike } from "./engine.js";
export { type Far, FarEngine } from "./far_engine.js";
export { type Frames, framesOf, localPose, type Matrix, mirrored, poseRoom, RigidPart, worldFrames } from "./frames.js";
export { gathered, type Gathered, type HostMesh, type Note } from "./geometry.js";
export { BodyLines, linesOfPresses } from "./lines.js";
export { JointMember, type JointSource, Member, RigidMember, type RigidSource, stateOf } from "./members.js";
export { type Host, SceneWorld, type SceneWorldOptions, type Shown, type Skinned } from "./scene_world.js";
export { serve } from "./serve.js";
export { fitted, type HostBone, type HostSkin, readRig, type Rig, rigOf } from "./skin.js";
export { TouchWorld, type TouchWorldOptions } from "./touch_world.js";
export { type Press, type Touch, type TouchCause } from "./touches.js";
export { type HandFrame, type HandSource, handJoints, moveHand, readHand, sourceOfHand, type TrackedHand, usualRadius } from "./webxr_hand.js";
