// The keys, in a dialogue.

import { button, element } from "./dom.js";

const keys: readonly (readonly [string, string])[] = [
  ["space", "play or pause"],
  ["← →", "a fiftieth of a step; with shift, to the next pose"],
  ["[ ]", "previous, next contact"],
  ["− +", "slower, faster"],
  ["D", "what a discrete check would have seen"],
  ["G", "ghosts: the pose before, the pose asked for"],
  ["S", "swept volume"],
  ["L", "LSS or meshes"],
  ["C", "cut away what hides the avatar"],
  ["T", "track: the camera goes along with the avatar"],
  ["F", "frame the contact, or everything"],
  ["Esc", "choose nothing"],
  ["?", "this help"],
];

export class Help {
  readonly node = element("dialog", { class: "help", label: "Keys" });

  constructor() {
    const list = element("dl");
    for (const [key, meaning] of keys) list.append(element("dt", { text: key }), element("dd", { text: meaning }));
    const pointer = "Drag turns the view, with the right button or two fingers it moves; wheel or pinch zooms. Click a link, a contact or a bar of the timeline to choose it.";
    this.node.append(element("h2", { text: "Keys" }), list, element("p", { text: pointer }), button("Close", "Close", () => this.node.close()));
    document.body.append(this.node);
  }

  toggle(): void {
    if (this.node.open) this.node.close();
    else this.node.showModal();
  }
}
