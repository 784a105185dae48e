// A pointer that takes hold of the body leads it in the plane that faces the camera; with the shift
// key, or by the wheel, it is turned.

import * as THREE from "three";
import type { PlayView } from "./play_view.js";

export interface Drag {
  /** Metres in W. */
  moved(by: THREE.Vector3): void;
  turned(axis: THREE.Vector3, radians: number): void;
}

const radiansPerPixel = 0.008;

export function listenForDrags(view: PlayView, drag: Drag): void {
  const { canvas, controls, camera } = view.stage;
  let held: { plane: THREE.Plane; last: THREE.Vector3; x: number; y: number } | null = null;
  const rayOf = (event: PointerEvent): THREE.Ray => view.stage.rayThrough(event.offsetX, event.offsetY);

  // Before the camera's own listeners: what holds the body does not turn the camera.
  canvas.addEventListener("pointerdown", (event) => {
    const hit = view.figure?.group.visible === true ? view.figure.pick(rayOf(event)) : null;
    if (hit === null || event.button !== 0) return;
    event.stopImmediatePropagation();
    controls.enabled = false;
    canvas.setPointerCapture(event.pointerId);
    const last = rayOf(event).at(hit.distance, new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), last);
    held = { plane, last, x: event.offsetX, y: event.offsetY };
  }, { capture: true });

  canvas.addEventListener("pointermove", (event) => {
    if (held === null) return;
    if (event.shiftKey) {
      drag.turned(new THREE.Vector3(0, 1, 0), radiansPerPixel * (event.offsetX - held.x));
      drag.turned(new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion), radiansPerPixel * (event.offsetY - held.y));
    } else {
      const at = rayOf(event).intersectPlane(held.plane, new THREE.Vector3());
      if (at !== null) {
        drag.moved(at.clone().sub(held.last));
        held.last.copy(at);
      }
    }
    [held.x, held.y] = [event.offsetX, event.offsetY];
  });

  const release = (): void => {
    if (held === null) return;
    held = null;
    controls.enabled = true;
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
}
