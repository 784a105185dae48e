// How bars look: colour and pattern by how a touch begins, so that neither is needed alone.

import { isDeep, isSlide } from "../contacts/feet.js";
import type { Touch } from "../contacts/touch.js";
import type { FootStance, PersonTouch, Verdict } from "../data/document.js";
import type { Palette } from "../scene3d/palette.js";

const minBarWidth = 3;
/** Of a spike: the speed (m/s) at which it is as high as the room above a bar allows; CSS pixels. */
const fullSpikeSpeed = 2, spikeHeight = 5, spikeWidth = 6;
/** Of a notch: the depth, metres, at which it goes through the bar; less than this share is not seen. */
const fullNotch = 0.03, leastNotch = 0.35, notchWidth = 7;
/** Of what is certain within what is possible, CSS pixels. */
const minSolidWidth = 2;
/** Of full height; less is not seen. */
const leastSpike = 0.15;

export class BarPainter {
  private readonly hatches = new Map<string, CanvasPattern>();
  /** x, y, width and height of what is certain of the person and not drawn yet. */
  private readonly certain: [number, number, number, number][] = [];

  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly palette: Palette,
  ) {}

  /** `isHollow`: a check of the poses does not see it. */
  bar(touch: Touch, x0: number, x1: number, y: number, height: number, isHollow: boolean): void {
    const { context } = this;
    const width = Math.max(minBarWidth, x1 - x0);
    if (touch.stance !== null) return this.stance(touch.stance, x0, width, y, height);
    if (touch.person !== null) return this.person(touch.person, x0, width, y, height);
    const verdict = verdictOf(touch), colour = touch.isGround ? this.palette.ground : touch.isStay ? this.palette.trigger : this.palette.verdicts[verdict];
    context.strokeStyle = colour;
    context.lineWidth = 1;
    if (isHollow) {
      context.strokeRect(x0 + 0.5, y + 0.5, width - 1, height - 1);
      return;
    }
    context.fillStyle = touch.isGround ? colour : this.fill(verdict, colour, touch.isStay);
    context.fillRect(x0, y, width, height);
    if (verdict !== "contact" && width > 2 * minBarWidth) context.strokeRect(x0 + 0.5, y + 0.5, width - 1, height - 1);
    if (verdict === "contact" && !touch.isGround && width > 8) {
      context.fillStyle = this.palette.ink;
      context.fillRect(x0, y - 2, 2, height + 4);
    }
    this.spike(touch, x0, y);
  }

  /** Of a foot: what it slides is filled, what hovers is empty, and a notch says how deep it is. */
  private stance(stance: FootStance, x0: number, width: number, y: number, height: number): void {
    const { context, palette } = this;
    context.fillStyle = isSlide(stance) ? palette.slide : palette.ground;
    context.strokeStyle = palette.faint;
    context.lineWidth = 1;
    if (stance.kind === "hovers") context.strokeRect(x0 + 0.5, y + 0.5, width - 1, height - 1);
    else context.fillRect(x0, y, width, height);
    if (!isDeep(stance)) return;
    const share = Math.max(leastNotch, Math.min(1, stance.depth / fullNotch));
    const at = stance.end > stance.begin ? (stance.depthAt - stance.begin) / (stance.end - stance.begin) : 0;
    const x = x0 + Math.min(1, Math.max(0, at)) * width;
    context.fillStyle = palette.ink;
    context.beginPath();
    context.moveTo(x - notchWidth / 2, y);
    context.lineTo(x + notchWidth / 2, y);
    context.lineTo(x, y + share * (height + spikeHeight));
    context.fill();
  }

  /** Of the person: light where it is possible, with an outline where it is nowhere certain. */
  private person({ begin, end, certain }: PersonTouch, x0: number, width: number, y: number, height: number): void {
    const { context, palette } = this, xOf = (time: number): number => x0 + (end > begin ? (time - begin) / (end - begin) : 0) * width;
    context.fillStyle = palette.perhaps;
    context.fillRect(x0, y, width, height);
    context.strokeStyle = palette.person;
    context.lineWidth = 1;
    if (certain === null) return context.strokeRect(x0 + 0.5, y + 0.5, width - 1, height - 1);
    const from = Math.min(xOf(certain.from), x0 + width - minSolidWidth);
    this.certain.push([from, y, Math.max(minSolidWidth, xOf(certain.to) - from), height]);
  }

  /** What is certain of the bars so far: nothing that is but possible hides it. */
  drawCertain(): void {
    this.context.fillStyle = this.palette.person;
    for (const area of this.certain.splice(0)) this.context.fillRect(...area);
  }

  /** How fast two approach where they meet, as the height of a spike above the bar's begin. */
  private spike({ strength }: Touch, x0: number, y: number): void {
    const share = Math.min(1, Math.max(0, strength?.speed ?? 0) / fullSpikeSpeed);
    if (share < leastSpike) return;
    const { context } = this;
    context.fillStyle = this.palette.ink;
    context.beginPath();
    context.moveTo(x0, y);
    context.lineTo(x0, y - share * spikeHeight);
    context.lineTo(x0 + spikeWidth, y);
    context.fill();
  }

  private fill(verdict: Verdict, colour: string, isStay: boolean): string | CanvasPattern {
    if (verdict === "contact") return colour;
    const key = `${verdict} ${isStay}`, known = this.hatches.get(key);
    if (known !== undefined) return known;
    const pattern = this.context.createPattern(verdict === "undecided" ? dots(colour) : stripes(colour), "repeat");
    if (pattern === null) return colour;
    this.hatches.set(key, pattern);
    return pattern;
  }
}

/** What the pattern of a bar says. */
export function verdictOf(touch: Touch): Verdict {
  if (touch.isUndecided) return "undecided";
  return touch.begins === "inside" ? "starts_in_contact" : "contact";
}

const tile = 6;

function tileContext(): CanvasRenderingContext2D | null {
  const canvas = document.createElement("canvas");
  canvas.width = tile;
  canvas.height = tile;
  return canvas.getContext("2d");
}

function stripes(colour: string): HTMLCanvasElement {
  const context = tileContext();
  if (context === null) return document.createElement("canvas");
  context.strokeStyle = colour;
  context.lineWidth = 2;
  for (const shift of [-tile, 0, tile]) {
    context.moveTo(shift, tile);
    context.lineTo(shift + tile, 0);
  }
  context.stroke();
  return context.canvas;
}

function dots(colour: string): HTMLCanvasElement {
  const context = tileContext();
  if (context === null) return document.createElement("canvas");
  context.fillStyle = colour;
  context.fillRect(1, 1, 2, 2);
  context.fillRect(4, 4, 2, 2);
  return context.canvas;
}
