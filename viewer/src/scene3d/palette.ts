// Colours of the 3D view and of everything drawn beside it. The accents are Okabe and Ito's, which
// people with any common colour blindness tell apart; verdicts differ in shape and pattern too.

import type { Verdict } from "../data/document.js";
import type { Theme } from "../state.js";

export interface Palette {
  readonly background: string;
  readonly scene: string;
  readonly sceneEdge: string;
  readonly grid: string;
  readonly avatar: string;
  readonly avatarHeld: string;
  readonly chosenLink: string;
  readonly touching: string;
  readonly before: string;
  readonly asked: string;
  readonly atContact: string;
  /** Of a solid avatar: where its tracker says that it is. */
  readonly tracked: string;
  readonly swept: string;
  readonly halo: string;
  /** Of touches that are ground contact. */
  readonly ground: string;
  /** Of feet that slide, and of the way that they slid. */
  readonly slide: string;
  /** Of the person, beside the model: what they surely touched, and perhaps; and around a link, how far they may be from it. */
  readonly person: string;
  readonly perhaps: string;
  readonly veil: string;
  /** Of triggers, and who is in them. */
  readonly trigger: string;
  readonly ink: string;
  readonly faint: string;
  readonly verdicts: Record<Verdict, string>;
}

const verdicts: Record<Verdict, string> = {
  contact: "#d55e00",
  starts_in_contact: "#cc79a7",
  undecided: "#e69f00",
};

export const palettes: Record<Theme, Palette> = {
  light: {
    background: "#e9eff5",
    scene: "#d8d0c4",
    sceneEdge: "#a59d91",
    grid: "#b4bac4",
    avatar: "#3f86c6",
    avatarHeld: "#9fb6cb",
    chosenLink: "#0072b2",
    touching: "#d55e00",
    before: "#8a93a1",
    asked: "#009e73",
    atContact: "#d55e00",
    tracked: "#e69f00",
    swept: "#e69f00",
    halo: "#ffffff",
    ground: "#c9c2b6",
    slide: "#7b3fb5",
    person: "#0072b2",
    perhaps: "#b2d5e8",
    veil: "#1d2530",
    trigger: "#009e73",
    ink: "#1d2530",
    faint: "#6b7584",
    verdicts,
  },
  dark: {
    background: "#12171e",
    scene: "#867f76",
    sceneEdge: "#b3aca2",
    grid: "#4a535f",
    avatar: "#56b4e9",
    avatarHeld: "#4d6577",
    chosenLink: "#a8dcff",
    touching: "#f0772b",
    before: "#98a2b0",
    asked: "#1fc297",
    atContact: "#f0772b",
    tracked: "#f0b93a",
    swept: "#f0b93a",
    halo: "#14181e",
    ground: "#5d574f",
    slide: "#b48ae8",
    person: "#6cc0f5",
    perhaps: "#2b4659",
    veil: "#e7ebf0",
    trigger: "#1fc297",
    ink: "#e7ebf0",
    faint: "#98a2b0",
    verdicts: { contact: "#f0772b", starts_in_contact: "#dd94bd", undecided: "#f0b93a" },
  },
};
