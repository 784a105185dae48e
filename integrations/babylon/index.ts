// Foretouch for Babylon.js.

export { type Experience } from "./hand.js";
export { babylon } from "./host.js";
export { type Thing } from "./objects.js";
export { Body, Hand, type Pressing, Rigid, Teller, type Touch, Toucher } from "./touchers.js";
export { TouchViewer } from "./viewer.js";
export { TouchWorld, type WorldOptions } from "./world.js";
