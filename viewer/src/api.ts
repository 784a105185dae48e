// window.foretouch: the page's small interface, for tests and for those who embed the page.

import type { Contact } from "./contacts/contact.js";
import { momentOf } from "./contacts/opening.js";
import type { Touch } from "./contacts/touch.js";
import type { FootStance, RecordedFoot, Vector } from "./data/document.js";
import type { Clip } from "./motion/clip.js";
import { Posture } from "./motion/clip.js";
import { placeOption } from "./motion/placing.js";
import type { Model } from "./model.js";
import { chooseContact, chooseTouch } from "./panels/choosing.js";
import type { View3D } from "./scene3d/view.js";
import type { Store } from "./state.js";

export interface Foretouch {
  /** Resolves once the document is shown, or with it refused: see state().error. */
  readonly ready: Promise<void>;
  /** Of a link in the world at a time of the clip: rotation row by row, then origin. Metres. */
  transformAt(avatarIndex: number, linkIndex: number, timeSeconds: number): number[];
  /** Shows the time, and pauses. */
  seek(seconds: number): void;
  /** Of all avatars' contacts in order of time (equal times in the document's order). */
  selectContact(index: number): void;
  /** Of the touches in order of their begin; a document without touches has one for each contact. */
  selectTouch(index: number): void;
  /** What the page knows of a touch, its contacts as indices, and the one that shows it; -1 where none does. */
  touch(index: number): Omit<Touch, "rows"> & { readonly rows: number[]; readonly moment: number };
  /** Index of the chosen touch; -1 where none is. */
  selectedTouch(): number;
  /** Of the first avatar. */
  linkName(link: number): string;
  /** How feet stand, as the document has it. */
  feet(): readonly RecordedFoot[];
  /** How the chosen foot stands; null where none is chosen. */
  selectedStance(): FootStance | null;
  /** Inspections: the option that puts the body where it was clicked to; null where nobody has clicked. */
  placeOption(): string | null;
  /** What the page knows of a contact: the document's own numbers. */
  contact(index: number): Contact;
  /** Index of the selected contact; -1 where none is. */
  selected(): number;
  state(): PageState;
  /** Pixels from the canvas' upper left corner; null behind the camera or without WebGL. */
  screenOf(point: Vector): [number, number] | null;
}

export interface PageState {
  readonly time: number;
  readonly start: number;
  readonly end: number;
  readonly contacts: number;
  readonly touches: number;
  readonly isPlaying: boolean;
  readonly showsDiscrete: boolean;
  readonly showsGhosts: boolean;
  readonly showsSwept: boolean;
  readonly shape: string;
  readonly theme: string;
  readonly has3D: boolean;
  /** Frames of the 3D view drawn so far: none are drawn where nothing changes. */
  readonly frames: number;
  /** Whether the 3D view is drawn in full, and nothing more is to be drawn. */
  readonly isAtRest: boolean;
  /** The sentence shown instead of the document; null where all is well. */
  readonly error: string | null;
}

export interface Page {
  readonly model: Model;
  readonly store: Store;
  readonly view: View3D | null;
}

declare global {
  interface Window {
    foretouch?: Foretouch;
  }
}

export function publish(ready: Promise<void>, page: () => Page | null, error: () => string | null): void {
  const open = (): Page => page() ?? fail("no document is shown");
  window.foretouch = {
    ready,
    transformAt: (avatar, link, time) => transformAt(open().model.clips[avatar], link, time),
    seek: (time) => open().store.set({ time, isPlaying: false, follows: false }),
    selectContact: (index) => chooseContact(open().store, open().model, contactAt(open(), index)),
    selectTouch: (index) => chooseTouch(open().store, open().model, touchAt(open(), index)),
    touch: (index) => plainTouch(open(), index),
    selectedTouch: () => {
      const { model, store } = open();
      return store.state.touch === null ? -1 : model.touches.indexOf(store.state.touch);
    },
    linkName: (link) => open().model.avatars[0].links[link].name,
    feet: () => open().model.document.feet,
    selectedStance: () => open().store.state.touch?.stance ?? null,
    placeOption: () => {
      const { place } = open().store.state;
      return place === null ? null : placeOption(place);
    },
    contact: (index) => ({ ...contactAt(open(), index) }),
    selected: () => {
      const { model, store } = open();
      return store.state.contact === null ? -1 : model.contacts.indexOf(store.state.contact);
    },
    state: () => stateOf(page(), error()),
    screenOf: (point) => page()?.view?.screenOf(point) ?? null,
  };
}

function contactAt({ model }: Page, index: number): Contact {
  return model.contacts[index] ?? fail(`there is no contact ${index}`);
}

function touchAt({ model }: Page, index: number): Touch {
  return model.touches[index] ?? fail(`there is no touch ${index}`);
}

function plainTouch(page: Page, index: number): ReturnType<Foretouch["touch"]> {
  const touch = touchAt(page, index);
  const indexOf = (row: Contact | null): number => (row === null ? -1 : page.model.contacts.indexOf(row));
  return { ...touch, rows: touch.rows.map(indexOf), moment: indexOf(momentOf(touch)) };
}

function transformAt(clip: Clip | undefined, link: number, time: number): number[] {
  if (clip === undefined || !(link >= 0 && link < clip.parents.length)) fail("there is no such link");
  const posture = new Posture(clip as Clip);
  posture.moveTo(time);
  return posture.transform(link);
}

function stateOf(page: Page | null, error: string | null): PageState {
  const state = page?.store.state;
  return {
    time: state?.time ?? 0,
    start: page?.model.start ?? 0,
    end: page?.model.end ?? 0,
    contacts: page?.model.contacts.length ?? 0,
    touches: page?.model.touches.length ?? 0,
    isPlaying: state?.isPlaying ?? false,
    showsDiscrete: state?.showsDiscrete ?? false,
    showsGhosts: state?.showsGhosts ?? false,
    showsSwept: state?.showsSwept ?? false,
    shape: state?.shape ?? "lss",
    theme: state?.theme ?? "light",
    has3D: page?.view !== null && page?.view !== undefined,
    frames: page?.view?.frames ?? 0,
    isAtRest: page?.view?.isAtRest ?? true,
    error,
  };
}

function fail(message: string): never {
  throw new Error(message);
}
