// Time of a live view: runs with the clock, never past the latest step, and catches up at once
// where it has fallen behind.

/** Further behind than this is caught up with, seconds. */
const maxBehind = 0.5;

/** The time to show `elapsed` seconds after `shown`, when the stream has come to `latest`. */
export function followed(shown: number, elapsed: number, latest: number, lastStep: number): number {
  const next = Math.min(latest, shown + elapsed);
  const isOff = latest - next > Math.max(maxBehind, 2 * lastStep) || shown > latest;
  return isOff ? latest - Math.min(lastStep, maxBehind) : next;
}
