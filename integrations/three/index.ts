// Foretouch for three.js.

export { TouchHelper } from "./helper.js";
export { three } from "./host.js";
export { Body, Hand, type HandSpace, type Pressing, Rigid, type Touch, Toucher, type Touches } from "./touchers.js";
export { TouchWorld, type WorldOptions } from "./world.js";
