// Words beside points of the 3D view: HTML above the canvas, moved before every frame.

import type * as THREE from "three";
import { element } from "../panels/dom.js";
import type { Stage } from "./stage.js";

/** Room that a label's own margin needs, CSS pixels. */
const edge = 18;

export interface Label {
  readonly text: string;
  readonly kind: "callout" | "dimension" | "axis";
  /** In the view's coordinates. */
  readonly at: THREE.Vector3;
}

/** What a label takes of the layer, CSS pixels. */
interface Room {
  readonly left: number;
  readonly right: number;
  top: number;
  readonly height: number;
}

export class Labels {
  private readonly layer = element("div", { class: "labels" });
  private shown: { label: Label; node: HTMLElement }[] = [];

  constructor(
    private readonly stage: Stage,
    host: HTMLElement,
  ) {
    this.layer.setAttribute("aria-hidden", "true");
    host.append(this.layer);
  }

  set(labels: readonly Label[]): void {
    this.layer.replaceChildren();
    this.shown = labels.map((label) => {
      const node = element("div", { class: `label ${label.kind}`, text: label.text });
      this.layer.append(node);
      return { label, node };
    });
  }

  /** Each beside its point, but never beyond the edges, and below those that stand there. */
  place(): void {
    const { clientWidth, clientHeight } = this.layer, taken: Room[] = [];
    for (const { label, node } of this.shown) {
      const at = this.stage.screenOf(label.at);
      node.hidden = at === null || at[0] < 0 || at[0] > clientWidth || at[1] < 0 || at[1] > clientHeight;
      if (at === null || node.hidden) continue;
      const { offsetWidth: width, offsetHeight: height } = node;
      const left = Math.min(at[0], clientWidth - width - edge);
      const room = { left, right: left + width, top: Math.min(at[1], clientHeight - height), height };
      for (const other of taken) {
        const isMet = room.left < other.right && other.left < room.right && Math.abs(room.top - other.top) < Math.max(height, other.height);
        if (isMet) room.top = other.top + other.height;
      }
      taken.push(room);
      taken.sort((a, b) => a.top - b.top);
      node.style.transform = `translate(${room.left.toFixed(1)}px, ${room.top.toFixed(1)}px)`;
    }
  }
}
