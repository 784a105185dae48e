// What the view shows right now, in one sentence above it: never over what it speaks of.

import type { Contact } from "../contacts/contact.js";
import { discreteCount } from "../contacts/discrete.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { element, setText } from "./dom.js";
import { count, plural, story, storyOfRay, storyOfTouch } from "./words.js";

export class Caption {
  readonly node = element("p", { class: "caption" });

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.node.setAttribute("role", "status");
    this.update();
  }

  update(): void {
    const { showsDiscrete } = this.store.state, isChecking = showsDiscrete && this.ofCheck() !== "";
    setText(this.node, isChecking ? this.ofCheck() : this.ofInstant());
    this.node.dataset["kind"] = isChecking ? "check" : "instant";
  }

  private ofInstant(): string {
    const { contact, touch, ray, time, place, follows, refusal } = this.store.state, { model } = this;
    if (contact !== null && (touch === null || touch.rows[0] === contact || !model.knowsTouches)) return story(contact, model.timeZero);
    if (touch !== null) return storyOfTouch(touch, model.timeZero);
    if (ray !== null && ray.time === time) return storyOfRay(ray, model.timeZero);
    const clip = model.clips[0];
    const isAnswered = clip === undefined || clip.start === clip.end || clip.instantAt(time).step >= 0;
    if (!isAnswered && !model.isLive) return "Not answered: no step covers this instant. The avatar holds its last pose.";
    if (model.document.kind === "world" && model.document.touches === null) return worldHint;
    if (model.document.kind === "inspection") return refusal ?? (place === null ? inspectionHint : turningHint);
    return model.isLive ? (follows ? "Following the stream." : "Looking back: Live follows the stream again.") : hint;
  }

  private ofCheck(): string {
    const { contact, touch } = this.store.state;
    if (this.model.knowsTouches) {
      const { all, missed } = this.model.countTouches();
      const fate = touch === null || touch.isMissed === null ? "" : touch.isMissed ? " It misses the chosen one." : " It sees the chosen one.";
      return all === 0 ? "" : `A check of the poses alone sees ${count(all - missed)} of ${plural(all, "touch", "touches")}.${fate}`;
    }
    const discrete = discreteCount(this.model.contacts);
    return discrete === null ? "" : `A check of the poses alone sees ${discrete.seen} of ${discrete.all} contacts.${fateOf(contact)}`;
  }
}

const hint = "Choose a touch on the timeline, in the view or in the table; ] goes to the next one. A click in the view casts a ray.";
const worldHint = "How the bodies move. `foretouch world replay --report` shows who touches whom.";
const inspectionHint = "Click a floor to put the body there.";
const turningHint = "Click where the body is to look; the place to copy is beside the view.";

/** Whether the chosen contact is among those that a check of the poses sees. */
function fateOf(contact: Contact | null): string {
  if (contact === null || contact.missedByPoses === null) return "";
  return contact.missedByPoses ? " It misses the chosen one." : " It sees the chosen one.";
}
