// For inspection: the program's verdicts on unit, axis and place; of documents that have none, what
// the measured sizes say. Those are hints, not proofs: the person who looks decides.

import type { Bounds, Check } from "../data/document.js";
import { button, card, copyFrom, element } from "./dom.js";

interface Hint {
  readonly question: string;
  readonly answer: string;
  readonly isDoubtful: boolean;
}

/** Metres: a standing or crouching person, with some room. */
const shortestPerson = 0.6, tallestPerson = 2.6;
const smallestScene = 0.5, largestScene = 2000;
/** Feet may be this far from the lowest point of the scene. */
const footReach = 0.5;

export function checksOf(avatars: readonly { name: string; bounds: Bounds }[], scene: Bounds | null): Check[] {
  return hintsOf(avatars, scene).map(({ question, answer, isDoubtful }) => ({
    name: question, state: isDoubtful ? "doubt" : "good", text: answer, remedy: "",
  }));
}

function hintsOf(avatars: readonly { name: string; bounds: Bounds }[], scene: Bounds | null): Hint[] {
  return [
    ...avatars.flatMap(({ name, bounds }) => [heightCheck(name, bounds), axisCheck(name, bounds)]),
    ...(scene === null ? [] : [sceneCheck(scene), ...avatars.map(({ name, bounds }) => placeCheck(name, bounds, scene))]),
  ];
}

function extent(bounds: Bounds, axis: number): number {
  return bounds.max[axis] - bounds.min[axis];
}

function metres(value: number): string {
  return `${value.toFixed(value < 10 ? 2 : 1)} m`;
}

function sizes(bounds: Bounds): string {
  return `${metres(extent(bounds, 0))} × ${metres(extent(bounds, 1))} × ${metres(extent(bounds, 2))}`;
}

function heightCheck(name: string, bounds: Bounds): Hint {
  const height = Math.max(extent(bounds, 0), extent(bounds, 1), extent(bounds, 2));
  const isDoubtful = height < shortestPerson || height > tallestPerson;
  const hint = height > 50 ? " Are these centimetres?" : height < 0.1 ? " Is something in metres that should be scaled up?" : "";
  const words = isDoubtful ? `not the size of a person.${hint}` : "the size of a person.";
  return { question: `Unit of ${name}`, answer: `Its longest side is ${metres(height)}: ${words}`, isDoubtful };
}

function axisCheck(name: string, bounds: Bounds): Hint {
  const isUp = extent(bounds, 1) >= 0.8 * Math.max(extent(bounds, 0), extent(bounds, 2));
  const answer = isUp ? "It stands along +Y." : `It lies on its side: ${sizes(bounds)} along x, y, z. Is another axis up?`;
  return { question: `Axis of ${name}`, answer, isDoubtful: !isUp };
}

function sceneCheck(scene: Bounds): Hint {
  const largest = Math.max(extent(scene, 0), extent(scene, 1), extent(scene, 2));
  const isDoubtful = largest < smallestScene || largest > largestScene;
  return { question: "Unit of the scene", answer: `It is ${sizes(scene)} along x, y, z.`, isDoubtful };
}

function placeCheck(name: string, avatar: Bounds, scene: Bounds): Hint {
  const isInside = [0, 2].every((axis) => avatar.min[axis] <= scene.max[axis] && avatar.max[axis] >= scene.min[axis]);
  const above = avatar.min[1] - scene.min[1];
  if (!isInside) return { question: `Place of ${name}`, answer: "It stands outside the scene.", isDoubtful: true };
  const isOnGround = Math.abs(above) <= footReach;
  const side = above < 0 ? "below" : "above";
  const place = `its lowest point is ${metres(Math.abs(above))} ${side} the scene's lowest.`;
  const answer = isOnGround
    ? `It stands in the scene; ${place}`
    : `Over the scene's ground plan, but ${place} Is there a floor at its feet, or is another axis up?`;
  return { question: `Place of ${name}`, answer, isDoubtful: !isOnGround };
}

const marks: Record<Check["state"], readonly [string, string]> = { good: ["✓", "good"], doubt: ["?", "doubtful"], bad: ["✗", "bad"] };

export function checklistCard(checks: readonly Check[]): HTMLElement {
  const list = element("ul", { class: "checks" }, ...checks.map(({ name, state, text, remedy }) => {
    const mark = element("span", { class: `mark ${state}`, text: marks[state][0] });
    mark.setAttribute("role", "img");
    mark.setAttribute("aria-label", marks[state][1]);
    const words = element("div", {}, element("strong", { text: name }), element("span", { text }));
    if (remedy !== "") {
      const copy = button("Copy", `Copy ${remedy}`, () => void copyFrom(copy, remedy));
      words.append(element("div", { class: "found" }, element("code", { class: "option", text: remedy }), copy));
    }
    return element("li", {}, mark, words);
  }));
  return card("Right unit, axis and place?", list);
}
