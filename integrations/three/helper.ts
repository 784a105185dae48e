// What the library takes bodies for, and where they are pressed, drawn as lines.

import { BufferAttribute, BufferGeometry, type ColorRepresentation, Group, LineBasicMaterial, LineSegments } from "three";
import { BodyLines, linesOfPresses } from "foretouch/host";
import type { Body } from "./touchers.js";

/** Put it into your scene, and call update() after the world's. */
export class TouchHelper extends Group {
  private readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly arrows: LineSegments<BufferGeometry, LineBasicMaterial>;
  private capsules: BodyLines | null = null;

  constructor(
    private readonly body: Body,
    color: ColorRepresentation = 0x2266dd,
    pressColor: ColorRepresentation = 0xdd3322,
  ) {
    super();
    [this.lines, this.arrows] = [color, pressColor].map((color) => new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color })));
    for (const lines of [this.lines, this.arrows]) lines.frustumCulled = false;
    this.add(this.lines, this.arrows);
  }

  update(): void {
    const { member } = this.body;
    this.visible = member !== null;
    if (member === null) return;
    if (this.capsules === null) {
      this.capsules = new BodyLines(member.links, 1);
      this.lines.geometry.setAttribute("position", new BufferAttribute(this.capsules.positions, 3));
    }
    this.capsules.update(member.drawn);
    this.lines.geometry.attributes["position"].needsUpdate = true;
    const presses = this.body.presses.map((press) => ({ ...press, point: press.point.toArray(), normal: press.normal.toArray() }));
    this.arrows.geometry.setAttribute("position", new BufferAttribute(linesOfPresses(presses), 3));
  }

  override dispose(): this {
    for (const { geometry, material } of [this.lines, this.arrows]) {
      geometry.dispose();
      material.dispose();
    }
    return this;
  }
}
