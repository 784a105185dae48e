// Buttons and sliders below the view.

import { button, element } from "../../src/panels/dom.js";
import type { Play } from "./play.js";

export interface Choices {
  hand(): void;
  dancer(): void;
  again(): void;
  files(files: FileList): void;
}

export class Controls {
  readonly node = element("div", { class: "play-controls" });
  private readonly time = slider("time of the step");
  private readonly frame = slider("frame of the clip");
  private readonly times = element("label", { class: "slider" });
  private readonly frames = element("label", { class: "slider" });
  private readonly reach: HTMLButtonElement;
  private readonly step: HTMLButtonElement;
  private readonly proof: HTMLButtonElement;
  private readonly swept: HTMLButtonElement;

  constructor(
    private readonly play: Play,
    choices: Choices,
  ) {
    this.reach = button("Reach", "The body is solid, and follows you", () => void play.setMode("reach"));
    this.step = button("Step", "What does it meet between two poses?", () => void play.setMode("step"));
    this.proof = button("Planes", "Planes that part links from what is near", () => void play.see({ proof: !play.now.seesProof }));
    this.swept = button("Swept", "What links sweep until they touch", () => void play.see({ swept: !play.now.seesSwept }));
    this.time.addEventListener("input", () => void play.seek(Number(this.time.value)));
    this.frame.addEventListener("input", () => void play.seekFrame(Number(this.frame.value)));
    this.time.step = "0.001";
    this.times.append(element("span", { text: "from one pose to the other" }), this.time);
    this.frames.append(element("span", { text: "clip" }), this.frame);
    const file = element("input", { label: "Files of your own" });
    file.type = "file";
    file.multiple = true;
    file.id = "file";
    file.accept = ".glb,.gltf,.vrm,.obj,.bvh,.json";
    file.addEventListener("change", () => {
      if (file.files !== null) choices.files(file.files);
    });
    const open = element("label", { class: "file", text: "Your own files ...", title: "A scene (GLB, OBJ), a clip (BVH), an avatar (JSON); they stay in this page" });
    open.append(file);
    const group = (...nodes: HTMLElement[]): HTMLElement => element("div", { class: "group" }, ...nodes);
    this.node.append(
      group(this.reach, this.step),
      group(this.swept, this.proof),
      group(button("Hand", "A hand on its forearm", choices.hand), button("Dancer", "A whole body", choices.dancer), button("Again", "Back to where it began", choices.again), open),
      this.times,
      this.frames,
    );
  }

  update(): void {
    const { play } = this, { mode, time, frame, seesProof, seesSwept } = play.now;
    const isStep = mode === "step", frames = play.body?.frames ?? 0;
    this.reach.setAttribute("aria-pressed", String(!isStep));
    this.step.setAttribute("aria-pressed", String(isStep));
    this.proof.setAttribute("aria-pressed", String(seesProof));
    this.swept.setAttribute("aria-pressed", String(seesSwept));
    this.proof.hidden = this.swept.hidden = this.times.hidden = !isStep;
    this.frames.hidden = frames < 2;
    this.time.value = String(time);
    this.frame.max = String(Math.max(0, frames - 2));
    this.frame.step = "1";
    this.frame.value = String(frame);
  }
}

function slider(label: string): HTMLInputElement {
  const node = element("input", { label });
  node.type = "range";
  node.min = "0";
  node.max = "1";
  return node;
}
