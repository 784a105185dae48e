// What does each link meet first?

import { Held, handleOf, known, type Machine, type Point, pointAt, real, whole } from "./machine.js";
import { Avatar, type PoseLike, Scene, writtenPose } from "./shapes.js";
import * as structs from "./structs.js";

export const verdicts = ["clear", "contact", "starts_in_contact", "undecided"] as const;
export type Verdict = (typeof verdicts)[number];

/** What one link meets first. Sound: toi and freeUntil never exceed the true time of contact. */
export interface Contact {
  readonly link: number;
  readonly verdict: Verdict;
  /** Why a link is undecided: the number that it has in foretouch.h. */
  readonly reason: number;
  /** Time of impact in [0, 1], rounded down; freeUntil if there is no contact. */
  readonly toi: number;
  readonly freeUntil: number;
  readonly separation: number;
  /** For `starts_in_contact`; null if it is not known, as for triangles, which have no inside. */
  readonly penetration: number | null;
  /** The scene's; -1: none. */
  readonly triangle: number;
  readonly object: number;
  /** Which of the link's LSS; -1: none. */
  readonly lss: number;
  readonly pointScene: Point;
  readonly pointLink: Point;
  /** Unit, from the scene to the link. */
  readonly normal: Point;
}

export interface SweptSurface {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
}

const struct = structs.ft_contact;
const [linkAt, verdictAt, reasonAt, toiAt, freeUntilAt] = (["link", "verdict", "reason", "toi", "freeUntil"] as const).map((name) => struct.placeOf(name));
const [separationAt, penetrationAt, triangleAt, objectAt, lssAt] = (["separation", "penetration", "triangle", "object", "lss"] as const).map((name) => struct.placeOf(name));
const [pointSceneAt, pointLinkAt, normalAt] = (["pointScene", "pointLink", "normal"] as const).map((name) => struct.placeOf(name));

/** Field by field: every link has one in every step, and Struct.read() would take longer for them than the step. */
function contactAt(memory: DataView, at: number): Contact {
  return {
    link: memory.getInt32(at + linkAt, true),
    verdict: verdicts[memory.getInt32(at + verdictAt, true)],
    reason: memory.getInt32(at + reasonAt, true),
    toi: memory.getFloat64(at + toiAt, true),
    freeUntil: memory.getFloat64(at + freeUntilAt, true),
    separation: memory.getFloat64(at + separationAt, true),
    penetration: known(memory.getFloat64(at + penetrationAt, true)),
    triangle: memory.getInt32(at + triangleAt, true),
    object: memory.getInt32(at + objectAt, true),
    lss: memory.getInt32(at + lssAt, true),
    pointScene: pointAt(memory, at + pointSceneAt),
    pointLink: pointAt(memory, at + pointLinkAt),
    normal: pointAt(memory, at + normalAt),
  };
}

export class Query extends Held {
  private readonly links: number;

  constructor(machine: Machine, scene: Scene, avatar: Avatar, tolerance: number) {
    super(machine, "query", machine.within((room) => {
      const options = room.options("ft_query_options", structs.ft_query_options, { tolerance });
      return room.answered("ft_query_create", handleOf(scene, Scene, machine, "scene"), handleOf(avatar, Avatar, machine, "avatar"), options);
    }));
    this.links = avatar.links.length;
  }

  /**
   * Answers the motion from one pose to another: every joint turns at constant rate on the shorter
   * arc, translations are linear, links follow down the chain. One contact per link, in order.
   */
  step(from: PoseLike, to: PoseLike): Contact[] {
    return this.machine.within((room) => {
      const begin = writtenPose(room, from, this.links, "from"), end = writtenPose(room, to, this.links, "to");
      this.machine.ask("ft_query_step", this.handle, begin, end);
      return room.listed(struct, contactAt, "ft_query_links", this.handle);
    });
  }

  /** Spans of t of the last step, and planes, that show that a link touches nothing, as `foretouch-verify` reads them; empty if none were found. */
  certificate(link: number): string {
    return this.machine.within((room) => this.machine.text(room.answered("ftw_query_certificate", this.handle, whole(link, "link"))));
  }

  /** A closed surface around all that one LSS sweeps in the last step until `end`, at most `error` metres from it. */
  swept(link: number, lss: number, { end = 1, error = 2e-3 }: { end?: number; error?: number } = {}): SweptSurface {
    return this.machine.within((room) => {
      const at = room.zeroed(structs.ftw_swept);
      this.machine.ask("ftw_query_swept", this.handle, whole(link, "link"), whole(lss, "lss"), real(end, "end"), real(error, "error"), at);
      const { vertexCount, triangleCount, positions, indices } = room.read(structs.ftw_swept, at);
      const { buffer } = this.machine.view();
      return { positions: Float32Array.from(new Float64Array(buffer, positions, 3 * vertexCount)), indices: new Uint32Array(buffer, indices, 3 * triangleCount).slice() };
    });
  }
}
