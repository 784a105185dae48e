// What is on the screen: screenshots of the 3D view, and the colours around points of the world.

import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { patience, settled } from "./browsing.mjs";

const canvas = "#view canvas";

export async function pixelsOf({ viewer }) {
  const { decodePng } = await import(pathToFileURL(join(viewer, "tests/png.mjs")).href);
  return {
    /** The 3D view once it is at rest; kept under `path` where one is given. */
    async view(page, path) {
      await settled(page);
      return decodePng(await page.locator(canvas).first().screenshot({ timeout: patience, ...(path === undefined ? {} : { path }) }));
    },
    async whole(page, path) {
      await settled(page);
      return decodePng(await page.screenshot({ timeout: patience, path }));
    },
  };
}

export function differenceAt(one, other, [x, y]) {
  const a = one.at(Math.round(x), Math.round(y)), b = other.at(Math.round(x), Math.round(y));
  return Math.max(...[0, 1, 2].map((channel) => Math.abs(a[channel] - b[channel])));
}

export function coloursOf(image, stride = 5) {
  const colours = new Set();
  for (let y = 0; y < image.height; y += stride) for (let x = 0; x < image.width; x += stride) colours.add([...image.at(x, y)].join());
  return colours.size;
}

/** Pixels within `reach` of a point that are of a colour. */
export function countAround(image, [x, y], reach, isWanted) {
  let found = 0;
  for (let dy = -reach; dy <= reach; ++dy) for (let dx = -reach; dx <= reach; ++dx) {
    const px = Math.round(x + dx), py = Math.round(y + dy);
    if (px >= 0 && py >= 0 && px < image.width && py < image.height && isWanted(image.at(px, py))) ++found;
  }
  return found;
}

/** Colours of the page's palettes, under any light. */
export const isAvatarColour = ([r, g, b]) => b > r + 30 && b > g;
export const isTriggerColour = ([r, g, b]) => g > r + 15 && g > b + 4;
export const isContactColour = ([r, g, b]) => r > 140 && r > g + 50 && g > b;

/** Where the links' origins are in the world, and on the canvas; null where they are behind the camera. */
export async function linkPlaces(page, time, links) {
  return page.evaluate(([time, links]) => Array.from({ length: links }, (_, link) => {
    const origin = window.foretouch.transformAt(0, link, time).slice(9);
    return window.foretouch.screenOf(origin);
  }), [time, links]);
}
