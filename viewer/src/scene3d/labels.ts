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

  place(): void {
    for (const { label, node } of this.shown) {
      const at = this.stage.screenOf(label.at);
      node.hidden = at === null;
      if (at === null) continue;
      // Beside its point, but never beyond the right edge.
      const x = Math.min(at[0], this.layer.clientWidth - node.offsetWidth - edge);
      node.style.transform = `translate(${x.toFixed(1)}px, ${at[1].toFixed(1)}px)`;
    }
  }
}
