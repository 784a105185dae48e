// The 3D view: the scene, the body and its ghosts, where they touch, what is swept, and the planes of
// the proof. Drawn when something changes; in VR, at every frame.

import * as THREE from "three";
import type { Point, SweptSurface } from "../../../bindings/wasm/foretouch.js";
import type { Bounds, Scene, Vector } from "../../src/data/document.js";
import { ball, boundsOfPosture, emptyBounds } from "../../src/scene3d/bounds.js";
import { ContactShadow } from "../../src/scene3d/contact_shadow.js";
import { Cutaway } from "../../src/scene3d/cutaway.js";
import type { Palette } from "../../src/scene3d/palette.js";
import { palettes } from "../../src/scene3d/palette.js";
import { Scenery } from "../../src/scene3d/scenery.js";
import { facetMaterial, setScreenColour } from "../../src/scene3d/shading.js";
import { Stage } from "../../src/scene3d/stage.js";
import type { Theme } from "../../src/state.js";
import { Figure } from "./figure.js";
import type { Body, ProofPlane } from "./messages.js";
import type { NamedScene } from "./room.js";

/** A place where body and scene meet; the arrow points to the body. */
export interface Mark {
  readonly point: Point;
  readonly normal: Point;
  /** Of the arrow, metres. */
  readonly length: number;
}

const planeSide = 0.16, markRadius = 0.007, headShare = 0.25;

/** What the viewer's drawing knows of a scene; its objects are runs of triangles. */
function drawnScene({ name, positions, indices, objects, objectNames }: NamedScene): Scene {
  const order = Array.from(objects.keys()).sort((a, b) => objects[a] - objects[b]);
  const sorted = new Uint32Array(indices.length);
  order.forEach((triangle, i) => sorted.set(indices.subarray(3 * triangle, 3 * triangle + 3), 3 * i));
  const counts = new Array<number>(objectNames.length).fill(0);
  for (const object of objects) ++counts[object];
  let first = 0;
  const runs = objectNames.map((objectName, object) => {
    const run = { name: objectName, first, count: counts[object] };
    first += run.count;
    return run;
  });
  const box = new THREE.Box3().setFromArray(positions);
  return { name, origin: [0, 0, 0], positions, indices: sorted, triangleIds: null, objects: runs, trianglesInFile: objects.length, reduction: "none", bounds: { min: box.min.toArray(), max: box.max.toArray() } };
}

export class PlayView {
  readonly stage: Stage;
  figure: Figure | null = null;
  /** The hands of WebXR. */
  hands: Figure[] = [];
  private scenery: Scenery | null = null;
  private bounds: Bounds = emptyBounds;
  private readonly cutaway = new Cutaway();
  private readonly shadow = new ContactShadow();
  private readonly swept = new THREE.Group();
  private readonly planes = new THREE.Group();
  private readonly marks = new THREE.Group();
  private readonly sweptMaterial = facetMaterial(0.36);
  private readonly planeMaterial = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.28, side: THREE.DoubleSide, depthWrite: false });
  private readonly planeEdge = new THREE.LineBasicMaterial();
  private readonly plane = new THREE.PlaneGeometry(planeSide, planeSide);
  private readonly planeOutline = new THREE.EdgesGeometry(this.plane);
  private readonly markBall = new THREE.SphereGeometry(markRadius, 16, 12);
  private readonly markMaterial = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true });
  private theme: Theme = "light";
  private touching: ReadonlySet<number> = new Set();

  /** Throws where there is no WebGL. */
  constructor(host: HTMLElement) {
    this.stage = new Stage(host);
    this.stage.scene.add(this.swept, this.planes, this.marks);
    this.cutaway.aim(this.stage.camera, new THREE.Vector3(0, 0, -1), 0);
    this.stage.onFrame(({ maxTriangles }) => [{ from: 0, to: 1, prepare: () => this.prepare(maxTriangles) }]);
  }

  setScene(scene: NamedScene): void {
    if (this.scenery !== null) this.stage.scene.remove(this.scenery.group);
    const drawn = drawnScene(scene);
    this.scenery = new Scenery(drawn, this.cutaway, this.shadow);
    this.stage.scene.add(this.scenery.group);
    this.bounds = drawn.bounds ?? emptyBounds;
    this.paint(this.theme);
  }

  setBody(body: Body): Figure {
    if (this.figure !== null) this.stage.scene.remove(this.figure.group);
    this.figure = new Figure(body);
    this.stage.scene.add(this.figure.group);
    this.paint(this.theme);
    return this.figure;
  }

  setHands(bodies: readonly Body[]): void {
    for (const hand of this.hands) this.stage.scene.remove(hand.group);
    this.hands = bodies.map((body) => new Figure(body));
    for (const hand of this.hands) this.stage.scene.add(hand.group);
    this.paint(this.theme);
  }

  /** Pixel of the canvas; null behind the camera. */
  screenOf(point: Point): [number, number] | null {
    return this.stage.screenOf(new THREE.Vector3(...point));
  }

  /** Of the scene's box. */
  get centre(): Vector {
    return ball(this.bounds).centre;
  }

  private get palette(): Palette {
    return palettes[this.theme];
  }

  paint(theme: Theme): void {
    this.theme = theme;
    this.stage.paint(this.palette);
    this.scenery?.paint(this.palette);
    setScreenColour(this.sweptMaterial.uniforms["colour"].value as THREE.Color, this.palette.swept);
    this.planeMaterial.color.set(this.palette.asked);
    this.planeEdge.color.set(this.palette.asked);
    this.markMaterial.color.set(this.palette.touching);
    this.figure?.paint(this.palette, this.touching);
    for (const hand of this.hands) hand.paint(this.palette, new Set());
  }

  setTouching(links: ReadonlySet<number>): void {
    this.touching = links;
    this.figure?.paint(this.palette, links);
  }

  paintHand(hand: number, touching: ReadonlySet<number>): void {
    this.hands[hand].paint(this.palette, touching);
  }

  setMarks(marks: readonly Mark[]): void {
    for (const child of this.marks.children) if (child instanceof THREE.ArrowHelper) child.dispose();
    this.marks.clear();
    for (const { point, normal, length } of marks) {
      const spot = new THREE.Mesh(this.markBall, this.markMaterial);
      spot.position.set(...point);
      spot.renderOrder = 8;
      this.marks.add(spot);
      if (length <= 0 || Math.hypot(...normal) === 0) continue;
      const arrow = new THREE.ArrowHelper(new THREE.Vector3(...normal), new THREE.Vector3(...point), length, this.palette.touching, headShare * length, headShare * length / 2);
      this.marks.add(arrow);
    }
    this.stage.draw();
  }

  setSwept(surfaces: readonly SweptSurface[]): void {
    for (const child of this.swept.children) (child as THREE.Mesh).geometry.dispose();
    this.swept.clear();
    for (const { positions, indices } of surfaces) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
      geometry.setIndex(new THREE.BufferAttribute(indices, 1));
      const mesh = new THREE.Mesh(geometry, this.sweptMaterial);
      mesh.renderOrder = 1;
      this.swept.add(mesh);
    }
    this.stage.draw();
  }

  /** Each as a square before its link. */
  setPlanes(planes: readonly ProofPlane[]): void {
    this.planes.clear();
    const { figure } = this;
    if (figure !== null) {
      for (const { link, normal, offset } of planes) {
        const ofLink = boundsOfPosture({ ...figure.avatar, lss: figure.avatar.lss.filter((one) => one.link === link) }, figure.world);
        const direction = new THREE.Vector3(...normal), middle = new THREE.Vector3(...ball(ofLink).centre);
        middle.addScaledVector(direction, offset - direction.dot(middle));
        const square = new THREE.Mesh(this.plane, this.planeMaterial), edge = new THREE.LineSegments(this.planeOutline, this.planeEdge);
        for (const part of [square, edge]) {
          part.position.copy(middle);
          part.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), direction);
        }
        square.renderOrder = 5;
        this.planes.add(square, edge);
      }
    }
    this.stage.draw();
  }

  /** Looks at the body, from above and a little from the side. */
  frame(distance = 1.6): void {
    const { figure } = this;
    const target = new THREE.Vector3(...(figure === null ? this.centre : ball(boundsOfPosture(figure.avatar, figure.world)).centre));
    this.stage.controls.target.copy(target);
    this.stage.camera.position.copy(target).add(new THREE.Vector3(0.2, 0.45, 1).normalize().multiplyScalar(distance));
    this.stage.controls.update();
    this.stage.draw();
  }

  private prepare(maxTriangles: number | null): void {
    if (this.scenery !== null) this.scenery.maxTriangles = maxTriangles;
    const bodies = [...(this.figure?.group.visible === true ? [this.figure] : []), ...this.hands];
    if (bodies.length > 0) this.shadow.cast(this.stage.drawer, bodies.map(({ mesh }) => mesh), boundsOfPosture(bodies[0].avatar, bodies[0].world));
  }
}
