// What is taken away from the page: its address at this instant, and a picture of the view.

import type { Model } from "../model.js";
import type { View3D } from "../scene3d/view.js";
import type { Store } from "../state.js";
import { addressOf } from "../address_bar.js";
import { button, byId, copyFrom, offerFile } from "./dom.js";
import { seconds } from "./words.js";

const captionHeight = 44, captionMargin = 16;

export function addSharing(model: Model, store: Store, view: View3D | null): void {
  const before = byId("theme");
  if (!model.isLive) {
    const link = button("Copy link", "Copy the address of this instant", () => void copyFrom(link, addressOf(model, store)));
    before.before(link);
  }
  if (view !== null) before.before(button("Picture", "Save the view as a PNG", () => savePicture(model, store, view)));
}

function savePicture(model: Model, store: Store, view: View3D): void {
  const words = byId("caption").textContent || model.document.title;
  withCaption(view.picture(), words).toBlob((blob) => {
    if (blob !== null) offerFile(`${model.document.title} ${seconds(store.state.time - model.timeZero)}.png`, blob);
  }, "image/png");
}

/** A picture is passed on without the page: the sentence goes with it. */
function withCaption(picture: HTMLCanvasElement, words: string): HTMLCanvasElement {
  const scale = Math.max(1, window.devicePixelRatio), style = getComputedStyle(document.body);
  const made = document.createElement("canvas");
  made.width = picture.width;
  made.height = picture.height + captionHeight * scale;
  const context = made.getContext("2d");
  if (context === null) return picture;
  context.fillStyle = style.backgroundColor;
  context.fillRect(0, 0, made.width, made.height);
  context.drawImage(picture, 0, captionHeight * scale);
  context.fillStyle = style.color;
  context.font = `${15 * scale}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.fillText(words, captionMargin * scale, (captionHeight * scale) / 2, made.width - 2 * captionMargin * scale);
  return made;
}
