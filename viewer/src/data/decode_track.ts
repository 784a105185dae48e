import type { TouchingAtPoses, Track } from "./document.js";
import type { Reader } from "./reader.js";
import { normalise } from "../motion/quaternion.js";

/** What rounding may have done to a unit quaternion on its way here; beyond it is corruption. */
const maxNormError = 1e-3;

export function decodeTrack(reader: Reader, links: number): Track {
  const poseTimes = increasing(reader.field("pose_times"));
  const poses = poseTimes.length;
  const translations = reader.field("translations");
  const moving = (translations.optional("moving")?.items() ?? []).map((item) => item.index(links));
  const values = translations.optional("values");
  if (values === null && moving.length > 0) translations.fail('has no "values" for "moving"');
  const steps = decodeSteps(reader.field("steps"), poses);
  return {
    poseTimes,
    rotations: unitQuaternions(reader.field("rotations"), poses * links),
    offsets: translations.field("offsets").typed("f64", links * 3),
    moving,
    movingValues: values?.typed("f64", poses * moving.length * 3) ?? new Float64Array(),
    ...steps,
    latencyUs: reader.optional("latency_us")?.typed("f64", steps.from.length) ?? null,
    touching: decodeTouching(reader.optional("touching_at_poses"), poses, links),
  };
}

export function increasing(reader: Reader): Float64Array {
  const times = reader.typed("f64");
  for (let i = 1; i < times.length; ++i) {
    if (!(times[i] > times[i - 1])) reader.fail(`does not increase at pose ${i}`);
  }
  return times;
}

/** Made unit to the last bits, as the library does before it moves anything. */
export function unitQuaternions(reader: Reader, count: number): Float64Array {
  const array = reader.typed("f64", count * 4);
  for (let i = 0; i < count; ++i) {
    const error = Math.abs(normalise(array, 4 * i) - 1);
    if (!(error <= maxNormError)) reader.fail(`is no rotation at ${i}`);
  }
  return array;
}

function decodeSteps(reader: Reader, poses: number): { from: Uint32Array; to: Uint32Array } {
  const from = reader.field("from").typedIndices("u32", poses);
  const to = reader.field("to").typedIndices("u32", poses, from.length);
  for (let i = 0; i < from.length; ++i) {
    if (from[i] >= to[i]) reader.fail(`goes from pose ${from[i]} to pose ${to[i]} in step ${i}`);
    if (i > 0 && from[i] < to[i - 1]) reader.fail(`begins step ${i} before the one before it ends`);
  }
  return { from, to };
}

function decodeTouching(
  reader: Reader | null,
  poses: number,
  links: number,
): TouchingAtPoses | null {
  if (reader === null) return null;
  const names = reader.field("links").typedIndices("u16", links);
  const first = reader.field("first").typedIndices("u32", names.length + 1, poses + 1);
  for (let i = 1; i < first.length; ++i) {
    if (first[i] < first[i - 1]) reader.fail(`goes backwards at pose ${i - 1}`);
  }
  return { first, links: names };
}
