// Places the body by clicks on the floor: the first says where it stands, the next ones where it
// looks.

import type { Vector } from "../data/document.js";
import type { Model } from "../model.js";
import { placeWith, wrapped, yawTowards } from "../motion/placing.js";
import type { Store } from "../state.js";
import { facingOf, footOf } from "./bounds.js";
import type { Performer } from "./performer.js";

/** What looks up less than this is no floor: the cosine of 45 degrees. */
const floorCosine = 0.7;
/** A click nearer to the feet than this turns nothing, metres. */
const underFoot = 0.15;

/** Why a click puts the body nowhere. */
const noScene = "Nothing of the scene is there: the grid is no floor, it only shows metres. Click a floor of the scene.";
const tooSteep = "Nobody stands there: it is a wall, a ceiling or too steep. Click a floor.";

export class Placing {
  /** Where the feet are to stand; null before the first click. */
  private feet: Vector | null = null;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
    private readonly performers: readonly Performer[],
  ) {
    store.subscribe((changes) => {
      if (changes.has("place") && store.state.place === null) this.feet = null;
    });
  }

  /** What the click hit; null: nothing of the scene. Whether it says something about the place: one on a floor does. */
  click(met: { readonly at: Vector; readonly upwards: number } | null): boolean {
    const performer = this.performers[0];
    const isFloor = met !== null && met.upwards >= floorCosine;
    if (performer === undefined || !performer.clip.hasPose) return false;
    this.store.set({ refusal: isFloor ? null : met === null ? noScene : tooSteep });
    if (!isFloor) return false;
    const { at } = met;
    const { avatar, posture } = performer, now = this.model.place;
    const held = footOf(avatar, posture.world);
    const { place } = this.store.state;
    if (place === null || this.feet === null) {
      this.feet = at;
      this.store.set({ place: placeWith(now, held, at, now.yawDegrees), link: null });
      return true;
    }
    const towards: Vector = [at[0] - this.feet[0], 0, at[2] - this.feet[2]];
    if (Math.hypot(towards[0], towards[2]) < underFoot) return true;
    const turn = yawTowards(towards) - yawTowards(facingOf(avatar, posture.world));
    this.store.set({ place: placeWith(now, held, this.feet, wrapped(now.yawDegrees + turn)) });
    return true;
  }
}
