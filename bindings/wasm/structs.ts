// The structs of the C interface that JavaScript writes and reads: field by field as its headers
// have them, in camelCase, against which tests/structs.test.mjs holds them.

import { Struct } from "./machine.js";

const size = "u32", i32 = "i32", u32 = "u32", i64 = "i64", u64 = "u64", f64 = "f64", point = "point", pointer = "pointer";

// foretouch.h

export const ft_scene_arrays = new Struct({
  size, reserved: u32, positions: pointer, vertexCount: u32, indices: pointer, triangleCount: u32, objects: pointer, objectNames: pointer, objectCount: u32,
});
export const ft_pose = new Struct({ size, jointCount: u32, rotations: pointer, translations: pointer });
export const ft_clip_info = new Struct({ size, matchedJoints: i32, frameCount: u64, frameTimeS: f64 });
export const ft_query_options = new Struct({
  size, fidelity: i32, tolerance: f64, workBudget: u64, deadlineUs: f64, scope: i32, reserved: i32, ignored: pointer, ignoredCount: u32,
  policies: pointer, policyCount: u32, objectPolicies: pointer, objectPolicyCount: u32, passSeparating: i32, reservedEnd: i32,
});
export const ft_contact = new Struct({
  size, link: i32, verdict: i32, reason: i32, toi: f64, freeUntil: f64, separation: f64, penetration: f64, pointScene: point, pointLink: point,
  normal: point, triangle: i32, object: i32, lss: i32, linkTriangle: i32, linkFeature: i32, sceneFeature: i32,
});

// solid.h

export const ft_solid_options = new Struct({
  size, floor: i32, skin: f64, tolerance: f64, catchUp: f64, up: point, mostLift: f64, mostDeviation: f64, mostLimbDeviation: f64, patience: f64,
  snapNotice: f64, placingReach: f64, maySnap: i32, aroundPerTick: i32, aroundInAll: i32, reserved: i32, workBudget: u64, visibility: pointer,
  visibilityCount: u32, feet: pointer, feetCount: u32, ignored: pointer, ignoredCount: u32, self: pointer,
});
export const ft_solid_tick = new Struct({
  size, state: i32, limit: i32, isCertified: i32, hasAppeared: i32, reserved: i32, deviation: f64, lift: f64, clearance: f64, snapInS: f64,
  jointCount: u64, contactCount: u64, wayCount: u64, queries: u32, iterations: u32, features: u32, rows: u32, aroundQueries: u32,
  placingQueries: u32, work: u64,
});
export const ft_solid_joint = new Struct({ size, state: i32, deviation: f64 });
export const ft_solid_contact = new Struct({
  size, link: i32, lss: i32, triangle: i32, object: i32, other: i32, point, normal: point, gap: f64, push: f64, slipSpeed: f64,
});

// person.h

export const ft_link_bound = new Struct({
  error: f64, acceleration: f64, followFloor: f64, followShare: f64, speed: f64, aheadSpeed: f64, aheadAcceleration: f64,
});
export const ft_bracket_options = new Struct({ size, fidelity: i32, resolution: f64, ignored: pointer, ignoredCount: u32, self: pointer, workBudget: u64 });
export const ft_posed_step = new Struct({
  size, between: i32, before: pointer, from: pointer, to: pointer, after: pointer, secondsBefore: f64, seconds: f64, secondsAfter: f64,
});
export const ft_link_bracket = new Struct({
  size, link: i32, other: i32, verdict: i32, triangle: i32, object: i32, possibleFrom: f64, possibleUntil: f64, certainFrom: f64, certainUntil: f64,
  growth: f64,
});

// world.h

export const ft_world_options = new Struct({ size, asksMeshes: i32, tolerance: f64, workPerPair: u64, workPerWindow: u64, mostNear: u64 });
export const ft_body_options = new Struct({ size, group: i32, whenSilent: i32, fidelity: i32, self: pointer });
export const ft_carrier = new Struct({ size, body: i32, link: i32, movesInFrame: i32 });
export const ft_world_side = new Struct({ body: i32, link: i32, lss: i32, triangle: i32, object: i32, reserved: i32, point });
export const ft_world_contact = new Struct({
  size, verdict: i32, reason: i32, isAssumed: i32, timeUs: i64, timeFraction: f64, separation: f64, penetration: f64, normal: point,
  a: ft_world_side, b: ft_world_side,
});
export const ft_silent_body = new Struct({ size, body: i32, sinceUs: i64, takenTo: i32, reserved: i32 });
export const ft_world_counters = new Struct({
  size, reserved: u32, bodies: u64, pairs: u64, nearPairs: u64, spans: u64, nodes: u64, leaves: u64, candidates: u64, clusterSteps: u64,
  laneSteps: u64, partSteps: u64, advancements: u64, hierarchyTests: u64, planeTests: u64, leafTests: u64, states: u64, rungTests: u64,
});

// events.h

export const ft_follow_options = new Struct({ size, threads: i32, cutUs: i64 });
export const ft_event_point = new Struct({ pointA: point, pointB: point, separation: f64 });
export const ft_event = new Struct({
  size, kind: i32, cause: i32, reason: i32, timeUs: i64, timeFraction: f64, sinceUs: i64, sinceFraction: f64, separation: f64, penetration: f64,
  normal: point, velocity: point, approachSpeed: f64, approachLower: f64, approachUpper: f64, effectiveMass: f64, a: ft_world_side, b: ft_world_side,
  isAssumed: i32, pointCount: i32, points0: ft_event_point, points1: ft_event_point, points2: ft_event_point, points3: ft_event_point,
});
export const ft_part = new Struct({
  size, isContact: i32, reason: i32, isAssumed: i32, beganBefore: i32, goesOn: i32, fromUs: i64, fromFraction: f64, toUs: i64, toFraction: f64,
  sinceUs: i64, sinceFraction: f64, a: ft_world_side, b: ft_world_side,
});

// triggers.h

export const ft_trigger_options = new Struct({ size, group: i32, whenSilent: i32, byLink: i32 });
export const ft_trigger_event = new Struct({
  size, kind: i32, trigger: i32, body: i32, link: i32, isAssumed: i32, timeUs: i64, timeFraction: f64, sinceUs: i64, sinceFraction: f64,
});
export const ft_occupant = new Struct({
  size, trigger: i32, body: i32, link: i32, isUnresolved: i32, reserved: i32, sinceUs: i64, sinceFraction: f64,
});
export const ft_depth_question = new Struct({
  size, body: i32, link: i32, fromBody: i32, fromLink: i32, reserved: i32, timeUs: i64, timeFraction: f64,
});
export const ft_depth = new Struct({
  size, isCertified: i32, lower: f64, upper: f64, wayOut: point, pairCount: i32, isAssumed: i32, link: i32, lss: i32, fromLink: i32, fromLss: i32,
  fromTriangle: i32, reserved: i32,
});

// ask.h

export const ft_skin = new Struct({
  size, reserved: u32, vertexCount: u32, firstShare: pointer, shareLinks: pointer, shareWeights: pointer, sharePoints: pointer, triangles: pointer,
  triangleLinks: pointer, triangleCount: u32,
});
export const ft_lss = new Struct({ a: point, b: point, radius: f64 });
export const ft_ask_part = new Struct({ body: i32, link: i32, object: i32 });
export const ft_ask_instant = new Struct({ body: i32, reserved: i32, timeUs: i64, timeFraction: f64 });
export const ft_ask_whom = new Struct({
  size, groups: u32, asksStill: i32, reserved: i32, only: pointer, onlyCount: u32, without: pointer, withoutCount: u32,
});
export const ft_question = new Struct({
  size, what: i32, which: i32, reserved: i32, shape: ft_lss, direction: point, reach: f64, timeUs: i64, timeFraction: f64, whom: pointer,
  instants: pointer, instantCount: u32, hull: pointer, hullCount: u32, solids: i32, reservedEnd: i32,
});
export const ft_world_hit = new Struct({ size, isAssumed: i32, what: ft_world_side, distance: f64, normal: point, weights: point });
export const ft_unknown_body = new Struct({ size, body: i32, why: i32, object: i32 });
export const ft_probed = new Struct({ verdict: i32, hitCount: u32, unknownCount: u32, reserved: i32 });
export const ft_flight = new Struct({
  size, reserved: u32, shape: ft_lss, way: point, fromUs: i64, toUs: i64, whom: pointer, hull: pointer, hullCount: u32,
});
export const ft_flight_hit = new Struct({
  size, verdict: i32, timeUs: i64, timeFraction: f64, isAssumed: i32, reserved: i32, what: ft_world_side, distance: f64, normal: point, weights: point,
});

// solid_world.h

export const ft_solid_target = new Struct({ body: i32, reserved: i32, pose: pointer, isTracked: pointer });
export const ft_solid_body_contact = new Struct({
  size, body: i32, link: i32, lss: i32, triangle: i32, object: i32, point, normal: point, gap: f64, push: f64, slipSpeed: f64,
});
export const ft_solid_crush = new Struct({ size, body: i32, link: i32, isOver: i32, sinceUs: i64, depth: f64 });
export const ft_solid_held = new Struct({ size, body: i32, state: i32, reserved: i32 });

// foretouch_wasm.cpp

export const ftw_swept = new Struct({ vertexCount: u32, triangleCount: u32, positions: pointer, indices: pointer });
