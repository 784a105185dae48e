// The page's own words, each in one line: shown where the pointer rests on the word.

const meanings: Readonly<Record<string, string>> = {
  "verdict": "What the query says of the link in this step: contact, starts in contact, or undecided.",
  "missed by poses": "Contacts between two poses at neither of which the link touches anything: who checks the poses alone never sees them.",
  "starts in contact": "The link touches already when the step begins: it goes on from the step before.",
  "rigid model misses": "Contacts that are not found if each link's own two poses are joined without regard to the joints above it.",
  "LSS": "Line swept sphere: all points within a radius of a segment, a capsule. Links are covered by them.",
  "pose asked for": "The pose that the step leads to.",
  "pose before": "The pose that the step begins with.",
  "time of impact": "When in the step the link first touches: 0 is the pose before, 1 the pose asked for.",
  "separation": "How far apart link and scene are where the contact is reported: at most the tolerance.",
  "penetration": "How deep the link is in the scene when the step begins.",
  "normal": "Direction of length 1 from the scene to the link, where they are nearest.",
  "free until": "Up to here it is proven that the link touches nothing.",
  "undecided": "The step's budget ended before it was known; what is said before is proven.",
  "advancements": "How often the query moved a link on by a distance that is proven free.",
  "candidates": "Triangles near enough to a moving link to be looked at closely.",
  "steps": "Motions from one pose to the next that were asked.",
  "steps with contact": "Steps in which some link touches something.",
  "contacts": "Links that touch something within a step, counted step by step.",
  "touches": "A link and an object from the first contact to where it ends, however many steps that takes.",
  "touches missed": "Touches in which no pose lies: who checks the poses alone never sees them.",
  "ground": "Touches of the feet and whatever else stands on a floor.",
  "latency of a step": "Time of one query, from two poses to all verdicts.",
  "p50": "Half of all are at most this.",
  "p99": "99 in 100 are at most this.",
  "swept volume": "All the space that the link covers during the step, in a surface that is proven to contain it.",
  "tolerance": "How near counts as contact, metres.",
  "fidelity": "What touches: the links' capsules (link), their meshes (exact), the skin, or coarser bodies.",
  "query p50": "Half of all queries took at most this, from two poses to all verdicts.",
  "query p99": "99 in 100 queries took at most this, from two poses to all verdicts.",
  "answer p50": "Half of all answers were out this long after their pose came in.",
  "answer p99": "99 in 100 answers were out this long after their pose came in.",
  "gaps": "Places in the stream where poses were lost.",
  "rejected": "Messages that were no valid poses.",
  "waiting": "Poses that came in and are not answered yet.",
  "viewers": "Pages that watch this stream.",
  "seen at poses": "Contacts that a check of the poses alone reports, too.",
};

/** "" where the page has nothing to say. */
export function meaningOf(word: string): string {
  return meanings[word] ?? meanings[word.toLowerCase()] ?? meanings[word.replaceAll("_", " ")] ?? "";
}
