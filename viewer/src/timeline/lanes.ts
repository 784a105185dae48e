// Draws the rows of the timeline: names and bars.

import type { Touch } from "../contacts/touch.js";
import type { Palette } from "../scene3d/palette.js";
import { BarPainter } from "./bars.js";
import type { Row, Window } from "./rows.js";

export const rowHeight = 22;
const barHeight = 12, headingBarHeight = 6;
/** Between a name and the bars, CSS pixels. */
const nameMargin = 10, indent = 10;

export interface Lanes {
  readonly rows: readonly Row[];
  readonly window: Window;
  readonly width: number;
  readonly gutter: number;
  readonly chosen: Touch | null;
  /** Whether touches that a check of the poses misses are drawn hollow. */
  readonly showsDiscrete: boolean;
  readonly folded: ReadonlySet<string>;
  xOf(time: number): number;
}

export function drawLanes(context: CanvasRenderingContext2D, palette: Palette, lanes: Lanes): void {
  const painter = new BarPainter(context, palette);
  context.textBaseline = "middle";
  lanes.rows.forEach((row, index) => {
    const y = index * rowHeight;
    if (row.isHeading) shade(context, palette.grid, 0.18, 0, y, lanes.width, rowHeight);
    shade(context, palette.grid, 0.5, 0, y + rowHeight - 1, lanes.width, 1);
    drawName(context, palette, lanes, row, y);
    drawBars(context, painter, palette, lanes, row, y);
  });
  if (lanes.rows.length > 0) return;
  context.font = "12px system-ui, sans-serif";
  context.fillStyle = palette.faint;
  context.fillText("nothing to show", lanes.gutter, rowHeight / 2);
}

function shade(context: CanvasRenderingContext2D, colour: string, alpha: number, x: number, y: number, width: number, height: number): void {
  context.globalAlpha = alpha;
  context.fillStyle = colour;
  context.fillRect(x, y, width, height);
  context.globalAlpha = 1;
}

function drawName(context: CanvasRenderingContext2D, palette: Palette, lanes: Lanes, row: Row, y: number): void {
  const { chosen } = lanes;
  const isChosen = chosen !== null && (row.link < 0 ? row.touches.includes(chosen) && !row.isHeading : row.link === chosen.link && row.avatar === chosen.avatar);
  context.font = `${row.isHeading || isChosen ? 600 : 400} 12px system-ui, sans-serif`;
  context.fillStyle = isChosen || row.isHeading ? palette.ink : palette.faint;
  const mark = row.isHeading ? (lanes.folded.has(row.group) ? "▸ " : "▾ ") : "";
  const left = row.isHeading || row.group === "" ? 2 : 2 + indent;
  context.fillText(fitted(context, mark + row.name, lanes.gutter - nameMargin - left), left, y + rowHeight / 2);
}

/** As much of the text as there is room for. */
export function fitted(context: CanvasRenderingContext2D, text: string, room: number): string {
  if (context.measureText(text).width <= room) return text;
  let length = text.length;
  while (length > 1 && context.measureText(`${text.slice(0, length)}…`).width > room) --length;
  return `${text.slice(0, length)}…`;
}

function drawBars(context: CanvasRenderingContext2D, painter: BarPainter, palette: Palette, lanes: Lanes, row: Row, y: number): void {
  const { window, chosen } = lanes, height = row.isHeading ? headingBarHeight : barHeight;
  const top = y + (rowHeight - height) / 2;
  let drawnTo = -Infinity;
  context.save();
  context.beginPath();
  context.rect(lanes.gutter - 1, y, lanes.width, rowHeight);
  context.clip();
  for (const touch of row.touches) {
    if (touch.end < window.t0) continue;
    if (touch.begin > window.t1) break;
    const x0 = lanes.xOf(touch.begin), x1 = lanes.xOf(touch.end);
    // Thousands of bars on one pixel look like one; what is certain is seen on what is but possible.
    if (x1 < drawnTo + 0.5 && touch !== chosen && touch.person?.certain == null) continue;
    drawnTo = Math.max(drawnTo, x1, x0 + 1);
    painter.bar(touch, x0, x1, top, height, lanes.showsDiscrete && touch.isMissed === true);
    if (touch !== chosen || row.isHeading) continue;
    context.strokeStyle = palette.ink;
    context.lineWidth = 2;
    context.strokeRect(x0 - 2, top - 3, Math.max(3, x1 - x0) + 4, height + 6);
  }
  painter.drawCertain();
  context.restore();
}
