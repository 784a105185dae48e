// Contacts in the scene: a point each, of constant size on the screen and never hidden, its colour
// and its shape saying the verdict; arrows along the normal for those that hold now.

import * as THREE from "three";
import type { Contact } from "../contacts/contact.js";
import type { Vector, Verdict } from "../data/document.js";
import type { Palette } from "./palette.js";

/** What a marker looks like, as the shader knows it. */
const dim = 1, lit = 2, chosen = 3;

const shapes: Record<Verdict, number> = { contact: 0, starts_in_contact: 1, undecided: 2 };
const maxArrows = 512;
/** Thicker links no marker hides, metres. */
const unhidden = 1000;
/** Arrows are thinner beside thin links: of this thickness and more they are not, metres. */
const thickLink = 0.08, thinnest = 0.35;
/** Of the arrow's length. */
const shaftRadius = 0.035, headRadius = 0.11, headLength = 0.36;

export class Markers {
  readonly group = new THREE.Group();
  private readonly material = pointMaterial();
  /** Where contacts begin, over the whole clip: as they are from first to last. */
  private readonly traces: THREE.Points;
  private readonly current: THREE.Points;
  private readonly shafts: THREE.InstancedMesh;
  private readonly heads: THREE.InstancedMesh;
  private readonly arrowMaterial = new THREE.MeshBasicMaterial();
  private thicknessOf: (contact: Contact) => number = () => unhidden;
  private lengthOf: (contact: Contact) => number = () => 1;
  private palette: Palette | null = null;
  private shown: readonly Contact[] = [];

  constructor() {
    this.traces = points(this.material, 9);
    this.current = points(this.material, 10);
    const shaft = new THREE.CylinderGeometry(shaftRadius, shaftRadius, 1 - headLength, 12);
    shaft.translate(0, (1 - headLength) / 2, 0);
    const head = new THREE.ConeGeometry(headRadius, headLength, 20);
    head.translate(0, 1 - headLength / 2, 0);
    this.shafts = new THREE.InstancedMesh(shaft, this.arrowMaterial, maxArrows);
    this.heads = new THREE.InstancedMesh(head, this.arrowMaterial, maxArrows);
    for (const arrows of [this.shafts, this.heads]) {
      arrows.count = 0;
      arrows.frustumCulled = false;
      arrows.renderOrder = 4;
    }
    this.group.add(this.traces, this.current, this.shafts, this.heads);
  }

  /**
   * `origin` is the world's point that the view has at zero; thickness in metres of the link that a marker may hide;
   * length of an arrow, as a share of the usual one.
   */
  setContacts(contacts: readonly Contact[], origin: Vector, thicknessOf: (contact: Contact) => number, lengthOf: (contact: Contact) => number): void {
    this.thicknessOf = thicknessOf;
    this.lengthOf = lengthOf;
    // What starts in contact goes on from the step before: as a trace it only hides where contacts begin.
    const begun = contacts.filter(({ verdict, point }) => verdict !== "starts_in_contact" && point !== null);
    this.fill(this.traces, begun, origin, () => dim);
  }

  /** The contacts that hold now, and the chosen one. */
  setCurrent(held: readonly Contact[], one: Contact | null, origin: Vector): void {
    const now = one === null || held.includes(one) ? [...held] : [...held, one];
    const isSame = now.length === this.shown.length && now.every((contact, i) => contact === this.shown[i]);
    if (isSame && now.length === 0) return;
    this.shown = now;
    this.fill(this.current, now.filter(({ point }) => point !== null), origin, (contact) => (contact === one ? chosen : lit));
  }

  set hasTraces(isShown: boolean) {
    this.traces.visible = isShown;
  }

  private fill(target: THREE.Points, contacts: readonly Contact[], origin: Vector, stateOf: (contact: Contact) => number): void {
    const places = contacts.flatMap(({ point }) => (point ?? origin).map((value, axis) => value - origin[axis]));
    const geometry = new THREE.BufferGeometry();
    const add = (name: string, of: (contact: Contact) => number): void => {
      geometry.setAttribute(name, new THREE.BufferAttribute(Float32Array.from(contacts, of), 1));
    };
    geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(places), 3));
    add("shape", ({ verdict }) => shapes[verdict]);
    add("thickness", (contact) => Math.min(unhidden, this.thicknessOf(contact)));
    add("state", stateOf);
    target.geometry.dispose();
    target.geometry = geometry;
  }

  /** Arrows of `length` metres from scene towards link. */
  setArrows(contacts: readonly Contact[], origin: Vector, length: number): void {
    const shown = contacts.filter((c) => c.point !== null && c.normal !== null).slice(0, maxArrows);
    const matrix = new THREE.Matrix4(), turn = new THREE.Quaternion(), up = new THREE.Vector3(0, 1, 0);
    const colour = new THREE.Color();
    shown.forEach((contact, i) => {
      const [x, y, z] = contact.point ?? origin;
      turn.setFromUnitVectors(up, new THREE.Vector3(...(contact.normal ?? [0, 1, 0])).normalize());
      const at = new THREE.Vector3(x - origin[0], y - origin[1], z - origin[2]);
      const long = length * this.lengthOf(contact), width = length * Math.min(1, Math.max(thinnest, this.thicknessOf(contact) / thickLink));
      matrix.compose(at, turn, new THREE.Vector3(width, long, width));
      if (this.palette !== null) colour.set(this.palette.ink);
      for (const arrows of [this.shafts, this.heads]) {
        arrows.setMatrixAt(i, matrix);
        arrows.setColorAt(i, colour);
      }
    });
    for (const arrows of [this.shafts, this.heads]) {
      arrows.count = shown.length;
      arrows.instanceMatrix.needsUpdate = true;
      if (arrows.instanceColor !== null) arrows.instanceColor.needsUpdate = true;
    }
  }

  paint(palette: Palette): void {
    this.palette = palette;
    const colours = [palette.verdicts.contact, palette.verdicts.starts_in_contact, palette.verdicts.undecided];
    this.material.uniforms["colours"].value = colours.map((colour) => new THREE.Color(colour));
    this.material.uniforms["halo"].value = new THREE.Color(palette.halo);
  }

  /** Before every frame: what makes markers as large as they are. */
  setView(pixelRatio: number, camera: THREE.PerspectiveCamera, height: number): void {
    this.material.uniforms["pixelRatio"].value = pixelRatio;
    this.material.uniforms["focal"].value = (height / 2) * camera.projectionMatrix.elements[5];
  }
}

function points(material: THREE.Material, order: number): THREE.Points {
  const made = new THREE.Points(new THREE.BufferGeometry(), material);
  made.frustumCulled = false;
  made.renderOrder = order;
  return made;
}

function pointMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: {
      colours: { value: [new THREE.Color(), new THREE.Color(), new THREE.Color()] },
      halo: { value: new THREE.Color() },
      pixelRatio: { value: 1 },
      focal: { value: 1 },
    },
    vertexShader: `
attribute float shape;
attribute float state;
attribute float thickness;
varying float vShape;
varying float vState;
varying float vHollow;
uniform float pixelRatio;
uniform float focal;
void main() {
  vShape = shape;
  vState = state;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  float size = state > 2.5 ? 22.0 : state > 1.5 ? 15.0 : 5.0;
  gl_PointSize = size * pixelRatio;
  // A link that the marker would hide is seen through it.
  vHollow = state > 1.5 && thickness * focal / gl_Position.w < 1.4 * size ? 1.0 : 0.0;
}`,
    // Distance from the edge of a disc, a square and a triangle that fill the point.
    fragmentShader: `
varying float vShape;
varying float vState;
varying float vHollow;
uniform vec3 colours[3];
uniform vec3 halo;
float inside(vec2 p) {
  if (vShape < 0.5) return 1.0 - length(p);
  if (vShape < 1.5) return 0.84 - max(abs(p.x), abs(p.y));
  return min(0.75 - p.y, 0.5 * (p.y + 0.9) - abs(p.x) * 0.9);
}
void main() {
  float depth = inside(vec2(2.0 * gl_PointCoord - 1.0));
  if (depth < 0.0) discard;
  if (vHollow > 0.5 && depth > 0.42) discard;
  int verdict = int(vShape + 0.5);
  vec3 colour = verdict == 0 ? colours[0] : verdict == 1 ? colours[1] : colours[2];
  float rim = vHollow > 0.5 ? 0.12 : vState > 2.5 ? 0.3 : 0.22;
  bool isHalo = vState > 1.5 && depth < rim;
  gl_FragColor = vec4(isHalo ? halo : colour, vState > 1.5 ? 1.0 : 0.4);
  #include <colorspace_fragment>
}`,
  });
}
