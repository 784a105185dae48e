// The keys, in a dialogue.

import { button, element } from "./dom.js";

const keys: readonly (readonly [string, string])[] = [
  ["space", "play or pause"],
  ["← →", "a fiftieth of a step; with shift, to the next pose"],
  ["Home End", "first and last pose"],
  ["[ ]", "previous, next touch"],
  ["{ }", "previous, next contact of a single step"],
  ["− +", "slower, faster"],
  ["D", "check | truth: what a check of the poses alone sees, beside what happened"],
  ["G", "ghosts: the pose before, the pose asked for"],
  ["S", "swept volume"],
  ["L", "capsules (LSS) or meshes"],
  ["C", "cut away what hides the body"],
  ["T", "track: the camera goes along with the body"],
  ["F", "frame the contact, or the body; with shift, everything"],
  ["/", "search links and objects"],
  ["Esc", "choose nothing"],
  ["?", "this help"],
];

export class Help {
  readonly node = element("dialog", { class: "help", label: "Keys" });

  constructor() {
    const list = element("dl");
    for (const [key, meaning] of keys) list.append(element("dt", { text: key }), element("dd", { text: meaning }));
    const pointer = "Drag turns the view, with the right button or two fingers it moves; wheel or pinch zooms. Click a link, a contact or a bar of the timeline to choose it. On the timeline the wheel zooms at the pointer, with shift it moves.";
    this.node.append(element("h2", { text: "Keys" }), list, element("p", { text: pointer }), button("Close", "Close", () => this.node.close()));
    document.body.append(this.node);
  }

  toggle(): void {
    if (this.node.open) this.node.close();
    else this.node.showModal();
  }
}
